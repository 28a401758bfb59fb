"""A first contact set by PETSc: SNES vinewtonrsls, semismooth Newton steps on a reduced space."""

import numpy as np

from signorini.solvers.petsc.held import PREFIX, set_up

_LINEAR, _NONLINEAR, _MAX_STEPS = 1e-4, 1e-8, 60


def contact_set(share, guess=None):
    """A solution and its contact set, both to be improved.

    Parameters
    ----------
    share : Share
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind.

    Returns
    -------
    u : ndarray, shape (m,)
    active : ndarray of bool, shape (nc,)
    steps : int
        Newton steps.
    """
    from petsc4py import PETSc

    u = _start(share, guess)
    K, load = _without_fixed(share)
    x, size = share.vector(u), load.norm() or 1.0
    snes = PETSc.SNES().create(share.comm)
    snes.setType("vinewtonrsls")
    snes.setFunction(lambda snes, x, r: (K.mult(x, r), r.axpy(-1.0, load)), load.duplicate())
    snes.setJacobian(lambda snes, x, J, P: None, K)
    snes.setVariableBounds(*_bounds(share))
    snes.setTolerances(rtol=0.0, atol=_NONLINEAR * size, stol=0.0, max_it=_MAX_STEPS)
    snes.setOptionsPrefix(PREFIX)
    set_up(snes.getKSP())
    snes.getKSP().setTolerances(rtol=_LINEAR)
    snes.setFromOptions()
    snes.solve(None, x)
    force = share.forces(u, share.b)
    gap = share.on_contact(u[share.contact] - share.lower)
    return u, (gap <= 0.0) & (force > 0.0), snes.getIterationNumber()


def _start(share, guess):
    """Dirichlet values, the obstacle where there is contact, and nothing elsewhere.

    Where a guess says that a dof does not bind, it starts a little above the obstacle.
    """
    u = np.zeros_like(share.b)
    u[share.fixed] = share.fixed_values
    free = 0.0 if guess is None else ~guess[share.places] * (1.0 + np.abs(share.lower))
    u[share.contact] = share.lower + free
    return u


def _without_fixed(share):
    """The matrix whose fixed dofs stand alone, and the load that holds them where they are."""
    K, u = share.matrix(), np.zeros_like(share.b)
    u[share.fixed] = share.fixed_values
    load, rows = share.vector(share.b.copy()), share.rows_of(share.constrained(_none(share)))
    K.zeroRowsColumns(rows, diag=1.0, x=share.vector(u), b=load)
    return K, load


def _none(share):
    return np.zeros(share.count, dtype=bool)


def _bounds(share):
    from petsc4py import PETSc

    low = np.full(share.b.size, PETSc.NINFINITY)
    low[share.contact] = share.lower
    return share.vector(low), share.vector(np.full(share.b.size, PETSc.INFINITY))
