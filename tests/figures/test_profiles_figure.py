"""Performance profiles: every line has its name at its end, and none is cut off."""

import pytest

pytest.importorskip("matplotlib")

import numpy as np

from drawn import pixels
from signorini.figures.profiles import apart, draw_profiles

LONGEST = "active set, SuperLU symmetric"
NAMES = ["signorini", LONGEST, *(f"solver {k}" for k in range(12))]
PROFILES = {name: ([1.0, 10.0], [0.1, 0.9 - 0.01 * k]) for k, name in enumerate(NAMES)}


@pytest.fixture(scope="module")
def figure():
    found = draw_profiles(PROFILES)
    pixels(found)
    return found


def test_names_are_in_the_order_of_the_lines_and_apart(figure):
    (axes,) = figure.axes
    boxes = {text.get_text(): text.get_window_extent() for text in axes.texts}
    assert list(boxes) == NAMES[::-1]
    for below, above in zip(list(boxes)[:-1], list(boxes)[1:], strict=True):
        assert boxes[below].y1 <= boxes[above].y0


def test_no_name_is_cut_off(figure):
    for text in figure.axes[0].texts:
        box = text.get_window_extent()
        assert 0 <= box.x0 < box.x1 <= figure.bbox.width
        assert 0 <= box.y0 < box.y1 <= figure.bbox.height


@pytest.mark.parametrize("places", [[0.0], [0.0, 0.0, 0.0], [0.4, 0.5, 0.5, 1.0], [1.0] * 5])
def test_places_are_apart_and_below_the_top(places):
    found = apart(places, 0.2, 1.0)
    assert np.all(np.diff(found) >= 0.2 - 1e-15)
    assert max(found) <= 1.0


def test_places_that_are_apart_stay():
    assert apart([0.0, 0.5, 1.0], 0.5, 1.0) == [0.0, 0.5, 1.0]
