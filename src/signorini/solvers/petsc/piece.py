"""One process's piece of a discretised problem, before it is joined with the others' pieces.

A uniform grid is cut into strips of rows of cells, by arithmetic. Of any other domain every process
knows a coarse level, whose triangles are dealt out; each refines its own. Where a domain has no
levels to refine, every process makes the whole mesh, and assembles its own triangles.
"""

from dataclasses import dataclass, field

import numpy as np

from signorini.exceptions import SolverError
from signorini.fem.discrete_problem import Problem
from signorini.fem.problem import discretize_on
from signorini.mesh.patch import cut_out, dealt_out, facets_along
from signorini.mesh.strip import strip_of
from signorini.solvers.check import check_data

_TRIANGLES = 64  # of the coarse mesh for each process at least, so that shares are about equal


@dataclass(frozen=True, eq=False)
class Piece:
    """A part of a problem: what its own triangles contribute.

    Parameters
    ----------
    problem : Problem
        On the mesh of the part alone; its matrix and load lack what other processes add.
    shared : dict of int to ndarray of int
        Other process -> the dofs that both have, by their number here, in an order that both know.
    numbers : ndarray of int, shape (ndof,), or None
        The dofs' numbers in the whole problem; None where only the triangles' are known.
    triangles : ndarray of int or None
        Numbers of the triangles in the whole mesh, where `numbers` is None.
    """

    problem: Problem
    shared: dict = field(repr=False)
    numbers: np.ndarray | None = None
    triangles: np.ndarray | None = None


def make_piece(domain, element, n, statement, comm):
    """Discretise this process's piece of a level.

    Parameters
    ----------
    domain : Rectangle or Refined
    element : Element
    n : int
        The level.
    statement : ProblemStatement
    comm : mpi4py.MPI.Comm

    Returns
    -------
    Piece

    Raises
    ------
    SolverError
        If there are more processes than rows of cells, or than triangles; if data are not finite,
        or the body is in several parts.
    """
    if getattr(domain, "uniform", False):
        piece = _strip(domain.grid(n), element, statement, comm)
    else:
        piece = _patch(domain, element, n, statement, comm)
    check_data(piece.problem)
    return piece


def _strip(grid, element, statement, comm):
    _check_enough(grid.ny, "rows of cells", comm)
    cuts = [grid.ny * k // comm.size for k in (comm.rank, comm.rank + 1)]
    mesh = strip_of(grid, *cuts)
    if element.continuous:
        numbers = mesh.vertices_of_whole()
        ends = mesh.side_vertices("bottom"), mesh.side_vertices("top")
    else:
        numbers = mesh.facets_of_whole()
        ends = mesh.side_facets("bottom"), mesh.side_facets("top")
    beside = zip((comm.rank - 1, comm.rank + 1), ends, strict=True)
    shared = {other: dofs for other, dofs in beside if 0 <= other < comm.size}
    return Piece(discretize_on(mesh, element, statement), shared, numbers)


def _patch(domain, element, n, statement, comm):
    coarse, levels = _coarse_level(domain, n, comm.size)
    mesh = domain.level(coarse)
    _check_enough(mesh.number_of_triangles, "triangles", comm)
    if not mesh.in_one_part:  # whether each is held would have to be seen across processes
        raise SolverError(
            f"mpiexec -n {comm.size}: the body is in several parts; solve it on one process"
        )
    cut = cut_out(mesh, dealt_out(mesh, comm.size), comm.rank, levels)
    shared = {other: _shared_dofs(cut, element, other) for other in cut.corners}
    problem = discretize_on(cut.mesh, element, statement)
    return Piece(problem, shared, triangles=cut.triangles)


def _coarse_level(domain, n, size):
    """The level whose triangles are dealt out, and how often each is cut into four."""
    levels = 0
    if getattr(domain, "boundary", None) is None and hasattr(domain, "root"):
        while n > domain.coarsest and domain.count_triangles(n // 2) >= _TRIANGLES * size:
            n, levels = n // 2, levels + 1
    return n, levels


def _shared_dofs(cut, element, other):
    """The dofs that another process has, too: at coarse vertices, then along coarse facets."""
    chains = cut.chains.get(other, np.zeros((0, 3), dtype=int))
    if element.continuous:
        return np.concatenate([cut.corners[other], chains[:, 1:-1].ravel()])
    return facets_along(cut.mesh, chains).ravel()


def _check_enough(count, what, comm):
    if comm.size > count:
        raise SolverError(
            f"mpiexec -n {comm.size}: more processes than {what}, of which there are {count}; "
            f"start at most {count}"
        )
