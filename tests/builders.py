"""Small statements and meshes shared by the tests."""

import numpy as np
from scipy.spatial import Delaunay
from skfem import MeshTri

from signorini.fem.elements import find_element
from signorini.mesh.boundary import SIDES
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation
from signorini.scene.statement import ProblemStatement

PAPER = (
    "contact",
    "neumann",
    "dirichlet",
    "neumann",
)  # what holds on the sides of Section 5, as in SIDES
UNIT = ((0.0, 0.0), (1.0, 1.0))

# Formulas without symmetry, none of them zero anywhere for long; the contact set of DATA is neither
# empty nor full.
DATA = {
    "f": "6*sin(5*x + 2*y) + 3*cos(7*y) - 2",
    "g": "cos(3*x - y) - 0.8",
    "dirichlet": "0.2 + 0.1*sin(4*x + 3*y)",
    "obstacle": "0.1*cos(6*x) - 0.1*y",
}


def statement(labels=PAPER, load_quadrature="exact", domain=None, constraint="lower", **data):
    return ProblemStatement.from_mapping(
        {
            "domain": {"origin": [0, 0], "size": [1, 1], "diagonal": "falling", "cells": "per-side"}
            | (domain or {}),
            "boundary": dict(zip(SIDES, labels, strict=True)),
            "data": {"f": 0, "g": 0, "dirichlet": 0, "obstacle": 0} | data,
            "load_quadrature": load_quadrature,
            "constraint": constraint,
        }
    )


def grid(nx, ny=None, labels=PAPER, diagonal="falling", origin=(0.0, 0.0), size=(1.0, 1.0)):
    return Grid(nx, ny or nx, origin, size, diagonal, labels)


def labelled(mesh, labels=PAPER):
    """The unit square's scikit-fem mesh as a `Triangulation`; a facet belongs to a side if both
    ends lie on it.
    """
    x, y = mesh.p[:, mesh.facets]
    on_side = {"bottom": y == 0, "right": x == 1, "top": y == 1, "left": x == 0}
    names = {label: [] for label in labels}
    for side, label in zip(SIDES, labels, strict=True):
        names[label].append(np.flatnonzero(on_side[side].all(axis=0)))
    return Triangulation.from_skfem(
        mesh.with_boundaries({label: np.concatenate(found) for label, found in names.items()})
    )


def delaunay(seed, inner=25, side=5, labels=PAPER):
    """A random Delaunay triangulation of the unit square."""
    rng = np.random.default_rng(seed)
    s, zero = rng.uniform(0.05, 0.95, (4, side)), np.zeros(side)
    points = np.hstack(
        [
            [[0, 1, 1, 0], [0, 0, 1, 1]],
            [s[0], zero],
            [1 + zero, s[1]],
            [s[2], 1 + zero],
            [zero, s[3]],
            rng.uniform(0.1, 0.9, (2, inner)),
        ]
    )
    t = Delaunay(points.T).simplices.T
    (ax, ay), (bx, by), (cx, cy) = (points[:, v] for v in t)
    flat = np.abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) < 1e-12  # three points of one side
    return labelled(MeshTri(points, t[:, ~flat]), labels)


def perturbed(n, seed=0, labels=PAPER, diagonal="falling"):
    """A grid of the unit square whose inner vertices are moved by up to 0.3 of a cell."""
    mesh = grid(n, diagonal=diagonal).skfem
    p = mesh.p.copy()
    inner = mesh.interior_nodes()
    p[:, inner] += np.random.default_rng(seed).uniform(-0.3 / n, 0.3 / n, (2, inner.size))
    return labelled(MeshTri(p, mesh.t), labels)


def scattered(n, seed=0, labels=PAPER):
    """A Delaunay triangulation of the unit square that no mesh was refined to: a grid's inner
    vertices moved by up to 0.35 of a cell, and joined anew.
    """
    mesh = grid(n).skfem
    p, inner = mesh.p.copy(), mesh.interior_nodes()
    p[:, inner] += np.random.default_rng(seed).uniform(-0.35 / n, 0.35 / n, (2, inner.size))
    return labelled(MeshTri(p, Delaunay(p.T).simplices.T), labels)


def nodes(problem):
    """Coordinates of every degree of freedom, shape (2, ndof)."""
    return find_element(problem.element).nodes(problem.mesh, np.arange(problem.b.size))


def gap(problem, u):
    """How far u lies above the obstacle, at the contact dofs."""
    return u[problem.contact] - problem.lower


def energy(problem, u):
    """The functional that the solution minimises."""
    return 0.5 * u @ (problem.A @ u) - problem.b @ u
