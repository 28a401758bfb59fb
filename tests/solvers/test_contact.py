"""The condensed contact solver: complementarity, finiteness, invariance, refusals."""

import subprocess
import sys

import numpy as np
import pytest
from contact_problems import (
    CYCLING,
    EPS,
    FAMILIES,
    Counted,
    assert_solved,
    degenerate,
    plain_active_set,
    spread,
)
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from signorini.exceptions import SolverError
from signorini.solvers import pivoting
from signorini.solvers.contact import DenseContact, solve_contact


def test_known_solution_where_the_plain_method_cycles():
    S, q = CYCLING
    start = np.zeros(3, dtype=bool)
    assert plain_active_set(S, q, start) is None
    for guess in (None, start, ~start):
        result = solve_contact(DenseContact(S), q, guess=guess)
        np.testing.assert_allclose(result.w, [0, 31 / 39, 49 / 117], rtol=4 * EPS)
        np.testing.assert_allclose(result.multiplier, [40 / 39, 0, 0], rtol=4 * EPS)
        assert_solved(S, q, result)


@pytest.mark.parametrize("condition", [1e1, 1e4, 1e8, 1e12])
@pytest.mark.parametrize("family", FAMILIES)
def test_every_degenerate_problem_is_solved(family, condition):
    """150 problems for each of 20 labels: all 3000 succeed."""
    rng = np.random.default_rng([int(np.log10(condition)), *family.encode()])
    for count in range(150):
        S = FAMILIES[family](rng.integers(1, 31), condition, rng)
        q = degenerate(S, rng, share=(0, 0.3, 0.9)[count % 3])
        result = solve_contact(DenseContact(S), q)
        assert_solved(S, q, result)
        assert result.iterations <= 40


@pytest.mark.parametrize(
    ("family", "condition"),
    [
        ("spread", 1e4),
        ("spread", 1e12),
        ("gapped", 1e2),
        ("needle", 1e12),
        ("obtuse", 1e12),
        ("green", 1e12),
    ],
)
def test_large_degenerate_problems(family, condition):
    rng = np.random.default_rng([300, *family.encode()])
    for share in (0, 0.3, 0.9):
        S = FAMILIES[family](300, condition, rng)
        q = degenerate(S, rng, share)
        result = solve_contact(DenseContact(S), q)
        assert_solved(S, q, result)
        assert result.iterations <= 40


def test_bounded_least_squares_agrees():
    rng = np.random.default_rng(0)
    for count in range(100):
        S = FAMILIES[("spread", "gapped", "green", "obtuse")[count % 4]](
            rng.integers(2, 25), 1e3, rng
        )
        q = degenerate(S, rng, share=0.2)
        L = np.linalg.cholesky(S)
        oracle = lsq_linear(
            L.T, np.linalg.solve(L, q), (0, np.inf), method="bvls", tol=1e-15, max_iter=1000
        )
        w = solve_contact(DenseContact(S), q).w
        unconstrained = np.max(np.abs(np.linalg.solve(S, q)))
        assert np.max(np.abs(w - oracle.x)) <= 1e-14 * np.linalg.cond(S) * unconstrained


@pytest.mark.parametrize(
    ("family", "n", "condition", "count"),
    [("gapped", 120, 1e8, 40), ("obtuse", 20, 1e12, 400)],
    ids=["combinatorial", "round-off"],
)
def test_cycles_of_the_plain_method_are_ended(family, n, condition, count):
    rng = np.random.default_rng(5)
    cycles = 0
    for _ in range(count):
        S = FAMILIES[family](n, condition, rng)
        q = degenerate(S, rng, share=0.3)
        result = solve_contact(DenseContact(S), q)
        assert_solved(S, q, result)
        assert result.iterations <= 120
        cycles += plain_active_set(S, q, q <= 0) is None
    assert cycles > 0


def test_least_index_rule_alone_is_finite(monkeypatch):
    monkeypatch.setattr(pivoting, "BLOCK_LIMITS", (0, 0, np.inf))
    rng = np.random.default_rng(6)
    singles = 0
    for family in FAMILIES:
        for _ in range(40):
            S = FAMILIES[family](12, 1e4, rng)
            q = degenerate(S, rng, share=0.3)
            result = solve_contact(
                DenseContact(S), q, guess=rng.random(12) < 0.5, max_iterations=4096
            )
            assert_solved(S, q, result)
            singles += result.single_steps
    assert singles > 0


def test_cost_is_counted():
    S, q = CYCLING
    operator = Counted(S)
    result = solve_contact(operator, q)
    assert operator.calls == result.solves
    assert result.iterations == 1 + result.block_steps + result.single_steps
    assert result.changes >= result.block_steps + result.single_steps


@pytest.mark.parametrize(
    ("load", "iterations", "solves"),
    [(-1.0, 1, 0), (1.0, 1, 1), (0.0, 1, 0)],
    ids=["full", "empty", "no load"],
)
def test_extreme_contact_sets_need_one_iteration(load, iterations, solves):
    S = 2.1 * np.eye(50) - np.eye(50, k=1) - np.eye(50, k=-1)
    result = solve_contact(DenseContact(S), np.full(50, load))
    assert (result.iterations, result.solves) == (iterations, solves)
    assert result.active.all() == (load <= 0)


@pytest.mark.parametrize("family", FAMILIES)
def test_extreme_contact_sets_from_the_opposite_guess(family):
    rng = np.random.default_rng(1)
    S = FAMILIES[family](40, 1e2, rng)
    for q, guess in ((S @ rng.uniform(1, 2, 40), True), (-rng.uniform(1, 2, 40), False)):
        result = solve_contact(DenseContact(S), q, guess=np.full(40, guess))
        assert_solved(S, q, result)
        assert result.active.all() == (not guess)
    assert result.active.any() == (not guess)


@pytest.mark.parametrize("family", FAMILIES)
def test_solution_as_guess_needs_one_solve(family):
    rng = np.random.default_rng(2)
    S = FAMILIES[family](30, 1e4, rng)
    q = degenerate(S, rng, share=0)
    first = solve_contact(DenseContact(S), q)
    again = solve_contact(DenseContact(S), q, guess=first.active)
    assert (again.iterations, again.solves, again.changes) == (1, 1, 0)
    np.testing.assert_array_equal(again.w, first.w)


def test_no_load_gives_exact_zeros():
    result = solve_contact(DenseContact(CYCLING[0]), np.zeros(3), guess=[False, True, False])
    assert not result.w.any()
    assert not result.multiplier.any()
    assert result.residual == 0


def test_no_contact_dofs():
    result = solve_contact(DenseContact(np.zeros((0, 0))), np.zeros(0))
    assert result.w.shape == result.multiplier.shape == result.active.shape == (0,)


@pytest.mark.parametrize("power", [-900, -500, -1, 1, 500, 900])
@pytest.mark.parametrize("family", FAMILIES)
def test_load_scaled_by_a_power_of_two_is_bit_identical(family, power):
    rng = np.random.default_rng(3)
    S = FAMILIES[family](30, 1e4, rng)
    q = degenerate(S, rng, share=0.3)
    base = solve_contact(DenseContact(S), q)
    scaled = solve_contact(DenseContact(S), np.ldexp(q, power))
    np.testing.assert_array_equal(scaled.w, np.ldexp(base.w, power))
    np.testing.assert_array_equal(scaled.multiplier, np.ldexp(base.multiplier, power))
    assert (scaled.iterations, scaled.residual) == (base.iterations, base.residual)


def test_dofs_scaled_by_powers_of_two_are_bit_identical():
    rng = np.random.default_rng(4)
    S = spread(20, 1e4, rng)
    q = degenerate(S, rng, share=0.3)
    powers = rng.integers(-200, 200, 20)
    base = solve_contact(DenseContact(S), q)
    scaled = solve_contact(DenseContact(np.ldexp(S, powers[:, None] + powers)), np.ldexp(q, powers))
    np.testing.assert_array_equal(scaled.w, np.ldexp(base.w, -powers))
    np.testing.assert_array_equal(scaled.multiplier, np.ldexp(base.multiplier, powers))


def test_subnormal_load_keeps_the_contact_set():
    S, q = CYCLING
    result = solve_contact(DenseContact(S), np.ldexp(q, -1060))
    np.testing.assert_array_equal(result.active, [True, False, False])
    np.testing.assert_allclose(np.ldexp(result.w, 1060), [0, 31 / 39, 49 / 117], atol=2.0**-14)


def test_gap_beyond_the_largest_number_is_refused():
    with pytest.raises(SolverError, match="overflow"):
        solve_contact(DenseContact([[2.0**-600]]), [2.0**600])


@pytest.mark.parametrize("family", FAMILIES)
def test_renumbering_the_dofs(family):
    rng = np.random.default_rng(7)
    S = FAMILIES[family](60, 1e2, rng)
    q = degenerate(S, rng, share=0.3)
    order = rng.permutation(60)
    w = solve_contact(DenseContact(S), q).w
    renumbered = solve_contact(DenseContact(S[np.ix_(order, order)]), q[order]).w
    np.testing.assert_allclose(renumbered, w[order], rtol=0, atol=1e-12 * w.max())


entries = st.one_of(st.integers(-4, 4).map(float), st.floats(-1, 1, allow_subnormal=False))


@settings(deadline=None, max_examples=300, derandomize=True)
@given(data=st.data(), n=st.integers(1, 8), ridge=st.sampled_from([1.0, 1e-3, 1e-6]))
def test_any_problem_satisfies_complementarity(data, n, ridge):
    B = np.array(data.draw(st.lists(entries, min_size=n * n, max_size=n * n))).reshape(n, n)
    q = np.array(data.draw(st.lists(entries, min_size=n, max_size=n)))
    guess = np.array(data.draw(st.lists(st.booleans(), min_size=n, max_size=n)))
    S = B @ B.T + ridge * np.eye(n)
    assert_solved(S, q, solve_contact(DenseContact(S), q, guess=guess), tolerance=1e-12)


def test_importing_the_solver_does_not_import_scipy():
    code = "import sys, signorini.solvers.contact; sys.exit('scipy' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, env={"PYTHONPATH": ":".join(sys.path)})
