"""Linear solves with a contact set held: conjugate gradients with algebraic multigrid.

Anything here can be set by PETSc's options under the prefix ``signorini_``, for instance
``PETSC_OPTIONS="-signorini_pc_type gamg"``.
"""

import numpy as np

from signorini.exceptions import SolverError

PREFIX = "signorini_"
CORRECTION, RESPONSE = 1e-10, 1e-2  # to which corrections and effects of rounding are solved
_MAX_STEPS = 500


def set_up(ksp):
    """Make a PETSc linear solver one of conjugate gradients with algebraic multigrid."""
    from petsc4py import PETSc

    ksp.setType("cg")
    ksp.getPC().setType("hypre" if PETSc.Sys.hasExternalPackage("hypre") else "gamg")


class Held:
    """A share's rows with the dofs of a contact set, and the fixed ones, held where they are.

    Parameters
    ----------
    share : Share
    active : ndarray of bool, shape (nc,)
    """

    def __init__(self, share, active):
        from petsc4py import PETSc

        self.share, self.active = share, active.copy()
        self.constrained = share.constrained(active)
        matrix = share.matrix()
        self.diagonal = matrix.getDiagonal().getArray().copy()
        matrix.zeroRowsColumns(share.rows_of(self.constrained), diag=1.0)
        self.ksp = PETSc.KSP().create(share.comm)
        self.ksp.setOperators(matrix)
        self.ksp.setOptionsPrefix(PREFIX)
        set_up(self.ksp)
        self.ksp.setFromOptions()

    def displacement(self, load, tolerance):
        """What a load does: the change of u (m,), and the forces it leaves on held contact dofs.

        Parameters
        ----------
        load : ndarray, shape (m,)
        tolerance : float
            Of the residual in the preconditioned norm, relative.

        Returns
        -------
        z : ndarray, shape (m,)
        forces : ndarray, shape (nc,)

        Raises
        ------
        SolverError
            If the linear solver fails.
        """
        z, right = np.zeros_like(load), np.where(self.constrained, 0.0, load)
        self.ksp.setTolerances(rtol=tolerance, atol=0.0, max_it=_MAX_STEPS)
        if self.share.largest(right):
            self.ksp.solve(self.share.vector(right), self.share.vector(z))
            self._check()
        return z, np.where(self.active, self.share.forces(z, load), 0.0)

    def _check(self):
        from petsc4py import PETSc

        reason = self.ksp.getConvergedReason()
        # Where the limit is reached the step is still one in a good direction.
        if reason < 0 and reason != PETSc.KSP.ConvergedReason.DIVERGED_MAX_IT:
            raise SolverError(
                f"petsc: the linear solver gave up, PETSc's reason {reason}; "
                "set solver.method to direct, or to auto"
            )
