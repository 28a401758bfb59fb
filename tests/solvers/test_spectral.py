"""The contact matrix of a grid in its trigonometric basis, against the same matrix as an array."""

import numpy as np
import pytest

from signorini.exceptions import SolverError
from signorini.solvers import transforms
from signorini.solvers.contact import DenseContact, solve_contact
from signorini.solvers.spectral import SpectralContact, contact_operator
from signorini.work import counting

BASES = ("vertex_cosines", "vertex_sines", "midpoint_cosines", "midpoint_sines")
# The symbol of a half plane is the root of the second difference; the second one has constants for
# a kernel.
SYMBOLS = {"held": lambda e: np.sqrt(e + 1e-3), "floating": lambda e: np.sqrt(e)}


@pytest.fixture(params=[17, 150])
def size(request):
    return request.param


@pytest.fixture(params=BASES)
def basis(request, size):
    return getattr(transforms, request.param)(size)


@pytest.fixture
def spectral(basis):
    return SpectralContact(basis, SYMBOLS["held"](basis.eigenvalues))


@pytest.fixture
def dense(spectral):
    S = spectral.apply(np.eye(spectral.size))
    return DenseContact(0.5 * (S + S.T))


def free_masks(size):
    rng = np.random.default_rng(size)
    one = np.zeros(size, dtype=bool)
    one[size // 3] = True
    return [np.ones(size, dtype=bool), one, rng.random(size) < 0.5, np.arange(size) < size // 2]


def test_products_are_those_of_a_symmetric_positive_matrix(spectral, dense):
    S = spectral.apply(np.eye(spectral.size))
    np.testing.assert_allclose(S, S.T, rtol=0, atol=1e-13)
    assert np.linalg.eigvalsh(dense.S)[0] > 0
    w = np.random.default_rng(0).standard_normal(spectral.size)
    np.testing.assert_allclose(spectral.apply(w), dense.apply(w), rtol=0, atol=1e-13)


def test_bounds_hold(spectral, dense):
    w = np.random.default_rng(0).standard_normal(spectral.size)
    assert np.all(np.abs(spectral.apply(w)) <= spectral.apply_abs(w) * (1 + 1e-12))
    ratio = spectral.diagonal() / dense.diagonal()
    assert np.all((ratio > 0.3) & (ratio < 3))
    assert spectral.band >= np.finfo(float).eps


def test_free_dofs_are_solved_to_rounding(spectral, dense):
    rng = np.random.default_rng(1)
    for free in free_masks(spectral.size):
        rhs = rng.standard_normal(free.sum())
        x = spectral.solve_free(free, rhs)
        np.testing.assert_allclose(
            x, dense.solve_free(free, rhs), rtol=0, atol=1e-11 * np.abs(x).max()
        )


def test_the_last_answer_starts_the_next_solve(spectral):
    free = np.arange(spectral.size) < spectral.size // 2
    rhs = np.random.default_rng(0).standard_normal(free.sum())
    with counting() as cold:
        first = spectral.solve_free(free, rhs)
    with counting() as warm:
        again = spectral.solve_free(free, rhs)
    assert warm.inner <= 10
    assert cold.inner > warm.inner
    np.testing.assert_allclose(again, first, rtol=0, atol=1e-13 * np.abs(first).max())


@pytest.mark.parametrize(
    ("name", "symbol"),
    [(name, "held") for name in BASES] + [(name, "floating") for name in BASES if "cos" in name],
)
def test_contact_problems_have_the_solution_of_the_array(name, symbol, size):
    basis = getattr(transforms, name)(size)
    spectral = SpectralContact(basis, SYMBOLS[symbol](basis.eigenvalues))
    S = spectral.apply(np.eye(spectral.size))
    rng = np.random.default_rng(0)
    for _ in range(5):
        q = rng.standard_normal(spectral.size)
        q -= q.mean() + 0.1
        results = [
            solve_contact(operator, q, singular=symbol == "floating")
            for operator in (spectral, DenseContact(0.5 * (S + S.T)))
        ]
        assert results[0].residual < 1e-12
        np.testing.assert_array_equal(results[0].active, results[1].active)
        np.testing.assert_allclose(
            results[0].w, results[1].w, rtol=0, atol=1e-10 * results[1].w.max()
        )


@pytest.mark.parametrize(
    ("n", "kind"), [(95, DenseContact), (96, SpectralContact), (1024, SpectralContact)]
)
def test_an_array_is_formed_where_it_is_small(n, kind):
    basis = transforms.vertex_cosines(n)
    assert type(contact_operator(basis, SYMBOLS["held"](basis.eigenvalues))) is kind


def test_steps_do_not_grow_with_the_line():
    """The preconditioner's purpose: as many products at 4096 dofs as at 256, give or take a few."""
    products = {}
    for n in (256, 4096):
        basis = transforms.midpoint_cosines(n)
        spectral = SpectralContact(basis, SYMBOLS["held"](basis.eigenvalues))
        with counting() as work:
            spectral.solve_free(np.arange(n) < n // 3, np.ones(n // 3))
        products[n] = work.inner
    assert products[4096] <= 1.5 * products[256] + 5


def test_a_matrix_that_is_not_positive_is_refused():
    basis = transforms.vertex_cosines(200)
    spectral = SpectralContact(basis, np.where(np.arange(201) % 2, 1.0, -1.0))
    with pytest.raises(SolverError, match="conjugate gradients stopped"):
        spectral.solve_free(np.arange(201) < 100, np.random.default_rng(0).standard_normal(100))
