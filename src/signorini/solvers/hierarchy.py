"""Levels for multigrid: the meshes that a mesh was refined from, and below them coarsening by the
matrix alone.

CR stands on conforming P1 on the same mesh, which it contains; P1 stands on P1 on the mesh it was
refined from, whose matrix equals the Galerkin product, but for cells at curved sides, where it is
near. Below the coarsest mesh, where there is none, and where cells are stretched, levels follow the
large entries of the matrix (Ruge & Stüben 1987, by PyAMG). After Brandt, Math. Comp. 31 (1977), and
Braess & Verfürth, SIAM J. Numer. Anal. 27 (1990), for the nonconforming element.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from signorini.exceptions import MeshError
from signorini.fem.elements import ELEMENTS
from signorini.fem.residual import residual, row_sums
from signorini.fem.stiffness import assemble_stiffness
from signorini.mesh.bisection import over_ancestors
from signorini.mesh.curved import curved_vertices
from signorini.solvers.solution import largest

_SMALL = 100  # unknowns of a level that is solved with a dense inverse
# Cells beyond which levels that know only the mesh take more steps than algebraic ones; measured.
STRETCHED = 8.0
_STRONG = 0.25  # of the largest negative coupling of a row, from which on a coupling is strong
_WILD = 2.0  # weight of an interpolation that positive couplings have spoilt
_NOTHING = 1e-3  # of the strong couplings of a row: what is too little to divide them by
_EXACT = 1e6  # range of the diagonal beyond which products are taken by differences
# Of the coefficient within a triangle of the coarser mesh, which that mesh then cannot follow.
_JUMP = 30.0
HALF = 0.5 - 1e-9
# Of local refinements: the share of a mesh's vertices that the next level has at most, where not
# more meshes than these are passed over for it; measured.
_SHARE = 0.5
_PASSED_OVER = 3


@dataclass(frozen=True, eq=False)
class Level:
    """A stiffness matrix and the way from the next coarser level.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
    P : scipy.sparse.csr_array, shape (n, m), optional
        Prolongation; None on the coarsest level.
    robust : bool
        Whether levels below are to follow A with the held unknowns eliminated (`Eliminated`), since
        held ones and stiff or stretched neighbours cannot share a coarse unknown.
    """

    A: object
    P: object = None
    robust: bool = False

    @cached_property
    def _exact(self):
        return bool(self.diagonal.max() > _EXACT * self.diagonal.min())

    def product(self, x):
        """A x; from differences of x where entries of A differ by many powers of ten."""
        return -residual(self.A, np.zeros_like(x), x, self.sums) if self._exact else self.A @ x

    @cached_property
    def sums(self):
        """``row_sums`` of A, see `residual`."""
        return row_sums(self.A)

    @cached_property
    def R(self):
        """Restriction, the transpose of the prolongation, CSC: it shares the memory of that."""
        return self.P.T

    @cached_property
    def diagonal(self):
        """Diagonal of A, shape (n,)."""
        return self.A.diagonal()

    def coarse_mask(self, mask):
        """The unknowns of the coarser level that are at least half made of marked ones; masks."""
        return self.R @ mask.astype(float) >= HALF


def build_hierarchy(problem):
    """The levels of a problem, finest first.

    Raises
    ------
    MeshError
        If the problem's mesh is not the refinement of the mesh it names as coarser.
    """
    levels, mesh, A, k = [], problem.mesh, problem.A, problem.coefficient
    robust = False
    if not is_regular(mesh):
        return _algebraic(A, robust=True)
    ends = problem.finite_element.vertex_means(mesh)
    if ends is not None and A.shape[0] > _SMALL:
        levels.append(Level(A, _means(ends, mesh.number_of_vertices)))
        A = assemble_stiffness(mesh, ELEMENTS["P1"], k)
    while A.shape[0] > _SMALL and mesh.coarser() is not None:
        P, mesh, k, follows = _coarsened(mesh, k)
        robust = robust or not follows
        levels.append(Level(A, P))
        A = assemble_stiffness(mesh, ELEMENTS["P1"], k)
    below = _algebraic(A)
    robust = robust or (jumps(k) and (ends is not None or problem.mesh.coarser() is None))
    levels += below
    return [replace(level, robust=True) for level in levels] if robust else levels


def _coarsened(mesh, k):
    """The next coarser mesh that is worth a level.

    Local refinements that added few vertices are passed over, so that all levels together cost
    little more than the finest; but only a few of them, so that no cell is much larger than those
    that it was cut into.

    Parameters
    ----------
    mesh : Grid or Triangulation
    k : ndarray, shape (nt,), or None
        Coefficient of each triangle.

    Returns
    -------
    P : scipy.sparse.csr_array
        Prolongation from it.
    coarse : Grid or Triangulation
    k : ndarray or None
        Its coefficient.
    follows : bool
        Whether its coefficient follows that of `mesh`, without jumps within a triangle.
    """
    P, coarse, follows = None, mesh, True
    for _ in range(_PASSED_OVER + 1):
        step, coarse, k, smooth = _one_coarser(coarse, k)
        P, follows = step if P is None else (P @ step).tocsr(), follows and smooth
        few = coarse.number_of_vertices <= _SHARE * mesh.number_of_vertices
        if few or coarse.coarser() is None:
            break
    return P, coarse, k, follows


def _one_coarser(mesh, k):
    """As `_coarsened`, of the mesh that `mesh` was refined from."""
    coarse, parents = mesh.coarser(), mesh.vertex_parents()
    _check_nested(mesh, coarse, parents)
    P = _means(parents, coarse.number_of_vertices)
    if k is None:
        return P, coarse, None, True
    least, mean, greatest = over_ancestors(mesh, k)
    return P, coarse, mean, not np.any(greatest > _JUMP * least)


def jumps(coefficient):
    """Whether a coefficient varies so much that coarse meshes, or plain products with A, cannot
    follow it.
    """
    return coefficient is not None and bool(coefficient.max() > _JUMP * coefficient.min())


def is_regular(mesh):
    """Whether no cell of a mesh is stretched."""
    return mesh.stretch <= STRETCHED


def is_nested(mesh):
    """Whether the meshes that `mesh` was refined from make good levels: there is one, and no cell
    is stretched.
    """
    return mesh.coarser() is not None and is_regular(mesh)


def causes(problem):
    """What in a problem costs digits: cell shapes, the coefficient; and the remedy; a message."""
    found = []
    if problem.mesh.stretch > STRETCHED:
        found.append(
            f"there are cells {problem.mesh.stretch:.2g} times as long as high; stretch cells less"
        )
    if jumps(problem.coefficient):
        contrast = problem.coefficient.max() / problem.coefficient.min()
        found.append(f"the coefficient varies by {contrast:.1g}; let it vary less")
    return ", and ".join(found) or "look for data of very different sizes"


def _algebraic(A, robust=False):
    """Levels that follow the large entries of A alone."""
    if A.shape[0] <= _SMALL:
        return [Level(A, robust=robust)]
    from pyamg import smoothed_aggregation_solver
    from pyamg.classical.split import RS
    from scipy.sparse import csr_array, csr_matrix

    levels, coarse = [], csr_array(A)
    while coarse.shape[0] > _SMALL:
        strong = _strong_couplings(coarse)
        splitting = RS(strong)
        if not 0 < splitting.sum() < splitting.size:
            break
        P = _interpolation(coarse, splitting, strong)
        del strong  # before the product below needs memory
        if P is None:
            found = smoothed_aggregation_solver(csr_matrix(A), max_coarse=_SMALL).levels
            levels = [Level(csr_array(level.A), csr_array(level.P), robust) for level in found[:-1]]
            coarse = csr_array(found[-1].A)
            break
        levels.append(Level(coarse, P, robust))
        coarse = (levels[-1].R @ coarse @ P).tocsr()
    return [*levels, Level(coarse, robust=robust)]


def _strong_couplings(A):
    """The strong couplings of a matrix, CSR.

    Negative ones alone are strong: across a positive one, u does not vary slowly after smoothing.
    """
    from pyamg.strength import classical_strength_of_connection

    return classical_strength_of_connection(A, _STRONG, norm="min")


def _interpolation(A, splitting, strong):
    """The interpolation by strong couplings, CSR, or None where its weights are wild.

    The weights of a row are its strong couplings over their sum and that of the whole row. Where
    positive couplings to held unknowns were left out of the row, its own sum is negative, and both
    together may be nothing.

    Parameters
    ----------
    A : scipy.sparse.csr_array, shape (n, n)
    splitting : ndarray of int, shape (n,)
        Which unknowns are to be coarse, 0 or 1 each.
    strong : scipy.sparse.csr_array, shape (n, n)
        Overwritten: there is no room for a copy.
    """
    from pyamg.amg_core import remove_strong_FF_connections

    remove_strong_FF_connections(A.shape[0], strong.indptr, strong.indices, strong.data, splitting)
    strong.eliminate_zeros()
    strong.data[:] = 1.0
    strong = strong.multiply(A)
    size = strong.diagonal() - strong.sum(axis=1)
    if np.any(np.abs(size + A.sum(axis=1)) < _NOTHING * size):
        return None
    P = _classical_interpolation(A, splitting, strong)
    P.sort_indices()  # so that sums over a row run in one order, whatever version made it
    return None if largest(P.data) > _WILD else P


def _classical_interpolation(A, splitting, strong):
    """PyAMG's function of that name, less its copies: `strong` holds the entries of A to use."""
    from pyamg.amg_core import rs_classical_interpolation_pass1, rs_classical_interpolation_pass2
    from scipy.sparse import csr_array

    count = A.shape[0]
    start = np.empty_like(A.indptr)
    rs_classical_interpolation_pass1(count, strong.indptr, strong.indices, splitting, start)
    column = np.empty(start[-1], dtype=start.dtype)
    weight = np.empty(start[-1], dtype=A.dtype)
    rows = A.indptr, A.indices, A.data
    strong_rows = strong.indptr, strong.indices, strong.data
    modified = True  # as `remove_strong_FF_connections` asks for
    rs_classical_interpolation_pass2(
        count, *rows, *strong_rows, splitting, start, column, weight, modified
    )
    return csr_array((weight, column, start), shape=(count, splitting.sum()))


def _means(pairs, count):
    """The matrix of the means of pairs of `count` values; a pair of equals stands for the one
    value.
    """
    from scipy.sparse import csr_array

    first, second = pairs
    two = first != second
    start = np.zeros(first.size + 1, dtype=np.int32)
    np.cumsum(1 + two, out=start[1:])
    column = np.empty(start[-1], dtype=np.int32)
    column[start[:-1]], column[start[1:] - 1] = first, second
    weight = np.repeat(np.where(two, 0.5, 1.0), 1 + two)
    return csr_array((weight, column, start), shape=(first.size, count))


def _check_nested(mesh, coarser, parents):
    p, coarse = mesh.p, coarser.p
    off = np.abs(p - 0.5 * (coarse[:, parents[0]] + coarse[:, parents[1]])).max(axis=0)
    off[curved_vertices(mesh)] = 0.0  # they are on their curves, and the levels hardly differ
    k = int(off.argmax())
    if off[k] > 1e-9 * np.ptp(coarse, axis=1).max():
        raise MeshError(
            f"mesh: vertex {k} at ({p[0, k]:.6g}, {p[1, k]:.6g}) "
            "is not where its coarser mesh puts it; "
            "the levels do not nest: make the mesh by refined(), or drop the parent"
        )


class Cycle:
    """A V(1,1) cycle with some unknowns held: a symmetric positive definite preconditioner of A on
    the others.

    It sweeps forwards before and backwards after the coarse correction, by Gauss and Seidel.

    Parameters
    ----------
    levels : list of Level
    held : ndarray of bool, shape (n,)
        Unknowns of the first level that do not move. A coarse unknown does not move if at least
        half of one that is held depends on it.
    """

    def __init__(self, levels, held):
        self.levels, self.held, self.free = levels, [], []
        for level in levels:
            self.held.append(np.flatnonzero(held))
            self.free.append(np.flatnonzero(~held).astype(np.int32))
            if level.P is not None:
                held = level.coarse_mask(held)
        rows = self.free[-1]
        self.inverse = np.linalg.inv(levels[-1].A.toarray()[np.ix_(rows, rows)])

    def __call__(self, r, k=0):
        """An approximate solution of A z = r on the unknowns that move, zero on the others."""
        level, x = self.levels[k], np.zeros_like(r)
        if level.P is None:
            x[self.free[k]] = self.inverse @ r[self.free[k]]
            return x
        self.sweep(k, x, r, 1)
        rest = level.product(x)
        np.subtract(r, rest, out=rest)
        rest[self.held[k]] = 0.0
        correction = level.P @ self(level.R @ rest, k + 1)
        correction[self.held[k]] = 0.0
        x += correction
        self.sweep(k, x, r, -1)
        return x

    def sweep(self, k, x, r, step):
        """Sweep once over the unknowns that move, by Gauss and Seidel, in place.

        Parameters
        ----------
        k : int
            Level.
        x, r : ndarray, shape (n,)
            The approximation of A x = r, which is improved, and the right-hand side.
        step : {1, -1}
            Forwards or backwards.
        """
        from pyamg.amg_core import gauss_seidel_indexed

        A, rows = self.levels[k].A, self.free[k]
        first, end = (0, rows.size) if step > 0 else (rows.size - 1, -1)
        gauss_seidel_indexed(A.indptr, A.indices, A.data, x, r, rows, first, end, step)


class Eliminated:
    """The same with the held unknowns eliminated first: levels follow what is left of A alone."""

    def __init__(self, levels, held):
        self.level, self.rows = levels[0], np.flatnonzero(~held)
        A = levels[0].A[self.rows][:, self.rows]
        inner = _algebraic(A, robust=True)
        self.inner = Cycle(inner, np.zeros(self.rows.size, dtype=bool))

    def __call__(self, r):
        """As `Cycle`."""
        z = np.zeros_like(r)
        z[self.rows] = self.inner(r[self.rows])
        return z


def preconditioner(levels, held):
    """A preconditioner with some unknowns held.

    Parameters
    ----------
    levels : list of Level
        Finest first.
    held : ndarray of bool, shape (n,)

    Returns
    -------
    Cycle or Eliminated
        The latter where the levels ask for it.
    """
    return (Eliminated if levels[0].robust else Cycle)(levels, held)
