"""The direct route: one sparse factorisation, the inequality on the condensed contact matrix. The others' oracle.

The dofs are ordered by nested dissection with the contact dofs last, so that the trailing block of the factors is the
Schur complement S on them: neither a second factorisation nor a solve per contact dof is needed. A spring as stiff as
S on each contact dof, taken off S again, keeps the factors well conditioned where only the inequality, or a weak part
of the body, holds it.

The factors are a guess at A's inverse, no more: on stretched cells and across jumps of the coefficient they lose
digits. So every solution is refined with residuals by differences until the corrections stop falling, its errors are
estimated, and the contact set is held against the forces and gaps that come out of it.
"""

import numpy as np

from signorini.assembly import stiffness_errors
from signorini.elements import element as find_element
from signorini.exceptions import SolverError
from signorini.memory import DIRECT, check_memory
from signorini.mesh.grid import Grid
from signorini.solvers.contact import DenseContact, Exchange, solve_contact
from signorini.solvers.count import count
from signorini.solvers.found import NO_DIGIT, Errors, better, bound_of, proved, to_close, wrong_signs
from signorini.solvers.hierarchy import STRETCHED, causes, jumps
from signorini.solvers.residual import BELOW, EPS, residual, residual_and_fluxes, rounding_of

_LEAF = 8
_MAX_STEPS = 100
_STRICT = 10  # steps in which signs count that may be rounding
_CORRECTIONS, _STEPS = 10, 40
_SMALL = 1e-6  # a correction of which share of u needs no other
_STALLED = 0.7  # of the correction before
_MISSED = 4.0 * EPS
_SAMPLES = 2  # random signs of the rounding errors whose effect is looked at


def solve_direct(problem, guess=None):
    """Solve any problem; arguments and errors as in `solvers.fourier.solve_fourier`.

    Returns
    -------
    Found
    """
    check_memory(problem.mesh.number_of_triangles, DIRECT[problem.element], "a mesh for solver.method direct")
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    if not problem.free.size:
        nothing = np.zeros(0)
        return proved(u, nothing > 0.0, 0, nothing, nothing, Errors(0.0, 0.0, *[nothing] * 4, 0.0))
    u[problem.contact] = problem.lower
    body = _Body(problem)
    active, iterations = body.contact_set(u, guess)
    rule, first = Exchange(), None
    for step in range(_MAX_STEPS):
        u, gap, force, left = body.refined(u, active)
        errors = body.errors(u, active, left)
        wrong = wrong_signs(active, gap, force, errors, np.ptp(u) if step < _STRICT and first is None else None)
        if not wrong.any():
            if not errors.u <= NO_DIGIT * np.ptp(u):
                raise SolverError(_why_singular(problem))
            found, near = proved(u, active, iterations, gap, force, errors), to_close(u, active, gap, errors)
            if first is not None or not near.any():
                return better(first, found)
            first, u, active = found, u.copy(), active | near
            continue
        iterations += 1
        active[rule.choose(active, wrong, np.where(active, force, gap))] ^= True
    raise SolverError(
        f"direct: no contact set in {_MAX_STEPS} steps, {rule.fewest} signs wrong at best; {causes(problem)}"
    )


class _Body:
    """A problem with its factors: what loads do to it, with a contact set held."""

    def __init__(self, problem):
        self.problem, self.condensed = problem, Condensed(problem)
        if np.any(self.condensed.S.diagonal() <= 0.0):
            raise SolverError(_why_singular(problem))
        self.operator = DenseContact(self.condensed.S) if problem.contact.size else None
        stretched = not isinstance(problem.mesh, Grid) and problem.mesh.stretch > STRETCHED
        self.inexact = _inexact(problem) if stretched else None
        self.even = not (stretched or jumps(problem.coefficient))

    def contact_set(self, u, guess):
        """A first contact set, from the condensed problem alone, and the steps it took."""
        if self.operator is None:
            return np.zeros(0, dtype=bool), 0
        problem = self.problem
        q = self.condensed.reduce(residual(problem.A, problem.b, u))
        result = solve_contact(self.operator, q, guess=guess, singular=problem.fixed.size == 0)
        return result.active, result.iterations

    def refined(self, u, active):
        """The solution with a contact set held, refined until corrections stop falling.

        Returns
        -------
        u : ndarray, shape (ndof,)
        gap, force : ndarray, shape (nc,)
        left : (float, float)
            What further corrections might do to u and to a force.
        """
        problem = self.problem
        u[problem.contact[active]] = problem.lower[active]
        u = u + self.displacement(residual(problem.A, problem.b, u), active)[0]
        for _ in range(_CORRECTIONS):
            correction, force, left = self._correction(u, active)
            u = u + correction
            if _largest(correction) <= _SMALL * np.ptp(u):
                break
        return u, u[problem.contact] - problem.lower, force, left

    def _correction(self, u, active):
        """What is missing of u, by conjugate gradients with the factors; the forces then; what may still be missing.

        The residual of u is taken once: all that follows is as small as the correction, and so is its rounding.
        """
        problem, nothing = self.problem, np.zeros_like(u)
        found, r = np.zeros_like(u), residual(problem.A, problem.b, u)
        p, rz, before, last, rate = None, 1.0, None, float(np.ptp(u)), 1.0
        for _ in range(_STEPS):
            z, force = self.displacement(r, active)
            size = _largest(z)
            rate = min(size / last, 1.0) if last else 0.0
            change = np.inf if before is None else _largest(force - before)
            if p is not None and (rate > _STALLED or not size):
                break
            last = size
            rz, beta = float(r @ z), (float(r @ z) / rz if p is not None else 0.0)
            p = z + beta * p if p is not None else z
            if rate * size <= BELOW * np.ptp(u) and (self.even or change <= EPS * _largest(force)):
                found += z
                break
            before = force
            Ap = -residual(problem.A, nothing, p)
            step = rz / float(p @ Ap)
            found += step * p
            r -= step * Ap
        return found, force, (2.0 * rate * size, 0.0 if before is None else 2.0 * rate * change)

    def displacement(self, load, active):
        """What a load does with the contact set held: the change of u, and the forces it leaves on contact dofs."""
        reduced = self.condensed.reduce(load)
        w = np.zeros(active.size)
        if not active.all():
            w[~active] = self.operator.solve_free(~active, reduced[~active])
        force = self.operator.S @ w - reduced if active.size else w
        return self.condensed.extend(load, w, reduced), np.where(active, force, 0.0)

    def errors(self, u, active, left):
        """Estimated errors of a refined solution.

        The rounding of every row, pushing one way, is a load whose response bounds all others where inv(A) >= 0; the
        same with random signs shows what rounding does where entries of inv(A) differ in sign.
        """
        problem = self.problem
        _, fluxes = residual_and_fluxes(problem.A, problem.b, u)
        inexact = 0.0 if self.inexact is None else residual_and_fluxes(self.inexact, 0.0 * problem.b, u)[1]
        rounding = rounding_of(problem.b, fluxes, inexact)
        rounding[problem.fixed] = 0.0
        pushed, pressed = self.displacement(rounding, active)
        rng, largest_u = np.random.default_rng(0), 0.0
        gaps, forces = np.zeros((2, _SAMPLES, active.size))
        for k in range(_SAMPLES):
            moved, forces[k] = self.displacement(np.copysign(rounding, rng.random(u.size) - 0.5), active)
            gaps[k] = moved[problem.contact]
            largest_u = max(largest_u, _largest(moved))
        largest_force = _largest(forces)
        gaps, forces = bound_of(pushed[problem.contact], gaps), bound_of(pressed, forces)
        stored = 2.0 * EPS * np.maximum(np.abs(u[problem.contact]), np.abs(problem.lower))
        acting = np.max((fluxes + np.abs(problem.b))[problem.contact], initial=0.0)
        stiffness = self.condensed.S.diagonal()
        bounds = gaps + stored + left[0], forces + left[1]
        loads = np.abs(self.condensed.reduce(rounding))
        return Errors(largest_u + left[0], largest_force + left[1], *bounds, loads, stiffness, acting)


def _inexact(problem):
    return stiffness_errors(problem.mesh, find_element(problem.element), problem.coefficient)


def _largest(values):
    return float(np.max(np.abs(values), initial=0.0))


class Condensed:
    """A problem's stiffness matrix, factorised once, and its Schur complement on the contact dofs.

    Attributes
    ----------
    S : ndarray, shape (nc, nc)
        A with all other free dofs eliminated, dimensionless.

    Raises
    ------
    SolverError
        If the matrix is not positive definite with the contact dofs held.
    """

    def __init__(self, problem):
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import splu

        self.size, self.contact = problem.b.size, problem.contact
        self.count = problem.contact.size
        is_contact = np.zeros(self.size, dtype=bool)
        is_contact[problem.contact] = True
        interior = problem.free[~is_contact[problem.free]]
        nodes = find_element(problem.element).nodes(problem.mesh, interior)
        order = dissection_order(problem.A[interior][:, interior], nodes)
        self.order = np.concatenate([interior[order], problem.contact])
        A = problem.A[self.order][:, self.order].tocsc()
        shift = np.zeros(A.shape[0])
        shift[A.shape[0] - self.count :] = _springs(problem)
        count(factorisations=1)
        try:
            self.factors = splu(
                (A + diags_array(shift)).tocsc(),
                permc_spec="NATURAL",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SolverError(_why_singular(problem)) from error
        if np.any(self.factors.perm_r != np.arange(A.shape[0])) or np.any(self.factors.U.diagonal() <= 0.0):
            raise SolverError(_why_singular(problem))
        self.S_sprung = self._trailing_block()
        self.S = self.S_sprung - np.diag(shift[A.shape[0] - self.count :])

    def _trailing_block(self):
        if not self.count:
            return np.zeros((0, 0))
        L, U = self.factors.L[-self.count :], self.factors.U[-self.count :]
        S = L[:, -self.count :].toarray() @ U[:, -self.count :].toarray()
        return 0.5 * (S + S.T)

    def reduce(self, load):
        """The load condensed to the contact dofs: b_c - A_ci inv(A_ii) b_i, shape (nc,)."""
        rhs = load[self.order]
        split = rhs.size - self.count
        rhs[split:] = 0.0
        return load[self.contact] + self.S_sprung @ self.factors.solve(rhs)[split:]

    def extend(self, load, w, reduced=None):
        """The free dofs in equilibrium with `load` when the contact dofs equal `w`; zero on the fixed ones.

        `reduced` is ``reduce(load)`` where it is known.
        """
        reduced = self.reduce(load) if reduced is None else reduced
        rhs = load[self.order]
        split = rhs.size - self.count
        rhs[split:] = self.S_sprung @ w + (load[self.contact] - reduced)
        found = self.factors.solve(rhs)
        missed = w - found[split:]
        if _largest(missed) > _MISSED * _largest(w):
            # An ill-conditioned S misses w in its last digits, which a stiff neighbour would feel.
            rhs[:split], rhs[split:] = 0.0, self.S_sprung @ missed
            found += self.factors.solve(rhs)
        u = np.zeros(self.size)
        u[self.order] = found
        u[self.contact] = w
        return u


def _springs(problem):
    """About the size of S on each contact dof: the coefficient there, a power of two; shape (nc,)."""
    if problem.coefficient is None:
        return np.ones(problem.contact.size)
    largest = np.zeros(problem.b.size)
    dofs = find_element(problem.element).triangle_dofs(problem.mesh)
    np.maximum.at(largest, dofs, np.broadcast_to(problem.coefficient, dofs.shape))
    return 2.0 ** np.round(np.log2(largest[problem.contact]))


def _why_singular(problem):
    """Say why factors show a matrix that is not positive: a loose part, or what costs all digits."""
    from scipy.sparse.csgraph import connected_components

    count, part = connected_components(problem.A, directed=False)
    held = np.zeros(count, dtype=bool)
    held[part[problem.fixed]] = held[part[problem.contact]] = True
    if held.all():
        return f"domain: no digit of the solution survives rounding: {causes(problem)}"
    x, y = find_element(problem.element).nodes(problem.mesh, np.flatnonzero(~held[part])[:1])[:, 0]
    return (
        f"singular stiffness matrix: a part of the body is loose, that with ({x:.6g}, {y:.6g}); "
        "join it to a dirichlet or contact part of the boundary"
    )


def dissection_order(A, nodes):
    """Order the rows of a symmetric matrix by nested dissection of their coordinates (George 1973).

    The coordinate ranks' binary digits bisect the set again and again, along x and y in turn; an entry that
    joins two halves makes its row in the first half part of their separator, ordered after both.

    Parameters
    ----------
    A : sparse array, shape (m, m)
    nodes : ndarray, shape (2, m)

    Returns
    -------
    ndarray of int, shape (m,)
    """
    count = A.shape[0]
    if count <= _LEAF:
        return np.arange(count)
    depth = int(np.ceil(np.log2(count / _LEAF)))
    digits = _bisection_digits(nodes, depth)
    pattern = A.tocoo()
    first_split = np.full(count, depth)
    differ = digits[:, pattern.row] != digits[:, pattern.col]
    apart = differ.any(axis=0)
    level = differ[:, apart].argmax(axis=0)
    row = pattern.row[apart]
    in_first = digits[level, row] == 0
    np.minimum.at(first_split, row[in_first], level[in_first])
    key = np.zeros(count, dtype=np.int64)
    for k in range(depth):
        key = 3 * key + np.where(first_split <= k, 2, digits[k])
    return np.argsort(key, kind="stable")


def _bisection_digits(nodes, depth):
    ranks = [np.unique(values, return_inverse=True)[1].astype(np.int64) for values in nodes]
    scaled = [(rank << 32) // (rank.max(initial=0) + 1) for rank in ranks]
    return np.array([(scaled[k % 2] >> (31 - k // 2)) & 1 for k in range(depth)], dtype=np.int8)
