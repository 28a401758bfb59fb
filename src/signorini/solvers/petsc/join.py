"""Pieces joined into shares: dofs numbered process after process, rows summed where pieces meet.

A dof that several processes have belongs to the first of them. No process ever holds more than its
own rows.
"""

from dataclasses import dataclass

import numpy as np

from signorini.solvers.petsc.share import Share


@dataclass(frozen=True, eq=False)
class Joined:
    """A share, and where its dofs are on the piece.

    Parameters
    ----------
    share : Share
    own : ndarray of int, shape (m,)
        The dofs of the piece that this process owns, increasing.
    threshold : ndarray, shape (nc,), or None
        Of `Problem`, at all contact dofs.
    """

    share: Share
    own: np.ndarray
    threshold: np.ndarray | None


def join(piece, comm):
    """The share of a process, from the pieces of all.

    Parameters
    ----------
    piece : Piece
        Whose constraint is from below.
    comm : mpi4py.MPI.Comm

    Returns
    -------
    Joined
    """
    problem = piece.problem
    own, numbers = _number(piece, comm)
    gather = _Sum(numbers, own.size, comm)
    A, ghosts = _rows(problem.A, gather)
    fixed, fixed_values = gather.mean_at(problem.fixed, problem.fixed_values)
    contact, lower = gather.mean_at(problem.contact, problem.lower)
    kept = ~np.isin(contact, fixed)
    contact = contact[kept]
    first = int(comm.exscan(contact.size) or 0)
    share = Share(
        comm=comm,
        A=A,
        ghosts=ghosts,
        b=gather.total(problem.b),
        fixed=fixed,
        fixed_values=fixed_values,
        contact=contact,
        lower=lower[kept],
        places=first + np.arange(contact.size),
        count=comm.allreduce(contact.size),
    )
    return Joined(share, own, _threshold(problem, gather, share))


def _threshold(problem, gather, share):
    load = problem.contact_load
    return None if load is None else share.on_contact(gather.total(load)[share.contact])


def _number(piece, comm):
    """The dofs of the piece that are this process's own, and the numbers (ndof,) of all of them."""
    count = piece.problem.b.size
    owner = np.full(count, comm.rank)
    for other, dofs in piece.shared.items():
        owner[dofs] = np.minimum(owner[dofs], other)
    own = np.flatnonzero(owner == comm.rank)
    numbers = np.full(count, -1, dtype=np.int64)
    numbers[own] = int(comm.exscan(own.size) or 0) + np.arange(own.size)
    sent = [numbers[piece.shared[k]] if k in piece.shared else None for k in range(comm.size)]
    for other, theirs_sent in enumerate(comm.alltoall(sent)):
        if theirs_sent is not None:
            dofs, theirs = piece.shared[other], owner[piece.shared[other]] == other
            numbers[dofs[theirs]] = theirs_sent[theirs]
    return own, numbers


class _Sum:
    """Sums of what pieces contribute, for the processes that own the dofs."""

    def __init__(self, numbers, count, comm):
        from petsc4py import PETSc

        self.numbers, self.count, self.comm = numbers.astype(PETSc.IntType), count, comm
        self.map = PETSc.LGMap().create(self.numbers, comm=comm)

    def total(self, values):
        """The sums, shape (m,), of values (ndof,)."""
        from petsc4py import PETSc

        vector = PETSc.Vec().createMPI((self.count, None), comm=self.comm)
        vector.setValues(self.numbers, values, addv=PETSc.InsertMode.ADD_VALUES)
        vector.assemble()
        return vector.getArray().copy()

    def mean_at(self, dofs, values):
        """The own dofs that any piece names, increasing, and the mean of what pieces say there."""
        size = self.numbers.size
        times = self.total(np.bincount(dofs, minlength=size).astype(float))
        sums = self.total(np.bincount(dofs, values, minlength=size))
        named = np.flatnonzero(times)
        return named, sums[named] / times[named]


def _rows(A, gather):
    """The own rows of the sum of all pieces' matrices, and the numbers of their ghosts."""
    from petsc4py import PETSc
    from scipy.sparse import csr_array

    entries = A.indptr.astype(PETSc.IntType), A.indices.astype(PETSc.IntType), A.data
    local = PETSc.Mat().createAIJ(A.shape, csr=entries, comm=PETSc.COMM_SELF)
    m = gather.count
    sizes, here = ((m, None), (m, None)), gather.map
    matrix = PETSc.Mat().createIS(sizes, here, here, comm=gather.comm)
    matrix.setISLocalMat(local)
    matrix.assemble()
    matrix.convert("aij")
    indptr, indices, data = matrix.getValuesCSR()
    first, last = matrix.getOwnershipRange()
    inside = (indices >= first) & (indices < last)
    ghosts = np.unique(indices[~inside])
    columns = np.where(inside, indices - first, m + np.searchsorted(ghosts, indices))
    return csr_array((data, columns, indptr), shape=(m, m + ghosts.size)), ghosts
