"""The petsc route: PETSc's solvers, on one process or on many, of one machine or of several.

PETSc is an optional extra. `SNES vinewtonrsls` finds a contact set; with it held, conjugate
gradients with algebraic multigrid (hypre's, else PETSc's own) solve for corrections, each from a
residual by differences, so that u is as accurate as on the other routes; signs are then held
against estimated errors, as on the others. All arrays of the size of u are shares of it
(`share.Share`); those of the contact dofs, which are few, are whole on every process.
"""

import importlib.util

from signorini.exceptions import NotApplicableError

PACKAGES = ("petsc4py", "mpi4py")
INSTALL = "make petsc"


def why_not(problem):
    """Say why the route does not apply, or None where it does: it takes any problem, but is extra.

    Parameters
    ----------
    problem : Problem or None
        Not looked at.

    Returns
    -------
    str or None

    Examples
    --------
    >>> reason = why_not(None)
    >>> reason is None or "make petsc" in reason
    True
    """
    absent = [name for name in PACKAGES if importlib.util.find_spec(name) is None]
    if absent:
        return f"without {' and '.join(absent)}: `{INSTALL}` installs what it needs"
    return None


def check_installed():
    """Refuse the route where its packages are absent.

    Raises
    ------
    NotApplicableError
        Saying how to install them.
    """
    if reason := why_not(None):
        raise NotApplicableError(f"solver.method: petsc does not apply, {reason}")


def solve_petsc(problem, guess=None):
    """Solve any problem on this process; arguments and errors as in `solvers.direct.solve_direct`.

    Parameters
    ----------
    problem : Problem
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind.

    Returns
    -------
    RouteResult
    """
    check_installed()
    from mpi4py import MPI

    from signorini.solvers.petsc.search import search
    from signorini.solvers.petsc.share import whole

    return search(whole(problem, MPI.COMM_SELF), guess)
