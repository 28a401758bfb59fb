"""Doerfler marking: a smallest set of triangles with its share of the whole."""

import numpy as np
import pytest

from signorini.adapt.marking import bulk
from signorini.exceptions import SceneError


@pytest.mark.parametrize("theta", [0.1, 0.5, 0.9, 1.0])
def test_the_marked_carry_their_share_and_no_smaller_set_does(theta):
    shares = np.random.default_rng(0).random(200) ** 4
    marked = bulk(shares, theta)
    assert shares[marked].sum() >= theta * shares.sum() * (1 - 1e-12)
    assert shares[marked].min() >= shares[~marked].max(initial=0.0)
    assert np.sort(shares[marked])[1:].sum() < theta * shares.sum()


def test_equal_contributions_are_marked_together():
    assert bulk(np.array([1.0, 3.0, 3.0, 3.0 * (1 + 1e-12), 0.5]), 0.3).tolist() == [
        False, True, True, True, False,
    ]  # fmt: skip


def test_marks_do_not_depend_on_the_numbering():
    shares = np.random.default_rng(1).random(100)
    order = np.random.default_rng(2).permutation(100)
    np.testing.assert_array_equal(bulk(shares[order], 0.5), bulk(shares, 0.5)[order])


def test_nothing_to_refine():
    assert not bulk(np.zeros(5), 0.5).any()
    assert bulk(np.array([0.0, 1.0, 2.0]), 1.0).tolist() == [False, True, True]


@pytest.mark.parametrize("theta", [0.0, -1.0, 1.5, float("nan")])
def test_a_share_out_of_range_is_refused(theta):
    with pytest.raises(SceneError, match=r"adapt\.theta: .* above 0, at most 1"):
        bulk(np.ones(3), theta)
