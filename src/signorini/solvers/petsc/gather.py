"""A shared solution as one: numbered as the whole problem is, on the first process."""

import numpy as np

from signorini.fem.elements import find_element
from signorini.solvers.stored import StoredSolution


def gathered(solution, joined, piece, domain, n):
    """The solution on the first process, as it would be stored; None on the others.

    The first process needs room for all of u; and where the mesh is no grid, for the whole mesh,
    whose numbering it takes.

    Parameters
    ----------
    solution : SharedSolution
    joined : Joined
    piece : Piece
    domain : Rectangle or Refined
    n : int
        The level.

    Returns
    -------
    StoredSolution or None
    """
    share, comm, problem = joined.share, joined.share.comm, piece.problem
    numbers = _numbers(piece, domain, n, comm)[joined.own]
    contact = np.concatenate(comm.allgather(numbers[share.contact]))
    parts = comm.gather((numbers, solution.u))
    if comm.rank:
        return None
    u = np.empty(sum(own.size for own, _ in parts))
    for own, values in parts:
        u[own] = values
    order = np.argsort(contact)
    names = ("multiplier", "active", "undecided", "lower")
    sign = -1.0 if problem.upper else 1.0
    threshold = None if joined.threshold is None else sign * joined.threshold[order]
    return StoredSolution(
        element=problem.element,
        n=n,
        h=domain.mesh_size(n),
        dofs=solution.dofs,
        u=u,
        contact=contact[order].astype(np.int32),
        residual=solution.residual,
        accuracy=solution.accuracy,
        multiplier_accuracy=solution.multiplier_accuracy,
        status=solution.status,
        iterations=solution.iterations,
        method=solution.method,
        threshold=threshold,
        upper=problem.upper,
        **{name: getattr(solution, name)[order] for name in names},
    )


def _numbers(piece, domain, n, comm):
    """The numbers of a piece's dofs in the whole problem, shape (ndof,)."""
    if piece.numbers is not None:
        return piece.numbers
    element, mesh = find_element(piece.problem.element), piece.problem.mesh
    count = piece.problem.b.size
    pieces = comm.gather((piece.triangles, element.triangle_dofs(mesh), count))
    if comm.rank:
        return comm.scatter(None)
    whole = element.triangle_dofs(domain.level(n))
    return comm.scatter([_by_triangles(whole, *part) for part in pieces])


def _by_triangles(whole, triangles, dofs, count):
    """Numbers of a piece's dofs, from those of its triangles in the whole mesh."""
    numbers = np.empty(count, dtype=whole.dtype)
    numbers[dofs] = whole[:, triangles]
    return numbers
