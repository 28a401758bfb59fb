"""The petsc route: equal to the others, with its own proof; a clear word where it is absent."""

import importlib.util

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini import discretize, load_scene
from signorini.exceptions import NotApplicableError
from signorini.fem.problem import discretize_on
from signorini.solvers import petsc, solve
from signorini.solvers.routes import METHODS

needs_petsc = pytest.mark.skipif(petsc.why_not(None) is not None, reason="make petsc installs it")
ABSENT = "solver.method: petsc does not apply, without .*: `make petsc` installs"
SCENES = [("paper", 16), ("punch", 16), ("l-shape", 8), ("inclusion", 16), ("ceiling", 16)]


def equal(ours, theirs, size):
    np.testing.assert_allclose(theirs, ours, rtol=0, atol=1e-9 * size)


@needs_petsc
@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize(("scene", "n"), SCENES)
def test_the_solution_is_ours(scene, n, element):
    problem = discretize(load_scene(f"config/scenes/{scene}.yaml"), element, n)
    ours, theirs = solve(problem, "direct"), solve(problem, "petsc")
    equal(ours.u, theirs.u, np.ptp(ours.u))
    equal(ours.multiplier, theirs.multiplier, np.abs(ours.multiplier).max())
    np.testing.assert_array_equal(ours.active, theirs.active)
    assert theirs.status == "solved"
    assert theirs.residual <= 1e-13


@needs_petsc
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_body_that_contact_alone_holds(element):
    mesh = delaunay(0, labels=("contact", "neumann", "neumann", "neumann"))
    problem = discretize_on(mesh, element, statement(f="-1", obstacle="0"))
    ours, theirs = solve(problem, "direct"), solve(problem, "petsc")
    equal(ours.u, theirs.u, np.ptp(ours.u))
    assert theirs.status == "solved"


@needs_petsc
def test_any_guess_leads_to_the_same_contact_set():
    problem = discretize_on(grid(16), "CR", statement(**DATA))
    plain = solve(problem, "petsc")
    for binds in (False, True):
        guess = np.full(problem.contact.size, binds)
        guessed = solve(problem, "petsc", guess=guess)
        np.testing.assert_array_equal(guessed.active, plain.active)
        equal(plain.u, guessed.u, np.ptp(plain.u))


@needs_petsc
def test_the_estimates_cover_the_errors():
    """Against the direct route, whose own error is far below these."""
    for element in ("P1", "CR"):
        problem = discretize_on(delaunay(3), element, statement(**DATA))
        ours, theirs = solve(problem, "direct"), solve(problem, "petsc")
        error = np.abs(ours.u - theirs.u).max() / np.ptp(ours.u)
        assert error <= ours.accuracy + theirs.accuracy
        assert theirs.accuracy <= 1e-12


def test_without_petsc_the_way_to_it_is_told(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    problem = discretize_on(grid(2), "P1", statement(**DATA))
    with pytest.raises(NotApplicableError, match=ABSENT):
        solve(problem, "petsc")


def test_no_other_route_needs_it():
    assert "petsc" not in METHODS
