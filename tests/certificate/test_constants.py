"""Constants against those that are known."""

import numpy as np
import pytest
from scipy.special import jn_zeros

from builders import delaunay, grid
from signorini.certificate.constants import FIRST_ZERO, friedrichs_constant


def test_the_zero_is_below_the_first_of_j1():
    assert jn_zeros(1, 1)[0] - 1e-5 < FIRST_ZERO < jn_zeros(1, 1)[0]


@pytest.mark.parametrize(
    ("labels", "size", "square"),
    [
        (("contact", "neumann", "dirichlet", "neumann"), (1.0, 1.0), (np.pi / 2) ** 2),
        (("contact", "dirichlet", "dirichlet", "dirichlet"), (2.0, 1.0), np.pi**2 / 2),
        (("contact", "neumann", "dirichlet", "dirichlet"), (1.0, 3.0), np.pi**2 * (10 / 36)),
        (("contact", "neumann", "neumann", "neumann"), (2.0, 1.0), (np.pi / 2) ** 2),
    ],
)
@pytest.mark.parametrize("n", [1, 40])
def test_rectangles_have_their_eigenvalues(labels, size, square, n):
    """Products of cosines; the last of mean zero."""
    found = friedrichs_constant(grid(n, labels=labels, size=size))
    assert 1.0 <= found * np.sqrt(square) < 1.003


def test_any_triangulation_gives_a_bound():
    assert 1.0 <= friedrichs_constant(delaunay(0)) * np.pi / 2 < 1.01


def test_it_is_a_length():
    small, large = (friedrichs_constant(grid(8, size=(h, h))) for h in (1e-6, 1e6))
    assert large == pytest.approx(1e12 * small, rel=1e-9)
