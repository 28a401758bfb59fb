"""Solved levels of shipped scenes, solved once for all tests of the room."""

from functools import cache
from types import SimpleNamespace

import pytest

import signorini
from signorini.certificate.certify import certify_level
from signorini.errors.exact import ExactErrors


@cache
def solved(name, n):
    """Both elements of a shipped scene on one level: problems, solutions, errors where known."""
    scene = signorini.load_scene(f"config/scenes/{name}.yaml")
    problems = {element: scene.problem(element, n) for element in ("P1", "CR")}
    u = {element: signorini.solve(problem).u for element, problem in problems.items()}
    mesh, data = problems["CR"].mesh, problems["CR"].data
    exact, errors = scene.problem_statement.exact, {}
    if exact is not None:
        measure = ExactErrors(exact, ["energy", "l2"])
        errors = {element: measure.of(mesh, element, values) for element, values in u.items()}
    return SimpleNamespace(mesh=mesh, data=data, u=u, errors=errors, problems=problems)


@cache
def certified(name, n):
    """The certificates of both elements, and their enclosure."""
    level = solved(name, n)
    return certify_level(level.mesh, level.data, level.u["P1"], level.u["CR"])


@pytest.fixture(scope="session")
def level():
    """From a scene and n to what `solved` gives."""
    return solved


@pytest.fixture(scope="session")
def certificates():
    """From a scene and n to what `certified` gives."""
    return certified
