"""The direct route: one sparse factorisation, the inequality on the condensed contact matrix. The others' oracle.

The dofs are ordered by nested dissection with the contact dofs last, so that the trailing block of the factors
is the Schur complement S on them: neither a second factorisation nor a solve per contact dof is needed.
About its own diagonal entry, added on each contact dof and taken off again, keeps the factorisation regular where only
the inequality holds the body (no Dirichlet part).
"""

import numpy as np

from signorini.elements import element as find_element
from signorini.exceptions import SolverError
from signorini.memory import DIRECT, check_memory
from signorini.solvers.contact import DenseContact, solve_contact
from signorini.solvers.count import count
from signorini.solvers.residual import EXACT, residual

_LEAF = 8
_SINGULAR = 1e-13  # a pivot this small against its diagonal entry is round-off


def solve_direct(problem, guess=None):
    """Solve any problem; arguments, results and errors as in `solvers.fourier.solve_fourier`.

    The accuracy returned is the error that rounding of the entries of A causes on stretched or obtuse cells, which no
    residual shows.
    """
    check_memory(problem.mesh.number_of_triangles, DIRECT[problem.element], "a mesh for solver.method direct")
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    if not problem.free.size:
        return u, np.zeros(0, dtype=bool), 0, 0.0
    u[problem.contact] = problem.lower
    condensed = Condensed(problem)
    load = problem.b - problem.A @ u
    count(products=1)
    active, iterations, operator = np.zeros(0, dtype=bool), 0, None
    if problem.contact.size:
        operator = DenseContact(condensed.S)
        result = solve_contact(operator, condensed.reduce(load), guess=guess, singular=problem.fixed.size == 0)
        active, iterations = result.active, result.iterations
    accuracy = _accuracy(problem, condensed, operator, active)
    for _ in ("solve", "refine"):
        u += _displacement(problem, condensed, operator, active, _residual(problem, u, accuracy))
    u[problem.contact[active]] = problem.lower[active]
    return u, active, iterations, accuracy


def _residual(problem, u, accuracy):
    """b - A u, by differences unless round-off in the rows of A moves u: the contact set is that of A as it is."""
    if accuracy <= EXACT:
        return residual(problem.A, problem.b, u)
    count(products=1)
    return problem.b - problem.A @ u


def _displacement(problem, condensed, operator, active, load):
    """What `load` does with the contact set held."""
    w = np.zeros(problem.contact.size)
    if not active.all():
        w[~active] = operator.solve_free(~active, condensed.reduce(load)[~active])
    return condensed.extend(load, w)


def _accuracy(problem, condensed, operator, active):
    """Relative change of u when the entries of A are rounded by random signs: eps times Skeel's condition number."""
    count(products=1)
    signs = np.random.default_rng(0).choice((-1.0, 1.0), problem.b.size)
    rounding = np.finfo(float).eps * signs * (abs(problem.A) @ np.ones(problem.b.size))
    return float(np.max(np.abs(_displacement(problem, condensed, operator, active, rounding))))


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
        on_contact = slice(A.shape[0] - self.count, None)
        shift[on_contact] = 2.0 ** np.ceil(np.log2(A.diagonal()[on_contact]))
        count(factorisations=1)
        try:
            self.factors = splu(
                (A + diags_array(shift)).tocsc(),
                permc_spec="NATURAL",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SolverError(
                "singular stiffness matrix: without contact, part of the boundary must be dirichlet"
            ) from error
        if np.any(self.factors.perm_r != np.arange(A.shape[0])):
            raise SolverError(
                "domain: the stiffness matrix is not positive definite; choose cells that are less stretched"
            )
        if np.any(self.factors.U.diagonal() <= _SINGULAR * (A.diagonal() + shift)):
            raise SolverError(
                "singular stiffness matrix: a part of the body is loose, or its triangles are too stretched; "
                "join it to a dirichlet or contact part of the boundary, or choose other cell shapes"
            )
        self.S_shifted = self._trailing_block()
        self.S = self.S_shifted - np.diag(shift[on_contact])

    def _trailing_block(self):
        if not self.count:
            return np.zeros((0, 0))
        L, U = self.factors.L[-self.count :], self.factors.U[-self.count :]
        S = L[:, -self.count :].toarray() @ U[:, -self.count :].toarray()
        return 0.5 * (S + S.T)

    def reduce(self, load):
        """The load condensed to the contact dofs: b_c - A_ci inv(A_ii) b_i, shape (nc,)."""
        rhs = load[self.order]
        rhs[rhs.size - self.count :] = 0.0
        return load[self.contact] + self.S_shifted @ self.factors.solve(rhs)[rhs.size - self.count :]

    def extend(self, load, w):
        """The free dofs in equilibrium with `load` when the contact dofs equal `w`; zero on the fixed ones."""
        rhs = load[self.order]
        split = rhs.size - self.count
        if self.count:
            rhs[split:] = self.S_shifted @ w + load[self.contact] - self.reduce(load)
        u = np.zeros(self.size)
        u[self.order] = self.factors.solve(rhs)
        u[self.contact] = w
        return u


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
