"""Exact solutions shared by the tests, meshes for them, and points to evaluate them at."""

import numpy as np
import pytest

from signorini.exact import family, read_exact
from signorini.formula import Formula
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

SOLUTIONS = {
    "corner": family("corner", {"amplitude": 3, "x0": 0.1}),
    "corner above": family("corner", {"y0": -0.5}),
    "punch": family("punch", {"half_width": "1/3", "x0": 0.2}),
    "smooth": family("smooth"),
    "biactive": family("biactive", {"left": -0.2, "right": 0.4}),
    "no contact": family("uniform-load", {"c": 2, "alpha": "1/3"}),
    "full contact": family("uniform-load", {"c": -1}),
    "patch": family("patch", {"alpha": 2}),
    "formula": read_exact({"u": "r**(3/2)*cos(3*theta/2)", "critical_points": [[0, 0]]}),
    "diffused": read_exact({"family": "smooth"}, Formula("3")),
}
solutions = pytest.mark.parametrize("name", SOLUTIONS)
SIDES = ("contact", "neumann", "dirichlet", "neumann")


def grid(n=4, labels=SIDES, origin=(-0.5, 0.0), size=(1.0, 1.0)):
    return Grid(n, n, origin, size, "falling", labels)


def skewed(labels=SIDES):
    """A triangulation with its inner vertices moved and triangles of both orientations."""
    from skfem import MeshTri

    mesh = grid(labels=labels).skfem
    p = mesh.p.copy()
    inner = mesh.interior_nodes()
    p[:, inner] += np.random.default_rng(3).uniform(-0.07, 0.07, (2, inner.size))
    t = mesh.t.copy()
    t[:2, ::2] = t[1::-1, ::2]
    return Triangulation.from_skfem(
        MeshTri(p, t, sort_t=False).with_boundaries(dict(mesh.boundaries))
    )


def inside(count=200):
    rng = np.random.default_rng(0)
    return rng.uniform(-1, 1, count), rng.uniform(0.05, 1, count)


def contact_side(zero=0.0):
    return np.linspace(-1, 1, 401), np.full(401, zero)
