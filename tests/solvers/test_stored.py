"""Domains and solutions as files."""

import numpy as np
import pytest

from builders import DATA, grid, statement
from signorini.exceptions import StorageError
from signorini.fem.problem import discretize_on
from signorini.mesh.domain import Rectangle, read_domain, write_domain
from signorini.solvers import solve
from signorini.solvers.stored import read_solution, write_solution

SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
DOMAIN = Rectangle((0.0, -1.0), (1.0, 2.0), "rising", "per-side", SIDES)


def test_domains_come_back(tmp_path):
    write_domain(tmp_path / "d.npz", DOMAIN)
    found = read_domain(tmp_path / "d.npz")
    assert found.level(6).same_as(DOMAIN.level(6))
    assert found.mesh_size(6) == DOMAIN.mesh_size(6)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_solutions_come_back(tmp_path, element):
    problem = discretize_on(grid(4), element, statement(**DATA))
    solution = solve(problem)
    write_solution(tmp_path / "s.npz", problem, solution, 4, 0.25)
    found = read_solution(tmp_path / "s.npz")
    for name in ("u", "multiplier", "active"):
        np.testing.assert_array_equal(getattr(found, name), getattr(solution, name))
    for name in ("residual", "accuracy", "status", "iterations", "method"):
        assert getattr(found, name) == getattr(solution, name)
        assert type(getattr(found, name)) is type(getattr(solution, name))
    assert (found.element, found.n, found.h, found.dofs) == (element, 4, 0.25, problem.free.size)
    np.testing.assert_array_equal(found.lower, problem.lower)


def test_a_domain_is_no_solution_and_a_solution_no_domain(tmp_path):
    write_domain(tmp_path / "d.npz", DOMAIN)
    with pytest.raises(StorageError, match=r"d\.npz: does not hold a solution"):
        read_solution(tmp_path / "d.npz")
    problem = discretize_on(grid(2), "P1", statement())
    write_solution(tmp_path / "s.npz", problem, solve(problem), 2, 0.5)
    with pytest.raises(StorageError, match=r"s\.npz: does not hold a domain"):
        read_domain(tmp_path / "s.npz")
