"""Multigrid only as far as it pays: to a tenth of the discretisation error, in the energy norm.

Full multigrid: from the coarsest level to the finest, each starts from the one before and takes two
V-cycles, the finest as many as it needs. Signs on the contact part are looked at once in every
cycle: a dof that pulls is let go, one below its obstacle is put onto it. Each cycle is one step of
steepest descent, preconditioned, so that what it lowers the energy by is known for nothing.

From these decreases follow both errors. With J the energy of a level's problem,

    |u_h - u_H|^2 / 2  is about  J(u_H) - J(u_h) = D,    |u - u_h|^2 = |u_h - u_H|^2 / (q - 1)

for q times as many unknowns and an error of first order in h; and the error that is left after
cycles that lowered the energy by ..., d', d is about (2 d r / (1 - r))^(1/2) with r = d / d'.
Brandt, Math. Comp. 31 (1977).
"""

import math
from dataclasses import dataclass, field

import numpy as np

from signorini.solvers.cycle import Cycle
from signorini.solvers.dot import dot
from signorini.solvers.extremes import largest
from signorini.solvers.level_solver import LevelSolver
from signorini.solvers.multigrid import Obstacle, levels_and_obstacles, prolong
from signorini.solvers.route_result import RouteResult
from signorini.work import count, counting

SHARE = 0.1  # of the discretisation error: what the algebraic error may be
# The estimate of the algebraic error was too small by 7.3 at most, for u singular at its corners;
# measured on the exact scenes.
_MARGIN = 8.0
_COARSE_CYCLES, _LEAST, _MOST = 2, 2, 12
_SLOWEST = 0.9  # ratio of successive decreases, at most, that is reckoned with


def solve_to_discretisation(problem, guess=None):
    """Solve a problem until the algebraic error is a tenth of the discretisation error.

    Parameters
    ----------
    problem : Problem
        With a Dirichlet part, and levels from meshes.
    guess : ndarray of bool, shape (nc,), optional
        The contact set to start from on the finest level.

    Returns
    -------
    RouteResult or None
        None where it cannot be done so: no mesh below, nothing fixed, or no fast convergence.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/corner.yaml"), "P1", 32)
    >>> result = solve_to_discretisation(problem)
    >>> result.algebraic_error < 0.1 * result.discretisation_error
    True
    """
    # Levels without a mesh tell nothing of the discretisation.
    if not problem.fixed.size or problem.mesh.coarser() is None:
        return None
    levels, obstacles = levels_and_obstacles(problem)
    if len(levels) < 2 or levels[0].robust:
        return None
    with counting():  # work on coarser levels is not that of the finest
        u, active = _coarsest(levels[-1:], obstacles[-1])
        for k in range(len(levels) - 2, 0, -1):
            start = prolong(levels[k], obstacles[k + 1], obstacles[k], u, active)
            coarse = _Descent(levels[k:], obstacles[k], *start)
            for _ in range(_COARSE_CYCLES):
                coarse.step()
            u, active = coarse.u, coarse.active
        u, active = prolong(levels[0], obstacles[1], obstacles[0], u, active)
    finest = _Descent(levels, obstacles[0], u, active if guess is None else guess)
    growth = levels[0].A.shape[0] / levels[1].A.shape[0]
    return _run(finest, max(growth, 1.5))


def _coarsest(levels, obstacle):
    """Solution and contact set of the coarsest level."""
    u = np.zeros(levels[0].A.shape[0])
    solver = LevelSolver(levels, obstacle, u, obstacle.b[obstacle.contact] <= 0.0)
    solver.solve(0.01 / u.size)
    return solver.u, solver.active


def _run(descent, growth):
    """Cycles on the finest level until the goal is met."""
    for number in range(1, _MOST + 1):
        descent.step()
        if number < _LEAST:
            continue
        algebraic = _MARGIN * descent.algebraic_error()
        discretisation = descent.discretisation_error(growth)
        if algebraic <= SHARE * discretisation:
            return descent.result(algebraic, discretisation)
    return None


@dataclass(eq=False)
class _Descent:
    """Preconditioned steepest descent on one level, with its contact set in view.

    Attributes
    ----------
    levels : list of Level
        This one first.
    obstacle : Obstacle
    u : ndarray, shape (n,)
        Never below the obstacle.
    active : ndarray of bool, shape (nc,)
    r : ndarray, shape (n,)
        The residual b - A u.
    decreases : list of float
        What each step lowered the energy by.
    cycle : Cycle or None
        With the unknowns `constrained`, numbers, held; made when first needed.
    last : float
        The largest change of u in the last step.
    """

    levels: list
    obstacle: Obstacle
    u: np.ndarray
    active: np.ndarray
    r: np.ndarray | None = None
    decreases: list = field(default_factory=list)
    cycle: Cycle | None = None
    constrained: np.ndarray | None = None
    last: float = 0.0

    def __post_init__(self):
        contact, lower = self.obstacle.contact, self.obstacle.lower
        self.u[self.obstacle.fixed] = self.obstacle.fixed_values
        self.active = self.active | (self.u[contact] < lower)
        self.u[contact] = np.where(self.active, lower, self.u[contact])
        self.r = self.levels[0].A @ self.u
        np.subtract(self.obstacle.b, self.r, out=self.r)
        count(products=1)

    def step(self):
        """Release dofs that pull, take one cycle, and put those below the obstacle onto it."""
        pulls = self.active & (self.r[self.obstacle.contact] > 0.0)
        if self.cycle is None or pulls.any():
            self.active = self.active & ~pulls
            self._hold()
        residual = self.r.copy()
        residual[self.constrained] = 0.0
        z = self.cycle(residual)
        Az = self.levels[0].A @ z
        slope, bend = dot(residual, z), dot(z, Az)
        if not (slope > 0.0 and bend > 0.0):
            self.decreases.append(0.0)
            return
        length = slope / bend
        self.decreases.append(0.5 * length * slope)
        self.last = length * largest(z)
        self.u += np.multiply(z, length, out=z)
        self.r -= np.multiply(Az, length, out=Az)
        count(products=1, cycles=1)
        self._lift()

    def _hold(self):
        """A cycle with the contact set as it is."""
        constrained = self.obstacle.constrained(self.active)
        self.constrained = np.flatnonzero(constrained)
        self.cycle = Cycle(self.levels, constrained)

    def _lift(self):
        """Dofs below the obstacle are put onto it, and bind."""
        contact, lower = self.obstacle.contact, self.obstacle.lower
        low = np.flatnonzero(self.u[contact] < lower)
        if not low.size:
            return
        moved = lower[low] - self.u[contact[low]]
        self.u[contact[low]] = lower[low]
        self.r -= self.levels[0].A[contact[low]].T @ moved
        self.active = self.active.copy()
        self.active[low] = True
        self._hold()

    def algebraic_error(self):
        """Estimated energy norm of what is left, by the last two decreases."""
        before, last = self.decreases[-2:]
        ratio = min(last / before, _SLOWEST) if before > 0.0 else 0.0
        return float(np.sqrt(2.0 * last * ratio / (1.0 - ratio)))

    def discretisation_error(self, growth):
        """Estimated energy norm of u - u_h, by all decreases of this level."""
        return float(np.sqrt(2.0 * math.fsum(self.decreases) / (growth - 1.0)))

    def result(self, algebraic, discretisation):
        """The answer, with both errors."""
        force = -self.r[self.obstacle.contact]
        variation = float(np.ptp(self.u)) or 1.0
        return RouteResult(
            u=self.u,
            active=self.active,
            iterations=len(self.decreases),
            accuracy=self.last / variation,
            multiplier=np.where(self.active, np.maximum(force, 0.0), 0.0),
            multiplier_accuracy=np.inf,
            undecided=np.ones(self.active.shape, dtype=bool),
            algebraic_error=algebraic,
            discretisation_error=discretisation,
        )
