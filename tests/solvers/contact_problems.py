"""Condensed contact problems with known solutions, and what a solution of one must be."""

import numpy as np

from signorini.solvers.contact import DenseContact

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
