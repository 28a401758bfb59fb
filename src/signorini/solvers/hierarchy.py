"""Levels for multigrid: the meshes that a mesh was refined from, and algebraic ones below them.

CR stands on conforming P1 on the same mesh, which it contains; P1 stands on P1 on the mesh it was
refined from, whose matrix equals the Galerkin product, but for cells at curved sides, where it is
near. Below the coarsest mesh, where there is none, and where cells are stretched, levels follow the
large entries of the matrix (`algebraic`); those of a large matrix whose entries are all alike join
patches of unknowns (`aggregation`). After Brandt, Math. Comp. 31 (1977), and Braess & Verfürth,
SIAM J. Numer. Anal. 27 (1990), for the nonconforming element.
"""

from dataclasses import replace

import numpy as np

from signorini.exceptions import MeshError
from signorini.fem.elements import ELEMENTS
from signorini.fem.stiffness import assemble_stiffness
from signorini.mesh.bisection import over_ancestors
from signorini.mesh.curved import curved_vertices
from signorini.mesh.grid import Grid
from signorini.solvers.aggregation import aggregation_levels
from signorini.solvers.algebraic import algebraic_levels
from signorini.solvers.conditioning import JUMP, has_jumps, is_regular
from signorini.solvers.level import COARSEST_SIZE, Level

# Of local refinements: the share of a mesh's vertices that the next level has at most, where not
# more meshes than these are passed over for it; measured.
_SHARE = 0.5
_PASSED_OVER = 3
_CLASSICAL_UP_TO = 5_000  # unknowns up to which fewer cycles are worth larger levels; measured


def build_hierarchy(problem):
    """The levels of a problem, finest first.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    list of Level

    Raises
    ------
    MeshError
        If the problem's mesh is not the refinement of the mesh it names as coarser.

    Examples
    --------
    The unknowns of CR, of P1 on the same mesh, and of P1 on the mesh it was refined from:

    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 16)
    >>> [level.A.shape[0] for level in build_hierarchy(problem)]
    [800, 289, 81]
    """
    levels, mesh, A, k = [], problem.mesh, problem.A, problem.coefficient
    robust = False
    if not is_regular(mesh):
        return algebraic_levels(A, robust=True)
    ends = problem.finite_element.vertex_means(mesh)
    if ends is not None and A.shape[0] > COARSEST_SIZE:
        levels.append(Level(A, _averaging(ends, mesh.number_of_vertices)))
        A = assemble_stiffness(mesh, ELEMENTS["P1"], k)
    while A.shape[0] > COARSEST_SIZE and mesh.coarser() is not None:
        P, mesh, k, follows = _coarsened(mesh, k)
        robust = robust or not follows
        levels.append(Level(A, P))
        A = assemble_stiffness(mesh, ELEMENTS["P1"], k)
    robust = robust or (has_jumps(k) and (ends is not None or problem.mesh.coarser() is None))
    classical = robust or A.shape[0] <= _CLASSICAL_UP_TO
    levels += (algebraic_levels if classical else aggregation_levels)(A)
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
    if not isinstance(mesh, Grid):  # whose coarser grid is arithmetic
        _check_nested(mesh, coarse, parents)
    P = _averaging(parents, coarse.number_of_vertices)
    if k is None:
        return P, coarse, None, True
    least, mean, greatest = over_ancestors(mesh, k)
    return P, coarse, mean, not np.any(greatest > JUMP * least)


def _averaging(pairs, count):
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
