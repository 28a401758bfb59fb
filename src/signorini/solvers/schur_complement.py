"""A problem's stiffness matrix factorised once, and its Schur complement on the contact dofs.

Nested dissection orders the dofs with the contact dofs last, so that the trailing block of the
factors is the Schur complement S on them: neither a second factorisation nor a solve per contact
dof is needed. A spring as stiff as S on each contact dof, taken off S again, keeps the factors well
conditioned where only the inequality, or a weak part of the body, holds it.
"""

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.elements import find_element
from signorini.fem.residual import EPS
from signorini.solvers.conditioning import accuracy_loss_causes
from signorini.solvers.extremes import largest
from signorini.work import count

_LEAF = 8
_SINGULAR = 1e-13  # of its diagonal entry: a pivot so small may show a loose part of the body
_RESIDUAL_TOLERANCE = 4.0 * EPS


class SchurComplement:
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
            raise SolverError(singular_message(problem)) from error
        pivots = self.factors.U.diagonal()
        if np.any(self.factors.perm_r != np.arange(A.shape[0])) or np.any(pivots <= 0.0):
            raise SolverError(singular_message(problem))
        if np.any(pivots <= _SINGULAR * (A.diagonal() + shift)) and loose_part(problem) is not None:
            raise SolverError(singular_message(problem))
        self.S_with_springs = self._trailing_block()
        self.S = self.S_with_springs - np.diag(shift[A.shape[0] - self.count :])

    def _trailing_block(self):
        if not self.count:
            return np.zeros((0, 0))
        L, U = self.factors.L[-self.count :], self.factors.U[-self.count :]
        S = L[:, -self.count :].toarray() @ U[:, -self.count :].toarray()
        return 0.5 * (S + S.T)

    def condense(self, load):
        """The load condensed to the contact dofs: b_c - A_ci inv(A_ii) b_i, shape (nc,).

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> schur = SchurComplement(problem)
        >>> schur.condense(problem.b).shape == problem.contact.shape
        True
        """
        rhs = load[self.order]
        split = len(rhs) - self.count
        rhs[split:] = 0.0
        return load[self.contact] + self.S_with_springs @ self.factors.solve(rhs)[split:]

    def back_substitute(self, load, w, condensed_load=None):
        """The free dofs in equilibrium, with the contact dofs given; zero on the fixed ones.

        Parameters
        ----------
        load : ndarray, shape (ndof,) or (ndof, k)
            Unit of the load.
        w : ndarray, shape (nc,) or (nc, k)
            The contact dofs, unit of u.
        condensed_load : ndarray, shape (nc,) or (nc, k), optional
            ``condense(load)``, where it is known.

        Returns
        -------
        ndarray, shape (ndof,) or (ndof, k)
            Unit of u.

        Examples
        --------
        All dofs follow from those in contact:

        >>> from signorini import discretize, load_scene, solve
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 8)
        >>> u = solve(problem).u
        >>> found = SchurComplement(problem).back_substitute(problem.b, u[problem.contact])
        >>> bool(np.abs(found - u).max() < 1e-14)
        True
        """
        condensed_load = self.condense(load) if condensed_load is None else condensed_load
        rhs = load[self.order]
        split = len(rhs) - self.count
        rhs[split:] = self.S_with_springs @ w + (load[self.contact] - condensed_load)
        x = self.factors.solve(rhs)
        error = w - x[split:]
        if largest(error) > _RESIDUAL_TOLERANCE * largest(w):
            # An ill-conditioned S misses w in its last digits, which a stiff neighbour would feel.
            rhs[:split], rhs[split:] = 0.0, self.S_with_springs @ error
            x += self.factors.solve(rhs)
        u = np.zeros((self.size, *load.shape[1:]))
        u[self.order] = x
        u[self.contact] = w
        return u


def _springs(problem):
    """About the size of S on each contact dof, shape (nc,): the coefficient, a power of two."""
    if problem.coefficient is None:
        return np.ones(problem.contact.size)
    stiffest = np.zeros(problem.b.size)
    dofs = find_element(problem.element).triangle_dofs(problem.mesh)
    np.maximum.at(stiffest, dofs, np.broadcast_to(problem.coefficient, dofs.shape))
    return 2.0 ** np.round(np.log2(stiffest[problem.contact]))


def singular_message(problem):
    """Why factors show a matrix that is not positive: a loose part, or what costs all digits."""
    at = loose_part(problem)
    if at is None:
        causes = accuracy_loss_causes(problem)
        return f"domain: no digit of the solution survives rounding: {causes}"
    return (
        f"singular stiffness matrix: a part of the body is loose, "
        f"that with ({at[0]:.6g}, {at[1]:.6g}); "
        "join it to a dirichlet or contact part of the boundary"
    )


def loose_part(problem):
    """A point of a part of the body that neither a Dirichlet nor a contact part holds, (2,), or
    None.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> loose_part(problem) is None
    True
    """
    from scipy.sparse.csgraph import connected_components

    count, part = connected_components(problem.A, directed=False)
    held = np.zeros(count, dtype=bool)
    held[part[problem.fixed]] = held[part[problem.contact]] = True
    if held.all():
        return None
    return find_element(problem.element).nodes(problem.mesh, np.flatnonzero(~held[part])[:1])[:, 0]


def dissection_order(A, nodes):
    """Order the rows of a symmetric matrix by nested dissection of their coordinates (George 1973).

    The coordinate ranks' binary digits bisect the set again and again, along x and y in turn; an
    entry that joins two halves makes its row in the first half part of their separator, ordered
    after both.

    Parameters
    ----------
    A : sparse array, shape (m, m)
    nodes : ndarray, shape (2, m)

    Returns
    -------
    ndarray of int, shape (m,)

    Examples
    --------
    Each unknown comes once:

    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 8)
    >>> nodes = problem.finite_element.nodes(problem.mesh, problem.free)
    >>> order = dissection_order(problem.A[problem.free][:, problem.free], nodes)
    >>> np.array_equal(np.sort(order), np.arange(problem.free.size))
    True
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
