"""The exact contact force, integrated over the contact part."""

import math

import pytest

from signorini.errors.contact import contact_resultant
from signorini.exact.families import family
from signorini.mesh.grid import Grid

BOTTOM = ("contact", "dirichlet", "dirichlet", "dirichlet")


@pytest.mark.parametrize("n", [3, 8])
@pytest.mark.parametrize("half_width", [0.6, 1 / 3])
def test_of_a_punch_it_is_half_a_disc(half_width, n):
    exact = family("punch", {"half_width": half_width})
    mesh = Grid(n, n, (-1.0, 0.0), (2.0, 1.0), "falling", BOTTOM)
    assert contact_resultant(mesh, exact) == pytest.approx(math.pi * half_width**2 / 2, rel=1e-6)


def test_without_contact_part_it_is_zero():
    mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("dirichlet",) * 4)
    assert contact_resultant(mesh, family("patch")) == 0.0
