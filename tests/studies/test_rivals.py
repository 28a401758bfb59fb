"""Rivals: every one that is installed agrees with ours; one that fails or is absent says so."""

import subprocess
import sys

import numpy as np
import pytest

from builders import DATA, delaunay, statement
from signorini.fem.problem import discretize_on
from signorini.generated.problems import instance
from signorini.rivals import RIVALS, BoundProblem, Rival, active_set
from signorini.solvers import kkt_residual, solve


@pytest.fixture(params=["P1", "CR"])
def problem(request):
    return discretize_on(delaunay(0), request.param, statement(**DATA))


@pytest.mark.parametrize("rival", RIVALS.values(), ids=RIVALS)
def test_a_rival_agrees(problem, rival):
    if not rival.available():
        pytest.skip(rival.install)
    answer = rival.solve(problem)
    ours = solve(problem).u
    np.testing.assert_allclose(answer.u, ours, rtol=0, atol=1e-6 * np.abs(ours).max())
    assert kkt_residual(problem, answer.u)[0] < 1e-7
    assert answer.iterations > 0


@pytest.mark.parametrize("name", ["spsolve", "superlu", "bvls"])
def test_scipy_claims_what_it_reaches(problem, name):
    answer = RIVALS[name].solve(problem)
    assert answer.claimed
    assert kkt_residual(problem, answer.u)[0] < 1e-13


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_bound_problem_is_the_problem(element):
    """Its minimiser with the contact set held is ours."""
    problem = discretize_on(delaunay(1), element, statement(**DATA))
    solution, qp = solve(problem), BoundProblem.of(problem)
    x = solution.u[problem.free]
    force = qp.K @ x - qp.f
    np.testing.assert_allclose(force[qp.contact], solution.multiplier, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(qp.bounds[qp.contact], problem.lower)
    force[qp.contact] = 0
    np.testing.assert_allclose(force, 0, rtol=0, atol=1e-12)
    assert np.isneginf(qp.bounds).sum() == problem.free.size - problem.contact.size


@pytest.mark.parametrize("name", ["spsolve", "superlu"])
def test_the_plain_active_set_method_cycles_on_degenerate_data(name):
    """Neither gap nor force anywhere on the contact part: signs are round-off, and some of them
    never settle.
    """
    problems = [
        instance("perturbed", "degenerate", element, k).problem
        for element in ("P1", "CR")
        for k in range(4)
    ]
    answers = [RIVALS[name].solve(problem) for problem in problems]
    assert any(not answer.claimed and answer.iterations == 100 for answer in answers)


def test_a_rival_that_raises_gives_no_answer(problem, monkeypatch):
    def broken(qp):
        raise RuntimeError("factorisation failed")

    monkeypatch.setattr(active_set, "spsolve", broken)
    answer = RIVALS["spsolve"].solve(problem)
    assert np.isnan(answer.u).all()
    assert not answer.claimed
    assert kkt_residual(problem, answer.u)[0] == np.inf


def test_a_rival_that_is_absent_says_what_to_install():
    rival = Rival(
        "absent", "absent", "no_such_package", "pip install no-such-package", "quadratic:osqp"
    )
    assert not rival.available()


def test_nothing_foreign_is_imported_before_it_is_asked_for():
    program = (
        "import sys, signorini.rivals; "
        "sys.exit(bool({'scipy', 'osqp', 'pyamg', 'ngsolve'} & set(sys.modules)))"
    )
    subprocess.run(
        [sys.executable, "-c", program], check=True, env={"PYTHONPATH": "src", "PATH": ""}
    )
