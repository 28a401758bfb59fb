import csv
import os
import re
import subprocess
import sys
from math import log
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from signorini.figures.convergence import draw_convergence
from signorini.figures.style import TEXT_WIDTH, new_figure, save_figure
from signorini.figures.surface import draw_surface

ROOT = Path(__file__).parents[1]
PRINTED = list(csv.DictReader((ROOT / "tests/data/table_5_1.csv").read_text().splitlines()))  # the paper's


def published_errors():
    return [
        {
            "element": element,
            "n": row["n"],
            "h": 1 / int(row["n"]),
            "l2": row[f"l2_{tag}"],
            "h1": row[f"h1_{tag}"],
            "h1_semi": row[f"h1_{tag}"],
        }
        for element, tag in (("P1", "cf"), ("CR", "ncf"))
        for row in PRINTED
    ]


def sloping_surface(critical_points=((0.7, 0.0),)):
    x = np.linspace(0, 1, 9)
    contact_x = np.linspace(0, 1, 65)
    return {
        "x": x,
        "y": x,
        "u": np.maximum(0.7 - x, 0) * (1 - x[:, None]),
        "contact_x": contact_x,
        "contact_u": np.maximum(0.7 - contact_x, 0),
        "critical_points": np.reshape(critical_points, (-1, 2)),
    }


FIGURES = {
    "surface": lambda: draw_surface(sloping_surface()),
    "convergence": lambda: draw_convergence(published_errors(), "l2", {"P1": 1.8955, "CR": "2.0979"}),
}


@pytest.fixture(params=FIGURES)
def figure(request):
    return FIGURES[request.param]()


def legend(figure):
    box = [*figure.legends, *(axes.get_legend() for axes in figure.axes)]
    return [text.get_text() for legend in box if legend for text in legend.get_texts()]


def line(figure, label):
    return next(line for line in figure.axes[0].lines if line.get_label() == label)


# Files


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
from test_figures import FIGURES
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


def test_figures_are_drawn_for_the_width_of_the_document(figure):
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    assert float(re.search(r"textwidth=(\d+)mm", source)[1]) / 25.4 == pytest.approx(TEXT_WIDTH)
    assert figure.get_figwidth() <= TEXT_WIDTH


# The surface


def test_critical_point_is_marked_where_the_contact_line_turns():
    figure = draw_surface(sloping_surface())
    marker = line(figure, "critical point").get_xydata()
    level = line(figure, "obstacle").get_xydata()
    np.testing.assert_allclose(marker[0], level[0] + 0.7 * (level[-1] - level[0]))
    assert "$x = 0.700$" in [text.get_text() for text in figure.axes[0].texts]


def test_binding_part_is_told_from_the_free_one():
    figure = draw_surface(sloping_surface())
    free = np.isfinite(line(figure, "contact side, free").get_ydata())
    binding = np.isfinite(line(figure, "contact side, binding").get_ydata())
    assert (free ^ binding).all()
    assert free.sum() == np.count_nonzero(np.linspace(0, 1, 65) < 0.7)


def test_an_obstacle_other_than_zero_decides_what_binds():
    surface = sloping_surface()
    surface["contact_obstacle"] = np.full(65, 0.35)
    surface["contact_u"] = np.maximum(surface["contact_u"], 0.35)
    binding = np.isfinite(line(draw_surface(surface), "contact side, binding").get_ydata())
    assert binding.sum() == np.count_nonzero(0.7 - np.linspace(0, 1, 65) <= 0.35)


@pytest.mark.parametrize("points", [[], [(0.3, 0)], [(0.3, 0), (0.7, 0)]])
def test_any_number_of_critical_points(points):
    figure = draw_surface(sloping_surface(points))
    markers = [artist for artist in figure.axes[0].lines if artist.get_marker() == "o"]
    assert len(markers) == len(points)
    assert legend(figure).count("critical point") == bool(points)


@pytest.mark.filterwarnings("error")
def test_a_flat_surface_has_a_box_too(tmp_path):
    surface = sloping_surface(())
    flat = surface | {"u": np.zeros((9, 9)), "contact_u": np.zeros(65)}
    save_figure(draw_surface(flat), tmp_path / "f.png")


def test_surface_names_its_axes():
    texts = {text.get_text() for text in draw_surface(sloping_surface()).axes[0].texts}
    assert {"$x$", "$y$", "$u$"} <= texts


def test_nearer_cells_are_painted_later():
    cells = draw_surface(sloping_surface()).axes[0].collections[-1].get_paths()
    first, last = (cell.vertices[:, 1].mean() for cell in (cells[0], cells[-1]))
    assert len(cells) == 64
    assert first > last


# The convergence plots


def test_convergence_is_labelled():
    figure = FIGURES["convergence"]()
    (axes,) = figure.axes
    assert legend(figure) == ["CF (P1), slope 1.90", "NCF (CR), slope 2.10"]
    assert axes.get_xlabel() == "mesh width $h$"
    assert axes.get_ylabel() == "$L^2$ error"
    ticks = dict(zip((t.get_text() for t in axes.get_xticklabels()), axes.get_xticks(), strict=True))
    assert ticks == {f"1/{n}": 1 / n for n in (2, 4, 8, 16, 32, 64)}
    assert axes.get_xlim() == pytest.approx((1e-2, 1))  # as in the paper


@pytest.mark.parametrize(("norm", "order"), [("l2", 2), ("h1", 1), ("h1_semi", 1)])
def test_triangle_has_the_slope_it_says(norm, order):
    (axes,) = draw_convergence(published_errors(), norm).axes
    (left, low), (right, _), (_, high), _ = axes.lines[-1].get_xydata()
    assert log(high / low) / log(right / left) == pytest.approx(order)
    assert [text.get_text() for text in axes.texts] == ["$1$", f"${order}$"]


def test_lines_differ_in_more_than_colour():
    lines = draw_convergence(published_errors(), "h1").axes[0].lines[:2]
    assert len({artist.get_marker() for artist in lines}) == 2
    assert len({artist.get_linestyle() for artist in lines}) == 2


@pytest.mark.parametrize("error", [0.0, None, ""])
def test_an_error_that_has_no_logarithm_is_left_out(error, tmp_path):
    errors = published_errors()
    errors[-1]["l2"] = error
    figure = draw_convergence(errors, "l2")
    save_figure(figure, tmp_path / "f.png")
    assert figure.axes[0].get_ylim()[0] > 1e-6


def test_many_levels_keep_the_labels_apart():
    errors = [{"element": "CR", "n": 2**k, "h": 2.0**-k, "l2": 4.0**-k} for k in range(12)]
    labels = [text.get_text() for text in draw_convergence(errors, "l2").axes[0].get_xticklabels()]
    assert len(labels) == 12
    assert sum(map(bool, labels)) <= 7


@pytest.mark.parametrize(("norm", "element"), [("l3", "P1"), ("l2", "P2")])
def test_unknown_names_are_refused(norm, element):
    with pytest.raises(ValueError, match="known: "):
        draw_convergence([{"element": element, "n": 2, "h": 0.5, "l2": 1.0}], norm)
