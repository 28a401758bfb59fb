"""Soft triangles between stiff ones, far above the obstacle: cycles feel little of them."""

from dataclasses import replace

import numpy as np
import pytest

import signorini
from rational import exact_solution, rounded
from signorini.generated.problems import instance
from signorini.solvers import solve
from signorini.solvers.attempts import attempt

X = [0.65, 1.39, 1.35, 2.67, 3.0, 1.93, 3.26, 0.0, 4.0, 2.63]
X += [0.26, 1.4, 3.96, 1.67, 1.44, 1.0, 0.39, 0.44, 0.69, 0.96]
Y = [0.13, 0.13, 0.13, 0.56, 1.0, 0.56, 1.0, 0.0, 1.0, 0.56]
Y += [0.0, 0.15, 1.0, 0.56, 0.15, 0.0, 0.13, 0.15, 0.15, 0.0]
TRIANGLES = [
    [7, 11, 19, 16, 2, 13, 10, 18, 9, 0, 0, 17, 18, 9, 5, 18, 14, 10, 19, 7, 2, 2, 5, 9],
    [0, 14, 15, 0, 1, 5, 19, 5, 8, 2, 18, 18, 9, 12, 9, 11, 3, 2, 1, 10, 14, 11, 6, 3],
    [16, 9, 1, 17, 14, 4, 2, 13, 12, 18, 17, 13, 5, 6, 6, 9, 9, 0, 2, 0, 11, 18, 4, 8],
]
SOFT = [0, 1, 4, 7, 10, 11, 12, 15, 16, 21, 22]
LOAD = [-9e-17, 1.3e-17, 2.2e-17, 3.5e-23, 2e-19, 1.3e-14, 3.6e-21, -1.7e-22, 1.2e-20, 6.6e-14]
LOAD += [5.3e-13, -8.5e-17, 3.4e-23, 6.5e-23, -1.9e-15]
LOAD += [1.2e-19, 2.8e-21, -4.5e-15, -8.9e-19, -2.4e-24]
PARTS = {
    "contact": [[1, 1, 7, 7, 10, 15, 16], [14, 15, 10, 16, 19, 19, 17]],
    "dirichlet": [[3, 4, 4, 6, 8], [8, 6, 13, 12, 12]],
}


def test_multigrid_states_no_more_than_its_corrections_show():
    """Its estimate stayed where corrections of a millionth of u were still to come."""
    mesh = signorini.triangulation((np.array([X, Y]), np.array(TRIANGLES)), PARTS)
    sides = {"contact": "contact", "dirichlet": ["dirichlet"]}
    problem = signorini.problem(mesh, "P1", f=0, **sides)
    coefficient, lower = np.ones(24), np.full(problem.contact.size, -1.0)
    coefficient[SOFT] = 1e-12
    problem = replace(problem, b=np.array(LOAD), lower=lower, coefficient=coefficient)
    solution = solve(problem, method="multigrid")
    off = np.abs(rounded(exact_solution(problem)[0]) - solution.u).max() / np.ptp(solution.u)
    assert off <= 10.0 * solution.accuracy


@pytest.mark.parametrize("family", ["inclusions", "oscillating"])
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_corrections_in_the_last_bit_of_u_are_no_reason_to_refuse(family, element):
    """They fall no further, where u varies by little more than that bit."""
    for seed in range(18):
        problem = instance(family, "degenerate", element, seed).problem
        found = attempt(problem, "multigrid")
        assert not found.applies or found.error is None, f"seed {seed}: {found.error}"
