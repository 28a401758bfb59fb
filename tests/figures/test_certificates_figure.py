"""The bands of guaranteed bounds."""

import pytest

pytest.importorskip("matplotlib")

from drawn import legend
from signorini.figures.certificates import draw_certificates

ROWS = [
    {"element": element, "n": n, "h": 1 / n, "lower": low / n, "upper": 1 / n, "error": error}
    for element, low, error in (("P1", 0.9, ""), ("CR", 0.8, 0.05))
    for n in (8, 16)
]


def test_a_band_lies_between_the_bounds():
    (axes,) = draw_certificates(ROWS).axes
    for band, low in zip(axes.collections, (0.9, 0.8), strict=True):
        points = band.get_paths()[0].vertices
        heights = {round(y * 16, 9) for x, y in points if abs(x - 1 / 16) < 1e-9}
        assert heights == {low, 1.0}


def test_the_error_is_marked_where_it_is_known():
    (axes,) = draw_certificates(ROWS).axes
    marks = [line for line in axes.lines if line.get_linestyle() == "None"]
    assert [line.get_ydata().tolist() for line in marks] == [[0.05, 0.05]]
    assert legend(axes.figure) == ["CF (P1)", "NCF (CR)"]


def test_bands_are_told_apart_in_grey_and_the_axis_has_two_numbers():
    axes = draw_certificates(ROWS).axes[0]
    edges = {line.get_linestyle() for line in axes.lines if line.get_linestyle() != "None"}
    assert edges == {"-", "--"}
    low, high = axes.get_ylim()
    assert low <= 0.1 < 1.0 <= high or low <= 0.01 < 0.1 <= high


def test_a_lower_bound_of_zero_has_no_place():
    rows = [row | {"lower": 0.0} for row in ROWS]
    draw_certificates(rows).canvas.draw()
