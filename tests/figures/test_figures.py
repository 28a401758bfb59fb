"""Figures as files: bytes, fonts, sizes."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from drawn import FIGURES
from signorini.figures.style import TEXT_WIDTH, new_figure, save_figure

ROOT = Path(__file__).parents[2]


@pytest.fixture(params=FIGURES)
def figure(request):
    return FIGURES[request.param]()


@pytest.mark.parametrize("suffix", [".pdf", ".png"])
@pytest.mark.parametrize("name", FIGURES)
def test_same_numbers_same_bytes(tmp_path, name, suffix):
    paths = [tmp_path / f"{k}{suffix}" for k in range(2)]
    for path in paths:
        save_figure(FIGURES[name](), path)
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_other_process_same_bytes_and_no_heavy_import(tmp_path):
    code = """
import sys
from pathlib import Path
from drawn import FIGURES
from signorini.figures.style import save_figure
for name, draw in FIGURES.items():
    save_figure(draw(), Path(sys.argv[1]) / f"{name}.pdf")
    save_figure(draw(), Path(sys.argv[1]) / f"{name}.png")
print({"matplotlib.pyplot", "scipy", "skfem"} & sys.modules.keys())
"""
    paths = os.pathsep.join([str(ROOT / "src"), str(ROOT / "tests")])
    environment = os.environ | {"PYTHONPATH": paths, "PYTHONHASHSEED": "7", "TZ": "Asia/Tokyo"}
    run = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout == "set()\n"
    assert run.stderr == ""
    for name, draw in FIGURES.items():
        for suffix in (".pdf", ".png"):
            here = tmp_path / f"here{suffix}"
            save_figure(draw(), here)
            assert here.read_bytes() == (tmp_path / f"{name}{suffix}").read_bytes()


def test_fonts_are_embedded_truetype(figure, tmp_path):
    save_figure(figure, tmp_path / "f.pdf")
    pdf = (tmp_path / "f.pdf").read_bytes()
    fonts = re.findall(rb"/FontName /([A-Z]{6}\+)?(\w+)", pdf)
    assert {name.lower() for _, name in fonts} <= {b"cmr10", b"cmmi10", b"cmsy10"}
    assert len(fonts) == pdf.count(b"/FontFile2") > 0
    assert b"/Type3" not in pdf
    assert b"CreationDate" not in pdf


def test_png_has_200_dots_per_inch(figure, tmp_path):
    save_figure(figure, tmp_path / "f.png")
    size = np.frombuffer((tmp_path / "f.png").read_bytes()[16:24], ">u4")
    np.testing.assert_allclose(size, figure.get_size_inches() * 200, atol=1)


def test_other_formats_are_refused(figure, tmp_path):
    with pytest.raises(ValueError, match=r"known: \.pdf, \.png"):
        save_figure(figure, tmp_path / "f.svg")


def test_a_failed_save_leaves_the_old_file_alone(tmp_path):
    target = tmp_path / "f.pdf"
    target.write_text("old")
    figure = new_figure(1, 1)
    figure.text(0, 0, r"$\nonsense$")
    with pytest.raises(ValueError, match="nonsense"):
        save_figure(figure, target)
    assert [p.name for p in tmp_path.iterdir()] == ["f.pdf"]
    assert target.read_text() == "old"


def test_a_user_who_saves_a_figure_has_the_same_picture(figure, tmp_path):
    """Matplotlib reads fonts when it draws: without the style their mathematics was sans serif."""
    save_figure(figure, tmp_path / "ours.png")
    figure.savefig(tmp_path / "theirs.png")
    assert (tmp_path / "ours.png").read_bytes() == (tmp_path / "theirs.png").read_bytes()


def test_a_figure_is_a_picture_in_a_notebook(figure):
    header = figure._repr_png_()[:24]
    width, height = (int.from_bytes(header[at : at + 4], "big") for at in (16, 20))
    inches = figure.get_size_inches()
    assert header[1:4] == b"PNG"
    assert [width, height] == pytest.approx(120 * inches, abs=1.0)


@pytest.mark.parametrize(
    "name", [name for name in FIGURES if name != "gallery"]
)  # which is for the screen
def test_figures_are_drawn_for_the_width_of_the_document(name):
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    assert float(re.search(r"textwidth=(\d+)mm", source)[1]) / 25.4 == pytest.approx(TEXT_WIDTH)
    assert FIGURES[name]().get_figwidth() <= TEXT_WIDTH
