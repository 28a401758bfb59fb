"""Signorini's inequality condensed to the contact dofs, by safeguarded block principal pivoting.

Find ``w >= 0`` with ``multiplier = S w - q >= 0`` and ``w . multiplier = 0``: `w` is the gap ``u -
lower`` on the contact dofs, `S` the stiffness with every other dof eliminated. The plain
primal-dual active set method (Hintermüller, Ito & Kunisch, SIAM J. Optim. 13, 2002) moves every dof
of violated sign to the other side; it cycles where `S` is no M-matrix or degenerate signs are
round-off. So signs count only beyond a dead band of rounding size, and exchanges shrink when they
stop paying (Júdice & Pires, Comput. Oper. Res. 21, 1994), at last to the least-index rule, finite
for every positive definite `S` (Murty, Opsearch 11, 1974).
"""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.pivoting import PivotingRule
from signorini.work import count

TOLERANCE = 1e-9  # natural residual above which there is no solution to return


@dataclass(frozen=True)
class ContactResult:
    """Solution of the condensed contact problem, with its proof and its cost.

    Attributes
    ----------
    w, multiplier : ndarray, shape (n,)
        Gap, in units of `u`, and ``S w - q``, in units of `q`; both >= 0, one of each pair exactly
        zero.
    active : ndarray of bool, shape (n,)
        The contact set ``w == 0``.
    residual : float
        ``max |min(w d, (S w - q) / d)|`` over ``max(w d, |q| / d)``, ``d = sqrt(diag S)``;
        dimensionless.
    iterations, solves : int
        Active sets examined; linear systems solved (none where no dof is free).
    block_steps, single_steps, changes : int
        Exchanges of all or half of the violated dofs; exchanges of one; dofs exchanged in total.
    """

    w: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    residual: float
    iterations: int
    solves: int
    block_steps: int
    single_steps: int
    changes: int


class DenseContact:
    """A condensed contact matrix `S` held as an array, shape (n, n), symmetric positive
    (semi)definite.

    Any object with these methods, `size` (number of dofs) and `band` (relative rounding error of
    `w` and ``S w - q``) serves: one diagonal in a cosine basis may solve by conjugate gradients
    from its last answer.
    """

    def __init__(self, S):
        S = _finite("S", S)
        if S.shape != (len(S), len(S)) or np.any(
            np.abs(S - S.T) > 1e-8 * np.max(np.abs(S), initial=0)
        ):
            raise SolverError(f"contact matrix S, shape {S.shape}, must be square and symmetric")
        self.S, self.absS = S, np.abs(S)
        self.size, self.band = len(S), len(S) * np.finfo(float).eps

    def diagonal(self):
        """Diagonal of `S`, shape (n,).

        Examples
        --------
        >>> DenseContact(np.array([[2.0, -1.0], [-1.0, 3.0]])).diagonal()
        array([2., 3.])
        """
        return self.S.diagonal()

    def apply(self, w):
        """Product ``S w``, shape (n,).

        Examples
        --------
        >>> DenseContact(np.diag([2.0, 3.0])).apply(np.array([1.0, 1.0]))
        array([2., 3.])
        """
        count(inner=1)
        return self.S @ w

    def apply_abs(self, w):
        """Product ``|S| |w|``, shape (n,), or a bound of that order: the size of the terms of ``S
        w``.

        Examples
        --------
        >>> DenseContact(np.array([[2.0, -1.0], [-1.0, 2.0]])).apply_abs(np.array([1.0, -1.0]))
        array([3., 3.])
        """
        return self.absS @ np.abs(w)

    def solve_free(self, free, rhs):
        """Solve ``S[free, free] x = rhs`` by Cholesky's method and a step of iterative refinement.

        Parameters
        ----------
        free : ndarray of bool, shape (n,)
        rhs : ndarray, shape (free.sum(),)
            Unit of the load.

        Returns
        -------
        ndarray, shape (free.sum(),)
            Unit of u.

        Raises
        ------
        SolverError
            Unless the block is positive definite beyond rounding.

        Examples
        --------
        >>> S = DenseContact(np.array([[2.0, -1.0], [-1.0, 2.0]]))
        >>> S.solve_free(np.array([True, False]), np.array([1.0]))
        array([0.5])
        """
        K = self.S[np.ix_(free, free)]
        try:
            L = np.linalg.cholesky(K)
        except np.linalg.LinAlgError:
            L = np.zeros_like(K)
        if np.any(L.diagonal() ** 2 <= self.band * K.diagonal()):
            raise SolverError(
                f"domain: contact matrix S is singular or indefinite on {len(K)} free dofs; "
                "stretch cells less"
            )
        x = np.zeros_like(rhs)
        for _ in ("solve", "refine"):
            y = _back_substitute(L[::-1, ::-1], (rhs - K @ x)[::-1])[::-1]
            x = x + _back_substitute(L.T, y)
        return x


def solve_contact(operator, q, guess=None, max_iterations=200, singular=False):
    """Solve ``w >= 0``, ``S w - q >= 0``, ``w . (S w - q) = 0``.

    Parameters
    ----------
    operator : DenseContact
        The matrix `S`, or any object with that interface.
    q : array_like, shape (n,)
        Condensed load minus ``S lower``, in units of the load.
    guess : array_like of bool, shape (n,), optional
        Contact set to start from, such as a coarser level's; by default ``q <= 0``.
    max_iterations : int
        Active sets to examine before giving up.
    singular : bool
        True if the constants are the kernel of `S` (no Dirichlet side): some dof is always in
        contact.

    Returns
    -------
    ContactResult

    Raises
    ------
    SolverError
        If the data are not finite or do not fit, `S` is not positive definite, `singular` and
        ``sum(q) >= 0`` (no unique solution), or the iteration ends without a solution.

    Examples
    --------
    The second dof is pulled against the obstacle:

    >>> S = DenseContact(np.array([[2.0, -1.0], [-1.0, 2.0]]))
    >>> result = solve_contact(S, np.array([1.0, -2.0]))
    >>> result.w, result.multiplier
    (array([0.5, 0. ]), array([0. , 1.5]))
    >>> result.active
    array([False,  True])
    """
    q = _finite("q", q)
    # A lone dof of a floating body carries the whole load, whatever round-off its S is.
    diag = np.ones(1) if singular and operator.size == 1 else operator.diagonal()
    active = q <= 0 if guess is None else np.array(guess, dtype=bool)
    if not (q.shape == active.shape == diag.shape and np.all(diag > 0)):
        raise SolverError(
            f"shapes q {q.shape}, guess {active.shape}, S {diag.shape} differ, or diag S <= 0"
        )
    weight = np.sqrt(diag)
    # The load is scaled by a power of two to the size of the weights, so that nothing overflows.
    shift = -int(np.max((np.frexp(q)[1] - np.frexp(weight)[1])[q != 0], initial=-2000))
    load = np.ldexp(q, shift)
    if singular and np.sum(load) >= 0:
        raise SolverError(
            "no unique solution: without a dirichlet part of the boundary "
            "sum(q), the load left, must be negative"
        )
    w, *cost = _pivot(operator, load, weight, active, max_iterations, singular)
    force = operator.apply(w) - load
    size = np.max([w * weight, np.abs(load) / weight], initial=np.finfo(float).tiny)
    residual = float(np.max(np.abs(np.minimum(w * weight, force / weight)), initial=0) / size)
    with np.errstate(over="ignore"):
        pair = np.ldexp([w, np.where(w > 0, 0.0, np.maximum(force, 0))], -shift)
    if not (residual <= TOLERANCE and np.isfinite(pair).all()):
        raise SolverError(
            f"contact solve left the residual {residual:.1e}: S ill-conditioned, or overflow"
        )
    return ContactResult(*pair, w == 0, residual, *cost)


def _pivot(operator, load, weight, active, max_iterations, singular):
    """The gap w, and what it cost: see `ContactResult` from `iterations` on."""
    rule, solves = PivotingRule(), 0
    for iteration in range(1, max_iterations + 1):
        count(steps=1)
        if singular and not active.any():
            active[np.argmin(load / weight)] = True
        # The equation holds with this set: no gap in contact, no force apart from the obstacle.
        w, free = np.zeros_like(load), ~active
        if free.any():
            w[free] = operator.solve_free(free, load[free])
            solves += 1
        force, gap = operator.apply(w) - load, w * weight
        # The inequality is looked at afterwards. A sign counts only beyond the dead band, what
        # rounding of the terms may do: a smaller one could change for ever.
        band = rule.slack * operator.band
        pulling = force < -band * (operator.apply_abs(w) + np.abs(load))
        penetrating = gap < -band * np.max(np.abs(gap), initial=0)
        wrong = np.where(active, pulling, penetrating)
        if not wrong.any():
            block_steps, single_steps = sum(rule.steps[:2]), rule.steps[2]
            return np.maximum(w, 0), iteration, solves, block_steps, single_steps, rule.changes
        depth = np.where(active, force / weight, gap)
        active[rule.choose(active, wrong, depth)] ^= True
    raise SolverError(
        f"no contact set in {max_iterations} iterations: {rule.fewest} dofs violated at best"
    )


def _back_substitute(U, b, block=64):
    # LU of an upper triangle never pivots, so the general solve of each block is plain back
    # substitution.
    x = b.copy()
    for end in range(len(x), 0, -block):
        rows = slice(max(end - block, 0), end)
        x[rows] = np.linalg.solve(U[rows, rows], x[rows] - U[rows, end:] @ x[end:])
    return x


def _finite(name, values):
    bad = np.argwhere(~np.isfinite(values))[:1].tolist()
    if bad:
        raise SolverError(
            f"{name} of the contact problem must be finite; it is not at index {bad[0]}"
        )
    return np.asarray(values, dtype=float)
