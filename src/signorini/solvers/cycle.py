"""Multigrid cycles on the levels of a hierarchy, some unknowns constrained: preconditioners."""

import numpy as np

from signorini.solvers.algebraic import algebraic_levels


class Cycle:
    """A V(1,1) cycle with some unknowns constrained.

    It is a symmetric positive definite preconditioner of A on the others.

    It sweeps forwards before and backwards after the coarse correction, by Gauss and Seidel.

    Parameters
    ----------
    levels : list of Level
    constrained : ndarray of bool, shape (n,)
        Unknowns of the first level that do not move. A coarse unknown does not move if at least
        half of a constrained one depends on it.
    """

    def __init__(self, levels, constrained):
        self.levels, self.constrained, self.free = levels, [], []
        for level in levels:
            self.constrained.append(np.flatnonzero(constrained))
            self.free.append(np.flatnonzero(~constrained).astype(np.int32))
            if level.P is not None:
                constrained = level.coarse_mask(constrained)
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
        rest[self.constrained[k]] = 0.0
        correction = level.P @ self(level.R @ rest, k + 1)
        correction[self.constrained[k]] = 0.0
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


class EliminatedCycle:
    """The same with the constrained unknowns eliminated first.

    Levels follow what is left of the matrix, and no mesh.
    """

    def __init__(self, levels, constrained):
        self.level, self.rows = levels[0], np.flatnonzero(~constrained)
        A = levels[0].A[self.rows][:, self.rows]
        inner = algebraic_levels(A, robust=True)
        self.inner = Cycle(inner, np.zeros(self.rows.size, dtype=bool))

    def __call__(self, r):
        """As `Cycle`."""
        z = np.zeros_like(r)
        z[self.rows] = self.inner(r[self.rows])
        return z


def preconditioner(levels, constrained):
    """A preconditioner with some unknowns constrained.

    Parameters
    ----------
    levels : list of Level
        Finest first.
    constrained : ndarray of bool, shape (n,)

    Returns
    -------
    Cycle or Eliminated
        The latter where the levels ask for it.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.solvers.hierarchy import build_hierarchy
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 32)
    >>> constrained = np.zeros(problem.b.size, dtype=bool)
    >>> constrained[problem.fixed] = True
    >>> cycle = preconditioner(build_hierarchy(problem), constrained)
    >>> z = cycle(np.where(constrained, 0.0, problem.b))
    >>> bool(np.any(z[~constrained])), bool(np.any(z[constrained]))
    (True, False)
    """
    return (EliminatedCycle if levels[0].robust else Cycle)(levels, constrained)
