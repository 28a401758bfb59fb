"""From a statement to a bound-constrained quadratic problem."""

import numpy as np
import pytest

from builders import DATA, delaunay, grid, nodes, statement
from signorini.exceptions import FormulaError, MeshError, SceneError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.formula import Formula
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

MESHES = {
    "grid": lambda labels: grid(4, 3, labels),
    "grid as triangulation": lambda labels: Triangulation.from_skfem(
        grid(4, 3, labels, "rising").skfem
    ),
    "delaunay": lambda labels: delaunay(0, labels=labels),
}
LABELS = {
    "paper": ("contact", "neumann", "dirichlet", "neumann"),
    "corner": ("contact", "contact", "dirichlet", "dirichlet"),
    "enclosed": ("contact", "dirichlet", "dirichlet", "dirichlet"),
    "contact only": ("contact",) * 4,
    "dirichlet only": ("dirichlet",) * 4,
}


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


@pytest.fixture(params=LABELS)
def labels(request):
    return LABELS[request.param]


@pytest.fixture(params=MESHES)
def problem(request, labels, element):
    return discretize_on(MESHES[request.param](labels), element, statement(labels, **DATA))


def sides(x, y):
    return {"bottom": y == 0, "right": x == 1, "top": y == 1, "left": x == 0}


def test_dofs_are_fixed_under_constraint_or_plainly_free(problem, labels):
    x, y = nodes(problem)
    on = sides(x, y)
    fixed, contact = (
        np.any(
            [on[side] for side, name in zip(on, labels, strict=True) if name == label] or [x > 2],
            axis=0,
        )
        for label in ("dirichlet", "contact")
    )
    np.testing.assert_array_equal(problem.fixed, np.flatnonzero(fixed))
    np.testing.assert_array_equal(problem.contact, np.flatnonzero(contact & ~fixed))
    np.testing.assert_array_equal(problem.free, np.flatnonzero(~fixed))


def test_data_are_taken_at_the_nodes(problem):
    for name, dofs, values in (
        ("obstacle", problem.contact, problem.lower),
        ("dirichlet", problem.fixed, problem.fixed_values),
    ):
        np.testing.assert_array_equal(values, Formula(DATA[name])(*nodes(problem)[:, dofs]))


def test_the_matrix_is_symmetric_positive_with_constants_for_a_kernel(problem):
    A = problem.A.toarray()
    np.testing.assert_allclose(A, A.T, rtol=0, atol=1e-14 * np.abs(A).max())
    eigenvalues = np.linalg.eigvalsh(A)
    np.testing.assert_allclose(A.sum(axis=1), 0, rtol=0, atol=1e-13 * np.abs(A).max())
    assert abs(eigenvalues[0]) < 1e-12 * eigenvalues[-1]
    assert eigenvalues[1] > 1e-4 * eigenvalues[-1]


def test_applying_the_matrix_needs_no_matrix_on_a_grid(problem):
    u = np.random.default_rng(0).standard_normal(problem.b.size)
    without = problem.apply(u)
    assert ("A" in problem.__dict__) == (problem.grid is None)
    np.testing.assert_allclose(without, problem.A @ u, rtol=0, atol=1e-13 * np.abs(without).max())
    np.testing.assert_array_equal(problem.apply(u), without)  # whether or not A has been built


@pytest.mark.parametrize("n", [0, -4, 2.0, "8", True, None, float("nan")])
def test_a_level_is_a_positive_whole_number(element, n):
    with pytest.raises(SceneError, match="is not a positive whole number"):
        discretize(statement(), element, n)


def test_a_level_may_be_numpys(element):
    assert (
        discretize(statement(), element, np.int64(4)).b.size
        == discretize(statement(), element, 4).b.size
    )


@pytest.mark.parametrize("name", ["P2", "cr", "p1", ""])
def test_an_unknown_element_is_refused(name):
    with pytest.raises(SceneError, match=f"unknown element '{name}'; known: P1, CR"):
        discretize(statement(), name, 4)


@pytest.mark.parametrize(
    ("size", "cells", "n", "shape"),
    [
        ((1, 1), "per-unit", 6, (6, 6)),
        ((2, 0.5), "per-unit", 4, (8, 2)),
        ((0.3, 0.7), "per-unit", 10, (3, 7)),
        ((2, 0.5), "per-side", 5, (5, 5)),
    ],
)
def test_a_level_counts_cells_per_unit_or_per_side(element, size, cells, n, shape):
    mesh = discretize(statement(domain={"size": size, "cells": cells}), element, n).mesh
    assert isinstance(mesh, Grid)
    assert (mesh.nx, mesh.ny) == shape
    assert (mesh.x[-1], mesh.y[-1]) == size


@pytest.mark.parametrize(
    ("size", "n", "axis"), [((0.3, 1), 4, "x"), ((1, 1.05), 10, "y"), ((1, 0.01), 10, "y")]
)
def test_a_side_must_be_a_whole_number_of_cells(size, n, axis):
    with pytest.raises(MeshError, match=f"cuts the {axis} side into .* cells; choose n"):
        discretize(statement(domain={"size": size, "cells": "per-unit"}), "P1", n)


@pytest.mark.parametrize(
    ("data", "field"),
    [
        ({"f": "1/x"}, "data.f"),
        ({"g": "log(x - 1)"}, "data.g"),
        ({"dirichlet": "sqrt(x - 0.5)"}, "data.dirichlet"),
        ({"obstacle": "1/(x - 0.5)"}, "data.obstacle"),
        ({"obstacle": "exp(1e4*(x + 1))"}, "data.obstacle"),
    ],
)
def test_data_that_are_not_finite_are_named(data, field):
    """At level 2 the vertices rule, P1's vertices and their neighbours meet each of these poles."""
    with pytest.raises(FormulaError, match=f"{field}: value is"):
        discretize(statement(load_quadrature="vertices", **data), "P1", 2)


@pytest.mark.parametrize(("corner", "other"), [((0, 0), "left"), ((1, 0), "right")])
def test_an_obstacle_above_the_dirichlet_data_at_a_shared_corner_is_refused(element, corner, other):
    """No function of K exists: its trace would jump."""
    labels = (
        "contact",
        *("dirichlet" if side == other else "neumann" for side in ("right", "top", "left")),
    )
    obstacle = f"0.25 - hypot(x - {corner[0]}, y - {corner[1]})"
    with pytest.raises(SceneError, match=rf"incompatible data at \({corner[0]}, {corner[1]}\)"):
        discretize(statement(labels, obstacle=obstacle), element, 4)


@pytest.mark.parametrize(
    ("obstacle", "dirichlet"),
    [
        ("0.25*cos(2*pi*x)", 0.25),
        ("1e-200", 1e-200),
        ("-3 + x", 0),
        ("sin(pi*x)", 0),
        ("1e5*sin(2*pi*x)", 0),
    ],
)
def test_an_obstacle_that_meets_the_dirichlet_data_at_a_shared_corner_is_accepted(
    element, obstacle, dirichlet
):
    """To rounding: sin(pi) is 1.2e-16."""
    labels = ("contact", "dirichlet", "neumann", "dirichlet")
    problem = discretize(statement(labels, obstacle=obstacle, dirichlet=dirichlet), element, 4)
    assert problem.contact.size > 0
