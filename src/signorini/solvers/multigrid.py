"""The multigrid route: conjugate gradients with a V-cycle, on every level from the coarsest to the
finest.

Each level starts from the solution and the contact set of the one before (nested iteration). While
conjugate gradients run, signs on the contact part are looked at in every step: what violates them
by more than the error that is left nearby changes sides, and the iteration goes on with the new set
held. So a set is never solved for more accurately than is needed to see that it is wrong. Exchanges
are safeguarded as on the other routes (`pivoting.PivotingRule`).

On the finest level conjugate gradients run on corrections, each time from a residual by
differences, so that no entry of A limits them; then the errors of gaps and forces are bounded, and
their signs are held against the bounds.
"""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SolverError
from signorini.memory import check_memory
from signorini.solvers.check import resting_parts
from signorini.solvers.conditioning import accuracy_loss_causes
from signorini.solvers.hierarchy import build_hierarchy
from signorini.solvers.level import HALF
from signorini.solvers.level_solver import LevelSolver
from signorini.solvers.route_result import USELESS_ACCURACY, ErrorEstimates
from signorini.solvers.signs import settle
from signorini.work import counting


def why_not(problem):
    """Say why the route does not apply to a problem, or None where it does.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> why_not(problem) is None
    True
    """
    most, stretch = problem.finite_element.facts.multigrid_stretch, problem.mesh.stretch
    if stretch > most:
        return (
            f"there are cells {stretch:.0f} times as long as high, "
            f"and {problem.element} takes at most {most:g}"
        )
    return None


def solve_multigrid(problem, guess=None, tolerance=0.0):
    """Solve any problem.

    Parameters
    ----------
    problem, guess
        As of `solvers.fourier.solve_fourier`, also for what is raised.
    tolerance : float
        Estimated error, relative to the variation of u, at which to end without a proof; 0 for the
        last bit and a proof.

    Returns
    -------
    RouteResult

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 32)
    >>> result = solve_multigrid(problem)
    >>> result.accuracy < 1e-13, int(result.active.sum())
    (True, 10)
    """
    levels, obstacles = levels_and_obstacles(problem)
    u = np.zeros(levels[-1].A.shape[0])
    active = obstacles[-1].b[obstacles[-1].contact] <= 0.0
    with counting():  # work on coarser levels is not that of the finest
        for k in range(len(levels) - 1, 0, -1):
            solver = LevelSolver(levels[k:], obstacles[k], u, active)
            solver.solve(0.1 / u.size)
            u, active = prolong(
                levels[k - 1], obstacles[k], obstacles[k - 1], solver.u, solver.active
            )
    active = active if guess is None else guess
    solver = _FinestSolver(problem, levels, obstacles[0], u, active)
    if tolerance:
        solver.solve(tolerance)
        nothing = np.zeros(problem.contact.size)
        return solver.result(
            ErrorEstimates(tolerance * np.ptp(solver.u), 0.0, *[nothing] * 3, nothing + 1.0, 0.0)
        )
    return settle(solver)


def levels_and_obstacles(problem):
    """The levels of a problem, and what their unknowns obey, finest first.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    levels : list of Level
    obstacles : list of Obstacle

    Raises
    ------
    MeshError
        If the memory is too small, or the meshes do not nest.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 64)
    >>> levels, _ = levels_and_obstacles(problem)
    >>> [level.A.shape[0] for level in levels]
    [4225, 1089, 289, 81]
    """
    check_memory(
        problem.mesh.number_of_triangles,
        problem.finite_element.facts.multigrid_bytes,
        "a mesh for solver.method multigrid",
    )
    levels = build_hierarchy(problem)
    obstacles = [
        Obstacle(problem.b, problem.contact, problem.lower, problem.fixed, problem.fixed_values)
    ]
    for level in levels[:-1]:
        obstacles.append(obstacles[-1].restricted(level))
    return levels, obstacles


class _FinestSolver(LevelSolver):
    """The search on the finest level, to the last bit."""

    def __init__(self, problem, levels, obstacle, u, active):
        super().__init__(levels, obstacle, u, active)
        self.problem, self.parts = problem, resting_parts(problem)

    def refine(self):
        errors = super().refine()
        if not errors.u <= USELESS_ACCURACY * np.ptp(self.u):
            causes = accuracy_loss_causes(self.problem)
            raise SolverError(f"domain: no digit of the solution survives rounding: {causes}")
        return errors


@dataclass(frozen=True, eq=False)
class Obstacle:
    """What a level's unknowns obey besides A: load, obstacle and Dirichlet values; names as in
    `Problem`.
    """

    b: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    fixed: np.ndarray
    fixed_values: np.ndarray

    def constrained(self, active):
        """Which unknowns do not move, shape (n,): the fixed ones, and those in the contact set
        `active`.

        Examples
        --------
        >>> contact, fixed = np.array([1, 2]), np.array([0])
        >>> obstacle = Obstacle(np.zeros(4), contact, np.zeros(2), fixed, np.zeros(1))
        >>> obstacle.constrained(np.array([False, True]))
        array([ True, False,  True, False])
        """
        constrained = np.zeros(self.b.size, dtype=bool)
        constrained[self.fixed] = True
        constrained[self.contact[active]] = True
        return constrained

    def restricted(self, level):
        """The same on the next coarser level: means of the obstacle and of the Dirichlet values
        nearby.
        """
        fixed, values = _restricted_values(level, self.fixed, self.fixed_values)
        contact, lower = _restricted_values(level, self.contact, self.lower)
        apart = ~np.isin(contact, fixed)
        return Obstacle(level.R @ self.b, contact[apart], lower[apart], fixed, values)


def _restricted_values(level, marked, values):
    marks, weighted = np.zeros(level.A.shape[0]), np.zeros(level.A.shape[0])
    marks[marked], weighted[marked] = 1.0, values
    weight = level.R @ marks
    result = np.flatnonzero(weight >= HALF)
    return result, (level.R @ weighted)[result] / weight[result]


def prolong(level, coarse, fine, u, active):
    """A coarse solution as a start for the next level.

    Parameters
    ----------
    level : Level
        The finer one.
    coarse, fine : Obstacle
    u : ndarray, shape (m,)
    active : ndarray of bool
        The contact set of the coarser level.

    Returns
    -------
    u : ndarray, shape (n,)
    active : ndarray of bool
        Where all that an unknown is made of binds.
    """
    marks = np.zeros(u.size)
    marks[coarse.contact[active]] = 1.0
    return level.P @ u, (level.P @ marks)[fine.contact] > 0.75
