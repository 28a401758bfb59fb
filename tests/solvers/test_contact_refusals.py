"""The condensed contact solver: bodies that contact alone holds, and what is refused."""

import numpy as np
import pytest
from contact_problems import CYCLING, assert_solved

from signorini.exceptions import SolverError
from signorini.solvers.contact import DenseContact, solve_contact


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
