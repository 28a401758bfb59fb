"""Text in PDF figures: what a reader selects is what is printed."""

import re
import shutil
import subprocess

import pytest

pytest.importorskip("matplotlib")

from matplotlib.backends._backend_pdf_ps import CharacterTracker

from drawn import FIGURES
from signorini.figures.readable import readable_text, symbols
from signorini.figures.style import new_figure, save_figure

pytestmark = pytest.mark.skipif(not shutil.which("pdftotext"), reason="pdftotext is not installed")
# Bars of colours, panels and surfaces: minus signs, decimal points, Greek letters, relations.
STRANGE = re.compile(r"[^\n\f !-~αβγδελμνπΓΩ∂∇≤≥≪×·′−–—]")


def text_of(figure, path):
    save_figure(figure, path)
    command = ["pdftotext", "-layout", str(path), "-"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("name", FIGURES)
def test_no_character_is_one_that_no_figure_has(name, tmp_path):
    text = text_of(FIGURES[name](), tmp_path / "figure.pdf")
    assert text.strip()
    assert STRANGE.findall(text) == []
    assert re.findall(r"\d:\d", text) == []


def test_minus_signs_points_letters_and_relations(tmp_path):
    figure = new_figure(3, 1)
    figure.text(0.1, 0.5, r"$-0.25 \leq k\,\mathrm{d}u/\mathrm{d}\nu < 10^{-3}$ and $\Gamma_C$")
    text = " ".join(text_of(figure, tmp_path / "text.pdf").split())
    assert text.replace(" ", "").startswith("−0.25≤kdu/dν<10−3andΓ")


def test_every_symbol_has_one_character():
    assert all(len(character) == 1 for character in symbols().values())


def test_matplotlib_is_as_it_was_after_a_figure_also_after_an_error():
    before = CharacterTracker.track_glyph
    with readable_text():
        assert CharacterTracker.track_glyph is not before
    assert CharacterTracker.track_glyph is before
    with pytest.raises(ZeroDivisionError), readable_text():
        _ = 1 / 0
    assert CharacterTracker.track_glyph is before
