"""The fourier route against the direct one, which assembles and factorises a matrix."""

import itertools
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.mesh.boundary import SIDES
from signorini.solvers import kkt_residual, solve
from signorini.solvers.fourier import why_not

ROOT = Path(__file__).parents[2]
KINDS = ("dirichlet", "neumann")
SHAPES = {"2x2": (2, 2), "2x5": (2, 5), "5x2": (5, 2), "7x6": (7, 6)}


def labels_around(side, near, far, beside):
    """Labels of the four sides when `near` holds on `side`."""
    around = [near, beside, far, beside]
    turn = SIDES.index(side)
    return tuple(around[(k - turn) % 4] for k in range(4))


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


@pytest.fixture(params=SHAPES)
def shape(request):
    return SHAPES[request.param]


def random_problem(labels, element, shape, diagonal, size=(1.0, 0.7), seed=0):
    """White noise for a load, Dirichlet values and an obstacle that binds at about half of the
    dofs.
    """
    rng = np.random.default_rng(seed)
    problem = discretize_on(
        grid(*shape, labels=labels, diagonal=diagonal, size=size), element, statement()
    )
    b = rng.standard_normal(problem.b.size)
    if not problem.fixed.size:
        b -= b.mean() + 0.1
    return replace(
        problem,
        b=b,
        lower=rng.standard_normal(problem.lower.size),
        fixed_values=rng.standard_normal(problem.fixed.size),
    )


def assert_routes_agree(problem):
    fourier, direct = (solve(problem, method) for method in ("fourier", "direct"))
    scale = np.abs(direct.u).max()
    np.testing.assert_allclose(fourier.u, direct.u, rtol=0, atol=1e-11 * scale)
    np.testing.assert_allclose(
        fourier.multiplier, direct.multiplier, rtol=0, atol=1e-10 * np.abs(problem.b).max()
    )
    np.testing.assert_array_equal(fourier.active, direct.active)
    # The matrix that scikit-fem assembles is the judge of both.
    assert kkt_residual(problem, fourier.u)[0] < 1e-13
    assert "A" not in problem.__dict__


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("beside", KINDS)
@pytest.mark.parametrize("far", KINDS)
@pytest.mark.parametrize("side", SIDES)
def test_both_routes_agree_on_every_contact_side(side, far, beside, element, shape, diagonal):
    assert_routes_agree(
        random_problem(labels_around(side, "contact", far, beside), element, shape, diagonal)
    )


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize(
    "kinds",
    [kinds for kinds in itertools.product(KINDS, repeat=4) if "dirichlet" in kinds],
    ids="-".join,
)
def test_both_routes_agree_without_contact(kinds, element, shape, diagonal):
    problem = random_problem(kinds, element, shape, diagonal)
    if why_not(problem) is None:
        assert_routes_agree(problem)
    else:
        assert kinds[0] != kinds[2]
        assert kinds[1] != kinds[3]


@pytest.mark.parametrize("size", [(1.0, 1.0), (30.0, 1.0), (1.0, 30.0), (1e9, 1e9), (1e-9, 1e-9)])
@pytest.mark.parametrize("side", SIDES)
def test_both_routes_agree_on_stretched_and_scaled_cells(side, size, element):
    problem = random_problem(
        labels_around(side, "contact", "dirichlet", "neumann"), element, (6, 9), "falling", size
    )
    assert_routes_agree(problem)


@pytest.mark.parametrize(
    "labels", [labels_around(side, "contact", "dirichlet", "neumann") for side in SIDES]
)
@pytest.mark.parametrize("quadrature", ["exact", "centroid"])
def test_both_routes_agree_on_formulas(labels, element, quadrature):
    data = {
        "f": "30*sin(9*x + 7*y) - 2",
        "g": "cos(3*x - y)",
        "dirichlet": "0.1 + 0.1*x*y",
        "obstacle": "0.1*sin(6*x*y)",
    }
    problem = discretize_on(
        grid(12, 16, labels), element, statement(load_quadrature=quadrature, **data)
    )
    solution = solve(problem, "fourier")
    assert 0 < solution.active.sum() < solution.active.size
    assert_routes_agree(problem)


def test_both_routes_agree_to_rounding(element):
    """It takes the direct route's iterative refinement: without it they are 1e-13 apart."""
    problem = discretize_on(grid(64), element, statement(**DATA))
    fourier, direct = (solve(problem, method) for method in ("fourier", "direct"))
    np.testing.assert_allclose(fourier.u, direct.u, rtol=0, atol=1e-14)


@pytest.mark.parametrize("far", KINDS)
@pytest.mark.parametrize("beside", KINDS)
def test_both_routes_agree_on_a_long_contact_line(far, beside, element):
    """More contact dofs than the dense contact matrix takes."""
    labels = labels_around("top", "contact", far, beside)
    problem = discretize_on(
        grid(200, 4, labels),
        element,
        statement(f="40*sin(11*x) - 8", obstacle="0.01*cos(9*x) - 0.02"),
    )
    assert problem.contact.size > 150
    fourier, direct = (solve(problem, method) for method in ("fourier", "direct"))
    assert 0 < fourier.active.sum() < fourier.active.size
    np.testing.assert_allclose(fourier.u, direct.u, rtol=0, atol=1e-10 * np.abs(direct.u).max())


OBSTRUCTED = {
    "triangulation": (lambda: delaunay(0), {}, "the mesh is not a uniform grid"),
    "two contact sides": (
        lambda: grid(4, labels=("contact", "neumann", "contact", "neumann")),
        {},
        "more than one side is in contact",
    ),
    "one cell wide": (lambda: grid(1, 4), {}, "the grid is a single cell wide"),
    "one cell high": (lambda: grid(4, 1), {}, "the grid is a single cell wide"),
    "unlike sides": (
        lambda: grid(4, labels=("contact", "dirichlet", "dirichlet", "neumann")),
        {},
        "the two sides beside the contact side differ in kind",
    ),
    "coefficient": (lambda: grid(4), {"coefficient": "1 + x"}, "the coefficient is not 1"),
}


@pytest.mark.parametrize("case", OBSTRUCTED)
def test_what_stands_in_the_way_is_named(case, element):
    mesh, data, reason = OBSTRUCTED[case]
    assert why_not(discretize_on(mesh(), element, statement(**data))) == reason


def test_no_matrix_is_assembled(element):
    problem = discretize_on(grid(16), element, statement(**DATA))
    solve(problem)
    assert "A" not in problem.__dict__


@pytest.mark.parametrize("n", [16, 200])
def test_neither_scipy_nor_scikit_fem_is_imported(n, element):
    code = f"""
import sys
from signorini.fem.problem import discretize
from signorini.solvers import solve
from signorini.scene.statement import ProblemStatement
sides = {{"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}}
domain = {{"origin": [0, 0], "size": [1, 1], "diagonal": "falling", "cells": "per-unit"}}
data = {{"f": "sin(9*x)", "g": 0, "dirichlet": 0, "obstacle": 0}}
mapping = {{"domain": domain, "boundary": sides, "data": data, "load_quadrature": "centroid"}}
solution = solve(discretize(ProblemStatement.from_mapping(mapping), "{element}", {n}))
print(solution.method, *sorted({{"scipy", "skfem", "yaml", "jsonschema"}} & set(sys.modules)))
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={"PYTHONPATH": str(ROOT / "src")},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["fourier"]
