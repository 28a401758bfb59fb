"""Processes started together by mpiexec: how many, what they agree on, and one voice for all."""

import os
import sys
import traceback

from signorini.exceptions import SignoriniError, SolverError
from signorini.memory import check_memory

# What the launchers of Open MPI, and of MPICH and Intel MPI, tell each process.
_SIZES, _RANKS = ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE"), ("OMPI_COMM_WORLD_RANK", "PMI_RANK")
_ASKED = (_SIZES, 1), (_RANKS, 0)


def _started():
    """How many processes were started together, and which of them this one is."""
    sizes = ([int(os.environ.get(name, least)) for name in names] for names, least in _ASKED)
    return tuple(map(max, sizes))


def check_alone(method):
    """Refuse a method of one process where several were started.

    Parameters
    ----------
    method : str

    Raises
    ------
    SolverError

    Examples
    --------
    >>> check_alone("direct")
    """
    count, rank = _started()
    if count > 1 and method != "petsc":
        if rank:
            sys.exit(1)
        raise SolverError(
            f"mpiexec: {count} processes, but solver.method {method} runs on one; "
            "leave mpiexec out, or give --method petsc"
        )


def processes():
    """The processes started together, as an mpi4py communicator; None where there is one alone."""
    count, rank = _started()
    if count == 1:
        return None
    from signorini.solvers.petsc import check_installed, why_not

    if rank and why_not(None):
        sys.exit(1)
    check_installed()
    from mpi4py import MPI

    return MPI.COMM_WORLD if MPI.COMM_WORLD.size > 1 else None


def agreed(comm, function):
    """What a function returns on this process; the first error of any process is raised on all.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    function : callable
        Without arguments; it does not communicate.

    Returns
    -------
    object
        What the function returns.

    Raises
    ------
    SignoriniError
    """
    result = error = None
    try:
        result = function()
    except SignoriniError as raised:
        error = raised
    errors = [other for other in comm.allgather(error) if other is not None]
    if errors:
        raise errors[0]
    return result


def in_one_voice(comm, function):
    """Run a function on all processes; only the first one tells of an error.

    An error that is no `SignoriniError` ends all processes, for the others may wait for this one.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    function : callable

    Returns
    -------
    object
        What the function returns.

    Raises
    ------
    SignoriniError
        Of the function, on the first process; the others end.
    """
    try:
        return function()
    except SignoriniError:
        if comm.rank:
            sys.exit(1)
        raise
    except Exception:
        traceback.print_exc()
        comm.Abort(1)


def check_room(comm, triangles, bytes_each):
    """Refuse a level whose shares do not fit the machines; each machine holds those of its own.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    triangles : int
    bytes_each : int

    Raises
    ------
    MeshError
    """
    from mpi4py import MPI

    here = comm.Split_type(MPI.COMM_TYPE_SHARED)
    share = -(-triangles * here.size // comm.size)
    what = f"the share of a mesh on a machine with {here.size} of {comm.size} processes"
    here.Free()
    check_memory(share, bytes_each, what)
