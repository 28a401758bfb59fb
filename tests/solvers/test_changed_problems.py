"""Problems that a program has changed by hand: solved as they are, or refused by name."""

from dataclasses import replace

import numpy as np
import pytest

import signorini
from signorini.exceptions import SolverError
from signorini.solvers import solve


@pytest.fixture(params=["P1", "CR"])
def problem(request):
    sides = {"dirichlet": {"top": 0}, "contact": "bottom"}
    return signorini.problem(signorini.rectangle(4), request.param, f=-1, **sides)


def test_fewer_dofs_in_contact_are_no_whole_side(problem):
    """The fourier route knows sides alone, so that another one is taken."""
    changed = replace(problem, contact=problem.contact[:-1], lower=problem.lower[:-1])
    solution = solve(changed)
    assert solution.method == "direct"
    np.testing.assert_allclose(solution.u, solve(changed, "multigrid").u, rtol=0, atol=1e-14)
    assert solution.u[problem.contact[-1]] < -0.01


def test_fewer_fixed_dofs_are_no_whole_side(problem):
    changed = replace(problem, fixed=problem.fixed[:-1], fixed_values=problem.fixed_values[:-1])
    assert solve(changed).method == "direct"
    with pytest.raises(SolverError, match="not those of whole sides"):
        solve(changed, "fourier")


@pytest.mark.parametrize("name", ["contact", "fixed"])
@pytest.mark.parametrize("order", [slice(None, None, -1), [0, 1, 2, 2]])
def test_dofs_that_do_not_increase_are_refused(problem, name, order):
    """By the fourier route they were taken for others, and a dof that came twice had two bounds."""
    values = {"contact": "lower", "fixed": "fixed_values"}[name]
    changed = {key: getattr(problem, key)[order] for key in (name, values)}
    with pytest.raises(SolverError, match=rf"problem\.{name}: the dofs do not increase"):
        solve(replace(problem, **changed))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("b", [1.0, 2.0]),
        ("lower", [0.0] * 5),
        ("contact", np.array([0.0, 1.0])),
        ("fixed_values", np.zeros((5, 1))),
        ("coefficient", 2.0),
        ("coefficient", np.ones(7)),
    ],
)
def test_what_is_no_array_of_its_kind_is_refused(problem, name, value):
    with pytest.raises(SolverError, match=rf"problem\.{name}: "):
        solve(replace(problem, **{name: value}))
