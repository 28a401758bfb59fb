"""What report computes for figures: curves, bars, and the parts of the contact side."""

from itertools import pairwise

import numpy as np
import pytest

from signorini.report.contact_side import contact_side, critical_heights, finest_lines
from signorini.report.curves import (
    EPS,
    longest_series,
    round_off_of_aspects,
    round_off_of_widths,
    spread,
    stacked_shares,
    thinned,
)

SURFACE = {
    "contact_x": np.linspace(0, 1, 5),
    "contact_u": np.array([0.5, 0.3, 0.1, 0.0, 0.0]),
    "critical_points": np.array([[0.6, 0.0]]),
}


def test_the_route_with_the_most_levels_stands_for_its_element():
    series = {
        ("a", "P1", "fourier"): [1, 2],
        ("a", "CR", "fourier"): [1],
        ("a", "P1", "direct"): [1, 2, 3],
        ("a", "CR", "direct"): [2],
    }
    assert longest_series(series) == {("a", "CR", "fourier"): [1], ("a", "P1", "direct"): [1, 2, 3]}


def test_shares_fill_a_bar():
    pieces = stacked_shares({"a": 0.3, "b": 0.5, "c": 1.7}, ("a", "b", "c"))
    for (_, start, length), (_, following, _) in pairwise(pieces):
        assert start + length == following
    assert pieces[-1][1] + pieces[-1][2] == pytest.approx(1.0)


def test_spread_is_taken_from_the_median():
    rows = [{"total": 2.0, "total_min": 1.5, "total_max": 4.0}]
    assert spread(rows, "total") == ([0.5], [2.0])


def test_thinning_keeps_every_point_within_a_tenth_of_a_decade():
    rng = np.random.default_rng(0)
    points = 10 ** rng.uniform(-3, 0, (500, 2))
    x, y = (np.log10(values) for values in thinned(points.tolist()))
    assert len(x) < 500
    distances = np.abs(np.log10(points)[:, None] - np.stack([x, y], axis=1))
    assert distances.max(axis=2).min(axis=1).max() <= 0.05 + 1e-12


def test_round_off_is_eps_times_condition():
    assert round_off_of_widths([0.5], 2.0, 3.0) == pytest.approx([EPS * 12])
    rows = [{"aspect": 0.1, "condition": value} for value in (100.0, -1.0, 1e17)]
    assert round_off_of_aspects(rows) == [(0.1,), (100 * EPS,)]
    assert round_off_of_aspects(rows[1:]) == []


def test_the_contact_side_is_free_or_binds():
    side = contact_side(SURFACE)
    np.testing.assert_array_equal(np.isnan(side["free"]), ~np.isnan(side["binding"]))
    np.testing.assert_array_equal(~np.isnan(side["binding"]), [False, False, False, True, True])
    assert side["points"] == [(0.6, 0.0, 0.0)]


def test_critical_points_lie_on_the_obstacle():
    obstacle = SURFACE["contact_x"] - 2
    assert contact_side(SURFACE | {"contact_obstacle": obstacle})["points"][0][2] == (
        pytest.approx(-1.4)
    )
    line = {"s": SURFACE["contact_x"], "obstacle": obstacle, "critical": np.array([np.nan, 0.6])}
    places, heights = critical_heights(line)
    assert (places.tolist(), heights.tolist()) == ([0.6], [pytest.approx(-1.4)])


def test_lines_are_those_of_the_finest_level_with_holes():
    numbers = {"component": 0, "s": 1.5, "u": "0.5", "obstacle": 0, "flux": 0, "critical": ""}
    rows = [{"element": "CR", "n": n, **numbers} for n in ("4", "16", "8", "16")]
    (line,) = finest_lines(rows, ["CR"]).values()
    assert line["n"] == 16
    assert line["u"].tolist() == [0.5, 0.5]
    assert np.isnan(line["critical"]).all()
