"""What the solves of a scene take, said before any of them: jobs, processor time, memory, disk.

Nothing is meshed or solved. A solve costs what `scene.costs` says; what stands around it was
measured on two cores that did other work too, 26 November 2026.
"""

import json
import math
from dataclasses import dataclass

from signorini.scene.costs import solve_cost
from signorini.scene.job_costs import errors_cost
from signorini.scene.memory_check import count_roughly, fourier_applies
from signorini.scene.read import scene_of_point
from signorini.scene.scene import Scene
from signorini.sweeps.bundles import STATED, bundles
from signorini.sweeps.jobs import Job

# Seconds of a job beside its solves: the start of Python, its libraries, reading and writing.
STARTS = {
    "mesh": 0.35,
    "solve": 0.42,
    "reference": 0.42,
    "sweep_points": 0.6,
    "sweep_table": 0.6,
    "sweep_figure": 1.2,
}
# Bytes of the memory of jobs that solve nothing, and what a job of points needs beside its solves.
_MEMORY = {"mesh": 5e7, "sweep_table": 8.5e7, "sweep_figure": 1.1e8}
_POINTS_MEMORY = 1e7
_POINT_SECONDS = 0.005  # a point beside its solves, docs/sweeps.md
_MEASURE_SECONDS = {"exact": 0.015}  # errors of a solution by the kind of the truth, if they show
# On disk: a solution's numbers that are no field, a point's scene and record, a row of it.
_SOLUTION_BYTES, _POINT_BYTES, _ROW_BYTES = 4000, 1500, 1100
_FIELD_BYTES = {"P1": 4, "CR": 12}  # of u for each triangle: vertices, sides, in double precision
# Keys on which it depends how much a point takes, beside those of whole sections.
_SHAPING_SECTIONS = ("elements", "levels", "solver", "domain")
_SHAPING_KEYS = ("truth", "truth.kind", "truth.element", "truth.n")


@dataclass(frozen=True)
class _Shape:
    """What a point takes, alone: its scene, seconds and bytes by element and level, and the bytes
    of measuring its errors.
    """

    scene: Scene
    costs: dict
    measuring: float


def scene_jobs(scene):
    """The jobs that solve the levels of a scene.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    list of Job

    Examples
    --------
    >>> from signorini import load_scene
    >>> jobs = scene_jobs(load_scene("config/scenes/paper.yaml"))
    >>> [job.rule for job in jobs][:2], sum(job.solves for job in jobs)
    (['mesh', 'solve'], 13)
    """
    levels = [(element, n) for element in scene.elements for n in scene.levels]
    jobs = [_solve_job(scene, "solve", element, n) for element, n in levels]
    jobs += [_solve_job(scene, "reference", element, n) for element, n in _reference_of(scene)]
    return [_plain_job("mesh"), *jobs]


def sweep_jobs(scene, most=None):
    """The jobs of a scene's sweep.

    Parameters
    ----------
    scene : Scene
        With a sweep.
    most : int, optional
        Largest number of bundles; see `bundles`.

    Returns
    -------
    list of Job

    Raises
    ------
    SceneError, FormulaError, MeshError
        As `scene_of_point`, at the first point of its levels, elements, domain and solver.
    """
    shapes = {}
    made = bundles(scene.document["sweep"], most)
    jobs = [points_job(scene, points, shapes) for points in made]
    return [*jobs, _plain_job("sweep_table"), _plain_job("sweep_figure")]


def points_job(scene, points, shapes=None):
    """The job that solves points, in this order.

    Parameters
    ----------
    scene : Scene
        With a sweep.
    points : sequence of Point
    shapes : dict, optional
        Filled with what points of the same levels, elements, domain and solver share.

    Returns
    -------
    Job
    """
    shapes = {} if shapes is None else shapes
    solved, before, rows, found = [], None, 0, set()
    peak = 0
    seconds = STARTS["sweep_points"] + len(points) * _POINT_SECONDS
    for point in points:
        shape = _shape_of(scene, point, shapes)
        stated = _stated(point, shape.scene)
        found = found if stated == before else set()
        solved += [cost for key, cost in shape.costs.items() if key not in found]
        found, before = found | shape.costs.keys(), stated
        asked = len(shape.scene.elements) * len(shape.scene.levels)
        seconds += asked * _MEASURE_SECONDS.get(shape.scene.truth["kind"], 0)
        rows += asked
        peak = max(peak, shape.measuring)
    seconds += math.fsum(cost for cost, _ in solved)
    memory = _POINTS_MEMORY + max([peak, *(size for _, size in solved)])
    disk = len(points) * _POINT_BYTES + rows * _ROW_BYTES
    return Job("sweep_points", len(solved), seconds, memory, disk)


def level_cost(scene, element, n):
    """Seconds and bytes of one solve, by the route that the scene's solver takes.

    Parameters
    ----------
    scene : Scene
    element : {"P1", "CR"}
    n : int

    Returns
    -------
    seconds, bytes : float

    Examples
    --------
    Four times the triangles take more seconds and more memory:

    >>> from signorini import load_scene
    >>> scene = load_scene("config/scenes/l-shape.yaml")
    >>> coarse, fine = (level_cost(scene, "CR", n) for n in (64, 128))
    >>> coarse[0] < fine[0], coarse[1] < fine[1]
    (True, True)
    """
    statement, route = scene.problem_statement, scene.document["solver"]["method"]
    if route == "auto" and fourier_applies(statement, element, n):
        route = "fourier"
    grid = statement.domain["kind"] == "rectangle"
    return solve_cost(element, route, count_roughly(statement.domain, n), grid)


def _plain_job(rule):
    return Job(rule, 0, STARTS[rule], _MEMORY[rule], 0)


def _solve_job(scene, rule, element, n):
    seconds, memory = level_cost(scene, element, n)
    field = _FIELD_BYTES.get(element, max(_FIELD_BYTES.values()))
    disk = _SOLUTION_BYTES + field * count_roughly(scene.document["domain"], n)
    return Job(rule, 1, STARTS[rule] + seconds, memory, disk)


def _reference_of(scene):
    truth = scene.truth
    return [(truth["element"], truth["n"])] if truth["kind"] == "reference" else []


def _shape_of(scene, point, shapes):
    """The `_Shape` of a point, made once for all that have the same."""
    shaping = {key: value for key, value in point.values.items() if _shapes(key)}
    key = json.dumps(shaping, sort_keys=True)
    if key not in shapes:
        own = scene_of_point(scene, point)
        asked = [(element, n) for element in own.elements for n in own.levels]
        costs = {pair: level_cost(own, *pair) for pair in asked + _reference_of(own)}
        shapes[key] = _Shape(own, costs, _measuring(own))
    return shapes[key]


def _measuring(scene):
    """Bytes of measuring errors; certificates of points are no part of a sweep's forecast."""
    known = scene.truth["kind"] in ("reference", "exact")
    return errors_cost(scene)[1] if known else 0


def _shapes(key):
    return key in _SHAPING_KEYS or key.split(".")[0] in _SHAPING_SECTIONS


def _stated(point, scene):
    """What must be the same at the next point for it to share solutions; see `Solver`."""
    sections = {*STATED, "load_precision", "solver"} - {"levels"}
    sections -= set() if scene.truth["kind"] == "exact" else {"truth"}
    values = {key: value for key, value in point.values.items() if key.split(".")[0] in sections}
    return json.dumps([values, scene.levels[0]], sort_keys=True)
