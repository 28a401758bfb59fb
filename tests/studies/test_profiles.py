"""Performance profiles: what Dolan and More say of them."""

import numpy as np
import pytest

from signorini.studies.profiles import profile, ratios

RNG = np.random.default_rng(0)
TIMES = {name: RNG.exponential(size=50) for name in "abc"}
TIMES["c"][::5] = np.inf


def test_a_profile_rises_to_the_share_solved():
    for name, found in ratios(TIMES).items():
        tau, rho = profile(found)
        assert tau[0] == 1.0
        assert np.all(np.diff(tau) > 0)
        assert np.all(np.diff(rho) >= 0)
        assert rho[-1] == np.isfinite(TIMES[name]).mean()


def test_one_is_the_fastest_of_each_problem():
    firsts = [profile(found)[1][0] for found in ratios(TIMES).values()]
    assert sum(firsts) == pytest.approx(1.0)  # no two are equally fast


def test_a_tie_counts_for_both_and_an_unsolved_problem_for_none():
    found = ratios({"a": [1.0, 2.0, np.inf], "b": [1.0, 1.0, np.inf]})
    shares = {name: profile(values)[1] for name, values in found.items()}
    assert shares["a"].tolist() == pytest.approx([1 / 3, 2 / 3])
    assert shares["b"].tolist() == pytest.approx([2 / 3])


def test_a_unit_of_time_changes_nothing():
    scaled = ratios({name: 1024.0 * values for name, values in TIMES.items()})
    for name, found in ratios(TIMES).items():
        np.testing.assert_array_equal(found, scaled[name])
