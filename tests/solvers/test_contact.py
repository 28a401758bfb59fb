"""The condensed contact solver: complementarity, finiteness, invariance, refusals."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from signorini.exceptions import SolverError
from signorini.solvers import pivoting
from signorini.solvers.contact import DenseContact, solve_contact

EPS = np.finfo(float).eps
CYCLING = np.array([[11.0, -11, 9], [-11, 17, -6], [9, -6, 9]]), np.array([-6.0, 11, -1])


def rotated(eigenvalues, rng):
    """A full matrix of the given spectrum: no sign pattern, no M-matrix."""
    Q = np.linalg.qr(rng.standard_normal((eigenvalues.size, eigenvalues.size)))[0]
    S = (Q * eigenvalues) @ Q.T
    return 0.5 * (S + S.T)


def spread(n, condition, rng):
    return rotated(np.geomspace(1, 1 / condition, n) if n > 1 else np.ones(1), rng)


def gapped(n, condition, rng):
    return rotated(np.where(np.arange(n) <= n // 2, 1, 1 / condition), rng)


def needle(n, condition, rng):
    """Dofs of very different size: a well-conditioned matrix between graded diagonals."""
    d = np.geomspace(1, condition**-0.5, n)
    return d[:, None] * rotated(rng.uniform(0.1, 10, n), rng) * d


def obtuse(n, condition, rng):
    """A chain held at both ends with edge lengths over many scales; couplings of either sign."""
    k = np.exp(rng.uniform(0, np.log(condition), n + 1))
    couple = np.diag(k[1:-1] * rng.choice([-1, 1], n - 1), 1)
    return np.diag(k[:-1] + k[1:]) + couple + couple.T


def green(n, condition, rng):
    """The inverse of a chain: every entry positive, as far from an M-matrix as can be."""
    x = np.cumsum(np.exp(rng.uniform(-np.log(condition) / 4, 0, n)))
    return np.minimum.outer(x, x)


FAMILIES = {family.__name__: family for family in (spread, gapped, needle, obtuse, green)}


def degenerate(S, rng, share):
    """A load whose solution is known; `share` of the dofs have neither gap nor force."""
    n = len(S)
    w = np.maximum(rng.standard_normal(n), 0)
    force = np.where(w > 0, 0, rng.uniform(0, 1, n))
    biactive = rng.random(n) < share
    w[biactive] = force[biactive] = 0
    return S @ w - force


def natural_residual(S, q, w):
    d = np.sqrt(S.diagonal())
    size = max(np.max(w * d), np.max(np.abs(q) / d))
    return np.max(np.abs(np.minimum(w * d, (S @ w - q) / d))) / size


def assert_solved(S, q, result, tolerance=1e-9):
    assert np.all(result.w >= 0)
    assert np.all(result.multiplier >= 0)
    assert np.all(result.w * result.multiplier == 0)
    np.testing.assert_array_equal(result.active, result.w == 0)
    if np.any(q):
        assert natural_residual(S, q, result.w) <= tolerance
        assert result.residual <= tolerance


def plain_active_set(S, q, active, limit=100):
    """The unsafeguarded primal-dual active set method: None where it revisits a set."""
    seen = set()
    while active.tobytes() not in seen and len(seen) < limit:
        seen.add(active.tobytes())
        w, free = np.zeros(len(q)), ~active
        w[free] = np.linalg.solve(S[np.ix_(free, free)], q[free])
        change = np.where(active, S @ w - q < 0, w < 0)
        if not change.any():
            return w
        active = active ^ change
    return None


class Counted(DenseContact):
    calls = 0

    def solve_free(self, free, rhs):
        self.calls += 1
        return super().solve_free(free, rhs)


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


def floating_chain(n, rng):
    k = rng.uniform(0.1, 1, n - 1)
    return np.diag(np.append(k, 0) + np.append(0, k)) - np.diag(k, 1) - np.diag(k, -1)


def floating_strip(n, rng):
    """A strip without Dirichlet side, condensed to one side: diagonal in the cosine basis."""
    k = np.arange(n)
    C = np.cos(np.pi * np.outer(k + 0.5, k) / n) * np.sqrt((2 - (k == 0)) / n)
    S = (C * np.sin(0.5 * np.pi * k / n)) @ C.T
    return 0.5 * (S + S.T)


@pytest.mark.parametrize("floating", [floating_chain, floating_strip])
@pytest.mark.parametrize("n", [2, 3, 30, 200])
def test_body_held_by_contact_alone(floating, n):
    rng = np.random.default_rng(n)
    S = floating(n, rng)
    for count in range(20):
        w = np.maximum(rng.standard_normal(n), 0)
        w[rng.integers(n)] = 0
        q = S @ w - np.where(w > 0, 0, rng.uniform(0.1, 1, n))
        guess = (None, np.zeros(n, dtype=bool), rng.random(n) < 0.5)[count % 3]
        result = solve_contact(DenseContact(S), q, guess=guess, singular=True)
        assert_solved(S, q, result)
        np.testing.assert_allclose(result.w, w, rtol=0, atol=1e-10 * max(w.max(), 1))
        assert result.multiplier.sum() == pytest.approx(-q.sum(), rel=1e-10)
        assert result.active.any()


def test_lone_dof_carries_the_load_of_a_floating_body():
    result = solve_contact(DenseContact([[-1e-17]]), [-2.0], singular=True)
    assert (result.w, result.multiplier) == (0, 2)


@pytest.mark.parametrize("pull", [0.0, 1.0], ids=["balanced", "lifted"])
def test_body_not_pressed_on_the_contact_is_refused(pull):
    with pytest.raises(SolverError, match="no unique solution"):
        solve_contact(DenseContact(floating_strip(4, None)), [1.0, -1.0, pull, 0.0], singular=True)


@pytest.mark.parametrize("floating", [floating_chain, floating_strip])
@pytest.mark.parametrize("n", [2, 30, 300])
def test_kernel_that_was_not_announced_is_refused(floating, n):
    S = floating(n, np.random.default_rng(0))
    with pytest.raises(SolverError, match="singular"):
        solve_contact(DenseContact(S), np.ones(n))


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_values_that_are_not_finite_are_refused(bad):
    S = CYCLING[0]
    with pytest.raises(SolverError, match=r"q .* finite; it is not at index \[1\]"):
        solve_contact(DenseContact(S), [1.0, bad, 0.0])
    with pytest.raises(SolverError, match=r"S .* finite; it is not at index \[0, 2\]"):
        DenseContact(np.where(np.arange(9).reshape(3, 3) == 2, bad, S))


@pytest.mark.parametrize(
    ("S", "q", "guess", "message"),
    [
        (np.ones((2, 3)), np.ones(2), None, "square"),
        ([[1.0, 2.0], [0.0, 1.0]], np.ones(2), None, "symmetric"),
        (np.eye(2), np.ones(3), None, "shapes"),
        (np.eye(2), np.ones(2), [True], "shapes"),
        (-np.eye(2), np.ones(2), None, "diag S <= 0"),
        ([[1.0, 2.0], [2.0, 1.0]], np.ones(2), None, "indefinite"),
    ],
)
def test_data_that_do_not_fit_are_refused(S, q, guess, message):
    with pytest.raises(SolverError, match=message):
        solve_contact(DenseContact(S), q, guess=guess)


def test_iteration_limit_is_named():
    S, q = CYCLING
    with pytest.raises(SolverError, match="in 1 iterations: 1 dofs violated"):
        solve_contact(DenseContact(S), q, guess=np.ones(3, dtype=bool), max_iterations=1)


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
