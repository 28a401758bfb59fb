"""The adaptive loop: solve both elements, certify, mark, bisect; until a bound is guaranteed.

P1 and CR are both solved on every mesh, since a certificate needs a continuous function and a flux
in equilibrium. The bound that ends the loop, and the marks, are those of one of them.
"""

import logging
import math
import time
from dataclasses import dataclass, replace

import numpy as np

from signorini.adapt.marking import bulk
from signorini.certificate.certify import certify_level
from signorini.certificate.constants import friedrichs_constant
from signorini.exceptions import MeshError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.memory import fits, shortage
from signorini.mesh.bisection import bisect
from signorini.solvers import solve

_log = logging.getLogger(__name__)
# Any continuous function serves a certificate, and P1's need not be more accurate than its mesh. A
# flux must be in equilibrium to the last bit, and CR's solution is what it is made of.
_ACCURACY = {"P1": "discretisation", "CR": "full"}
STAGES = ("refine", "solve", *ELEMENTS, "certify")
"""What a step takes seconds for: to make its mesh, to solve, each element alone, and to certify."""
_BYTES = 800  # per triangle, of solving and certifying both elements; measured at 1.2 million


@dataclass(frozen=True)
class Goal:
    """When the loop ends, and how it refines.

    Parameters
    ----------
    bound : float
        The guaranteed energy error at which to end, unit of the energy norm; 0 for never.
    element : {"P1", "CR"}
        Whose error is to be bounded.
    theta : float
        Share of the squared bound that the marked triangles carry, see `marking.bulk`.
    start : int
        Level of the first mesh.
    max_dofs : int
        Degrees of freedom of the element, fixed ones included, beyond which no mesh is solved.
    max_seconds : float
        After which no further mesh is begun.
    max_memory : float
        GB that a mesh may be expected to need; whatever it is, no mesh is begun that this machine
        cannot hold.
    uniform : bool
        Whether to refine every triangle: what an adaptive run is held against.
    """

    bound: float = 0.0
    element: str = "P1"
    theta: float = 0.5
    start: int = 4
    max_dofs: int = 200_000
    max_seconds: float = np.inf
    max_memory: float = np.inf
    uniform: bool = False


@dataclass(frozen=True, eq=False)
class Step:
    """One mesh of the loop.

    Parameters
    ----------
    number : int
        Counted from 0.
    mesh : Grid or Triangulation
    solutions, certificates : dict
        `Solution` and `Certificate` of each element, by name.
    seconds : dict of str to float
        What this step took, for each of `STAGES`.
    marked : ndarray of bool, shape (nt,), or None
        What is refined next; None on the last mesh.
    reason : str
        Why the loop ends here; empty where it goes on.
    """

    number: int
    mesh: object
    solutions: dict
    certificates: dict
    seconds: dict
    marked: np.ndarray | None = None
    reason: str = ""


def adaptive_steps(statement, goal, marks=()):
    """Solve and refine until the goal is reached, or a limit.

    Parameters
    ----------
    statement : ProblemStatement
        Its load is integrated exactly, whatever its load quadrature says.
    goal : Goal
    marks : sequence of ndarray of bool, optional
        Of earlier steps, which are then refined and not solved again: an interrupted run goes on.

    Yields
    ------
    Step
        The last one says why it is the last.

    Raises
    ------
    SolverError, SceneError, FormulaError, MeshError
        Where a mesh cannot be solved or certified, or the first one not be made.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/corner.yaml")
    >>> goal = Goal(bound=0.1, start=4)
    >>> *_, last = adaptive_steps(scene.problem_statement, goal)
    >>> last.certificates["P1"].upper <= 0.1, last.reason
    (True, 'the bound is met')
    """
    exact = replace(statement, load_quadrature="exact")
    began = time.perf_counter()
    first = mesh = exact.triangulations.level(goal.start)
    for marked in marks:
        mesh = bisect(mesh, marked)
    refined = time.perf_counter()
    friedrichs = friedrichs_constant(first)  # of the body: the same on every mesh
    spent = {"refine": refined - began, "certify": time.perf_counter() - refined}
    solutions, number = None, len(marks)
    while True:
        step = _solved(exact, mesh, number, solutions, spent, friedrichs)
        if not (reason := _reason(step, goal, time.perf_counter() - began)):
            marked = _marked(step, goal)
            start = time.perf_counter()
            mesh, reason = _refined(step.mesh, marked, goal)
            spent = {"refine": time.perf_counter() - start, "certify": 0.0}
        if reason:
            yield replace(step, reason=reason)
            return
        yield replace(step, marked=marked)
        solutions, number = step.solutions, number + 1


def _solved(statement, mesh, number, before, spent, friedrichs):
    """Solve both elements on a mesh and certify them; `spent` are seconds for it so far."""
    _log.info("step %d: %d triangles, solving", number, mesh.number_of_triangles)
    solutions, seconds = {}, {}
    for name in ELEMENTS:
        start = time.perf_counter()
        solutions[name] = _solution(statement, mesh, name, before)
        seconds[name] = time.perf_counter() - start
    start = time.perf_counter()
    _log.info("step %d: certifying", number)
    certificates, _ = certify_level(
        mesh,
        statement.data,
        *(solutions[name].u for name in ("P1", "CR")),
        rule=statement.load_quadrature,
        A=solutions["CR"].problem.A,
        friedrichs=friedrichs,
    )
    certify_seconds = spent["certify"] + time.perf_counter() - start
    solve_seconds = math.fsum(seconds.values())
    seconds |= spent | {"solve": solve_seconds, "certify": certify_seconds}
    seconds = {stage: seconds[stage] for stage in STAGES}
    return Step(number, mesh, solutions, certificates, seconds)


def _solution(statement, mesh, name, before):
    """That of one element, from the contact set of the mesh before."""
    problem = discretize_on(mesh, name, statement)
    guess = None
    if before is not None:
        guess = _inherited(ELEMENTS[name], before[name], problem)
    return solve(problem, guess=guess, accuracy=_ACCURACY[name])


def _inherited(element, solution, problem):
    """The contact set of the mesh before, as one of the finer mesh to start from."""
    coarse = solution.problem
    binds = np.zeros(coarse.b.size, dtype=bool)
    binds[coarse.contact[solution.active]] = True
    return element.inherited(problem.mesh, binds, problem.contact)


def _marked(step, goal):
    certificate = step.certificates[goal.element]
    if goal.uniform:
        return np.ones(step.mesh.number_of_triangles, dtype=bool)
    return bulk(certificate.contributions, goal.theta)


def _reason(step, goal, seconds):
    """Why the loop ends with a step, or nothing."""
    certificate = step.certificates[goal.element]
    if certificate.upper <= goal.bound:
        return "the bound is met"
    if not np.any(certificate.contributions > 0.0):
        return "no triangle contributes to the bound: refinement does not lower it"
    if seconds >= goal.max_seconds:
        return f"the limit of {goal.max_seconds:g} s is reached"
    return ""


def _refined(mesh, marked, goal):
    """The next mesh, and why it is not to be solved, or nothing."""
    try:
        finer = bisect(mesh, marked)
    except MeshError as error:  # no coordinates between those that there are
        return None, f"no finer mesh: {error}"
    return finer, _too_large(finer, goal)


def _too_large(mesh, goal):
    """Why a mesh is not to be solved, or nothing."""
    size, triangles = ELEMENTS[goal.element].size(mesh), mesh.number_of_triangles
    if size > goal.max_dofs:
        return f"the next mesh has {size} degrees of freedom, more than {goal.max_dofs}"
    if triangles * _BYTES > goal.max_memory * 1e9:
        needed = triangles * _BYTES / 1e9
        return f"the next mesh needs about {needed:.2g} GB of memory, more than {goal.max_memory:g}"
    if not fits(triangles, _BYTES):
        return f"the next mesh {shortage(triangles, _BYTES)}"
    return ""
