"""What the jobs `errors` and `certificate` cost, in seconds and bytes, said before they start.

The numbers in ``job_costs.json`` are fitted by ``benchmarks/fit_costs.py`` to
``benchmarks/jobs.csv``, which ``benchmarks/measure_jobs.py`` measures.
"""

import json
from functools import cache
from pathlib import Path

from signorini.scene.costs import cost_at
from signorini.scene.memory_check import count_roughly


def job_cost(job, triangles, grid):
    """What a job takes.

    Parameters
    ----------
    job : {"errors/reference", "errors/exact", "certificate"}
    triangles : int or float
        Of the reference, of the finest level, or of the level that is certified.
    grid : bool
        Whether the triangles are those of a rectangle.

    Returns
    -------
    seconds : float
        Of processor time, with the start of the process.
    bytes : float
        At the peak, with Python and its libraries.

    Examples
    --------
    >>> seconds, size = job_cost("errors/reference", 2 * 512**2, grid=True)
    >>> 0.2 < seconds < 0.8, 5e7 < size < 2e8
    (True, True)
    """
    measured = _costs()
    own = measured.get(f"{job}/{'grid' if grid else 'mesh'}")
    # Where only grids were measured, a mesh costs what the dearest does, and the other way round.
    fits = [own] if own else [fit for key, fit in measured.items() if key.startswith(job)]
    seconds, size = (max(cost_at(fit[key], triangles) for fit in fits) for key in _MEASURED)
    return seconds, size


_MEASURED = ("seconds", "bytes")


def errors_cost(scene, n=None):
    """What the errors of a scene's solutions take.

    Parameters
    ----------
    scene : Scene
    n : int, optional
        The level of the reference or, where the solution is known, the finest of all; as the scene
        says, if not given.

    Returns
    -------
    seconds, bytes : float
    """
    truth = scene.truth
    if truth["kind"] == "reference":
        return _cost(scene, "errors/reference", n or truth["n"])
    return _cost(scene, "errors/exact", n or max(scene.levels))


def certificate_cost(scene, n):
    """What the certificate of a level takes.

    Parameters
    ----------
    scene : Scene
    n : int

    Returns
    -------
    seconds, bytes : float
    """
    return _cost(scene, "certificate", n)


def _cost(scene, job, n):
    domain = scene.problem_statement.domain
    return job_cost(job, count_roughly(domain, n), domain["kind"] == "rectangle")


@cache
def _costs():
    return json.loads(Path(__file__).with_name("job_costs.json").read_text(encoding="utf-8"))
