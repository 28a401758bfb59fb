"""Numbers of practice: lengths, places and fluxes, against closed forms and balances."""

from types import SimpleNamespace

import numpy as np
import pytest

from builders import DATA, delaunay, grid, perturbed, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.functionals import (
    contact_length,
    critical_point,
    excess,
    flux,
    free_length,
)
from signorini.fem.problem import discretize_on
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve
from signorini.solvers.stored import stored

MESHES = {"grid": lambda: grid(8), "delaunay": lambda: delaunay(2), "moved": lambda: perturbed(5)}
THRESHOLD = DATA | {"contact_flux": "0.6*sin(9*x) - 0.2"}


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


def solved(mesh, element, **options):
    problem = discretize_on(mesh, element, statement(**options))
    return problem, stored(problem, solve(problem), 8, 0.125)


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("constraint", ["lower", "upper"])
def test_what_flows_in_flows_out(mesh, element, constraint):
    sign = {"lower": 1, "upper": -1}[constraint]
    data = {name: f"{sign}*({text})" for name, text in THRESHOLD.items()}
    problem, solution = solved(MESHES[mesh](), element, constraint=constraint, **data)
    through = flux(problem, solution) + flux(problem, solution, through="dirichlet")
    given = problem.b.sum() - problem.contact_load.sum()  # int f + int g
    assert through + given == pytest.approx(0, abs=1e-12)
    assert sign * excess(problem, solution) > 0
    left = flux(problem, solution) - problem.contact_load.sum()
    assert left == pytest.approx(excess(problem, solution), abs=1e-13)


@pytest.mark.parametrize("mesh", MESHES)
def test_the_contact_part_binds_or_does_not(mesh, element):
    problem, solution = solved(MESHES[mesh](), element, **DATA)
    bound, free = (length(problem, solution) for length in (contact_length, free_length))
    assert bound + free == pytest.approx(1, abs=1e-14)
    assert 0 < bound < 1


def test_lengths_and_places_of_a_known_contact_set(element):
    """Contact for x > 0.5 on a grid of 8: the nodes tell where it starts to half a cell."""
    problem, solution = solved(grid(8), element, **DATA)
    x = problem.contact_points[0]
    known = SimpleNamespace(**vars(solution) | {"active": x > 0.5})
    start = {"P1": 0.5625, "CR": 0.5}[element]
    assert contact_length(problem, known) == pytest.approx(1 - start)
    assert [critical_point(problem, known, 1, c) for c in "sxy"] == pytest.approx([start, start, 0])
    assert critical_point(problem, known, 2) is None


def test_a_patch_presses_with_a_known_force(element):
    """u = 1 - y: du/dnu = 1 below, and -1 above."""
    problem, solution = solved(grid(4), element, obstacle=1)
    assert flux(problem, solution) == pytest.approx(1, abs=1e-14)
    assert flux(problem, solution, through="dirichlet") == pytest.approx(-1, abs=1e-14)


@pytest.mark.parametrize("n", [8, 32])
def test_the_force_of_a_punch(element, n):
    """Its density sqrt(a^2 - x^2) has the integral pi a^2 / 2."""
    labels = ("contact", "dirichlet", "dirichlet", "dirichlet")
    mesh = grid(2 * n, n, labels, origin=(-1.0, 0.0), size=(2.0, 1.0))
    punch = ProblemStatement.from_mapping(
        {
            "domain": {},
            "boundary": {},
            "data": {},
            "load_quadrature": "exact",
            "truth": {"family": "punch", "parameters": {"half_width": 0.6}},
        }
    )
    problem = discretize_on(mesh, element, punch)
    solution = stored(problem, solve(problem), n, 1 / n)
    assert flux(problem, solution) == pytest.approx(0.18 * np.pi, abs=2 / n**2)
    assert contact_length(problem, solution) == pytest.approx(1.2, abs=2 / n)
