"""What a solve does, in counts and bytes: no busy machine can hide slower code from them."""

import tracemalloc
from dataclasses import asdict

from signorini.exceptions import SolverError
from signorini.fem.problem import discretize
from signorini.solvers import METHODS, solve
from signorini.studies.benchmark.columns import COUNTS
from signorini.work import counting

GUARDED = (*COUNTS, "bytes_per_unknown")
ALLOWED = 0.1  # growth

_UNKNOWNS = 10_000


def _counted_level(scene, element):
    """The first level, by doubling the coarsest, with at least so many free unknowns."""
    n = scene.levels[0]
    while True:
        problem = discretize(scene, element, n)
        if problem.free.size >= _UNKNOWNS:
            return n, problem
        n *= 2


def count_scene(scene, element):
    """Count what each route that applies does.

    Parameters
    ----------
    scene : Scene
    element : {"P1", "CR"}

    Returns
    -------
    list of dict
        A row per route: ``method``, ``n``, ``unknowns``, the counts, and ``bytes_per_unknown``: the
        peak of what Python's allocators gave out during the solve, assembly included where a route
        needs the matrix. What SuperLU allocates by itself is not among them.
    """
    import pyamg  # noqa: F401 (its modules are no memory of a solve; a coarse one may not load it)

    n, problem = _counted_level(scene, element)
    coarse = discretize(scene, element, scene.levels[0])
    rows = []
    for method in METHODS:
        try:
            solve(coarse, method)  # imports
        except SolverError:
            continue
        problem.__dict__.pop("A", None)
        what = {"scene": scene.name, "element": element, "method": method}
        what |= {"n": n, "unknowns": problem.free.size}
        rows.append(what | _count(problem, method))
    return rows


def _count(problem, method):
    tracemalloc.start()
    try:
        with counting() as work:
            solve(problem, method)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    return asdict(work) | {"bytes_per_unknown": round(peak / problem.free.size)}


def changes(recorded, found):
    """Compare counts with recorded ones.

    Parameters
    ----------
    recorded, found : list of dict
        Rows of `count_scene`.

    Returns
    -------
    grown, shrunk : list of str
        Counts that are more than a tenth larger, or smaller, with both values; routes that are new
        or gone are among the grown.
    """
    before, after = ({_key(row): row for row in rows} for rows in (recorded, found))
    grown = [f"{key}: not in the record" for key in after.keys() - before.keys()]
    gone = before.keys() - after.keys()
    grown += [f"{key}: recorded, but the route no longer applies" for key in gone]
    shrunk = []
    for key in before.keys() & after.keys():
        for name in GUARDED:
            old, new = float(before[key][name]), float(after[key][name])
            line = f"{key}: {name} {old:g} -> {new:g}"
            if new > (1.0 + ALLOWED) * old:
                grown.append(line)
            elif new < (1.0 - ALLOWED) * old:
                shrunk.append(line)
    return sorted(grown), sorted(shrunk)


def _key(row):
    return f"{row['scene']} {row['element']} {row['method']}"
