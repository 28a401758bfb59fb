"""Solutions in extended precision (80 bits): what solutions in double precision are held against.

The stiffness matrix is assembled anew from the vertices, in extended precision, because its rounding to double is what
costs accuracy on stretched cells. The factors of the double precision matrix then serve as a preconditioner: every step
takes the residual of the exact matrix, and the contact set is changed until no sign of gap or force is wrong.
"""

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.contact import DenseContact
from signorini.solvers.direct import Condensed

EXTENDED = np.longdouble
_EPS = float(np.finfo(EXTENDED).eps)
_LARGEST_CHANGE = 1e-6
_MAX_STEPS = 400


def extended_stiffness(mesh, element):
    """The stiffness matrix for coefficient 1, by edge vectors.

    With e_i the edge opposite vertex i of a triangle T, P1 has the entries e_i.e_j / (4 |T|), and CR four times those,
    on the edges in place of the opposite vertices.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"}

    Returns
    -------
    scipy.sparse.csr_array of longdouble, shape (ndof, ndof)
    """
    from scipy.sparse import coo_array

    p, t = mesh.p.astype(EXTENDED), mesh.t
    opposite = [p[:, t[(i + 2) % 3]] - p[:, t[(i + 1) % 3]] for i in range(3)]
    area = np.abs(opposite[0][0] * opposite[1][1] - opposite[0][1] * opposite[1][0]) / 2
    dofs, factor, size = (t, 0.25, mesh.number_of_vertices)
    if element == "CR":
        dofs, factor, size = mesh.t2f[[1, 2, 0]], 1.0, mesh.number_of_facets  # facets run 01, 12, 02
    entries = [factor * (opposite[i] * opposite[j]).sum(axis=0) / area for i in range(3) for j in range(3)]
    rows, columns = (np.concatenate([dofs[k] for k in order]) for order in ((0, 0, 0, 1, 1, 1, 2, 2, 2), (0, 1, 2) * 3))
    return coo_array((np.concatenate(entries), (rows, columns)), shape=(size, size)).tocsr()


def extended_solution(problem, solution):
    """Solve a problem to extended precision, starting from a solution in double precision.

    Parameters
    ----------
    problem : Problem
        With coefficient 1.
    solution : Solution

    Returns
    -------
    u : ndarray of longdouble, shape (ndof,)
    change : float
        The last step's, relative to u: an estimate of what is still wrong.

    Raises
    ------
    SolverError
        If the steps do not become small, or the contact set does not settle.
    """
    exponent = _exponent(problem)
    A = extended_stiffness(problem.mesh, problem.element)
    b, lower, fixed, u = (
        np.ldexp(values.astype(EXTENDED), -exponent)
        for values in (problem.b, problem.lower, problem.fixed_values, solution.u)
    )
    c, active = problem.contact, solution.active.copy()
    u[problem.fixed], u[c[active]] = fixed, lower[active]
    condensed, best = Condensed(problem), np.inf
    operator = DenseContact(condensed.S) if c.size else None
    for _ in range(_MAX_STEPS):
        size = float(np.max(np.abs(u), initial=0)) or 1.0
        step = _displacement(condensed, operator, active, (b - A @ u).astype(float))
        u += step
        change = float(np.max(np.abs(step), initial=0)) / size
        if change > 0.5 * best or change <= 4 * _EPS:
            if min(best, change) > _LARGEST_CHANGE:
                break
            wrong = _wrong(A, b, lower, c, u, active, 64 * max(change, _EPS))
            if not wrong.any():
                return np.ldexp(u, exponent), change
            active[np.flatnonzero(wrong)[-1]] ^= True
            u[c[active]] = lower[active]
            change = np.inf
        best = change
    raise SolverError(f"extended precision: the steps stay at {change:.1e} of the solution")


def _exponent(problem):
    size = max(float(np.max(np.abs(v), initial=0.0)) for v in (problem.b, problem.lower, problem.fixed_values))
    return int(np.frexp(size)[1])


def _displacement(condensed, operator, active, load):
    w = np.zeros(active.size)
    if not active.all():
        w[~active] = operator.solve_free(~active, condensed.reduce(load)[~active])
    return condensed.extend(load, w)


def _wrong(A, b, lower, c, u, active, tolerance):
    """Where gap or force have the wrong sign, beyond a tolerance relative to the terms they are summed from."""
    force, terms = (A @ u - b)[c], (abs(A) @ np.abs(u) + np.abs(b))[c]
    gap = u[c] - lower
    return np.where(active, force < -tolerance * terms, gap < -tolerance * np.max(np.abs(u), initial=0))
