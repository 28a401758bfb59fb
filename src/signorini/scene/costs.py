"""What a solve costs, in seconds and bytes, said before it starts: a cluster asks for it.

The numbers in ``costs.json`` are fitted by ``benchmarks/fit_costs.py`` to the kept benchmark, one
thread of the machine that `docs/studies/benchmark/benchmark.md` names.
"""

import json
import math
from functools import cache
from pathlib import Path

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.scene.memory_check import count_roughly

# Unknowns for each triangle of a fine level: vertices, sides.
_DOFS = {"P1": 0.5, "CR": 1.5}
# A route that was not measured costs at most what this one does.
_MEASURED_AS = {"auto": "multigrid", "petsc": "direct"}
_MARGIN = 2  # of what is asked for over what is expected
_LEAST_MB, _LEAST_MINUTES = 500, 10
_UNCOUNTED_MB = 1000  # a mesh file, whose triangles nobody has counted


def solve_cost(element, route, triangles, grid):
    """What a solve takes.

    Parameters
    ----------
    element : str
        One that was not measured costs what the dearest of the others does.
    route : str
        Of `solver.method`; likewise.
    triangles : int or float
    grid : bool
        Whether the triangles are those of a rectangle.

    Returns
    -------
    seconds : float
        Without the start of a process and the mesh.
    bytes : float
        At the peak, with Python and its libraries.

    Examples
    --------
    >>> seconds, size = solve_cost("P1", "direct", 2 * 256**2, grid=True)
    >>> 0.2 < seconds < 0.8, 1e8 < size < 4e8
    (True, True)
    """
    measured = _MEASURED_AS.get(route, route)
    kind = "grid" if grid or measured == "fourier" else "mesh"
    fits = _fits(element, measured, kind)
    dofs = _DOFS.get(element, max(_DOFS.values())) * triangles
    seconds = max(cost_at(fit["seconds"], dofs) for fit in fits)
    size = max(cost_at(fit["bytes"], dofs) for fit in fits)
    known = "multigrid" if route == "auto" else route
    least = ELEMENT_FACTS[element].bytes_by(known) * triangles
    return seconds, max(size, least)


def asked_memory(statement, element, n, route, attempt=1):
    """Megabytes to ask a cluster for, for one solve; twice as many at each further attempt.

    Parameters
    ----------
    statement : ProblemStatement
    element : {"P1", "CR"}
    n : int
        The level, n = 1/h.
    route : str
        See `solve_cost`.
    attempt : int
        From 1.

    Returns
    -------
    int

    Examples
    --------
    >>> from signorini import load_scene
    >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
    >>> [asked_memory(statement, "CR", 64, "auto", attempt) for attempt in (1, 2)]
    [500, 1000]
    """
    _, size = _cost_of(statement, element, n, route)
    return megabytes_for(size, statement.domain, attempt)


def asked_minutes(statement, element, n, route, attempt=1):
    """Minutes to ask a cluster for; see `asked_memory`.

    Parameters
    ----------
    statement, element, n, route, attempt
        As there.

    Returns
    -------
    int

    Examples
    --------
    >>> from signorini import load_scene
    >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
    >>> asked_minutes(statement, "CR", 64, "auto")
    11
    """
    seconds, _ = _cost_of(statement, element, n, route)
    return minutes_for(seconds, attempt)


def megabytes_for(size, domain, attempt=1):
    """Megabytes to ask for, where so many bytes are expected.

    Parameters
    ----------
    size : float
    domain : dict
        Section of a scene: of a mesh file nobody has counted the triangles.
    attempt : int
        From 1.

    Returns
    -------
    int

    Examples
    --------
    >>> megabytes_for(6e8, {"kind": "rectangle"}), megabytes_for(6e8, {"kind": "rectangle"}, 2)
    (1200, 2400)
    """
    least = _UNCOUNTED_MB if domain.get("kind") == "mesh" else _LEAST_MB
    return max(least, 100 * math.ceil(_MARGIN * size / 1e8)) * 2 ** (attempt - 1)


def minutes_for(seconds, attempt=1):
    """Minutes to ask for, where so many seconds are expected.

    Parameters
    ----------
    seconds : float
    attempt : int
        From 1.

    Returns
    -------
    int

    Examples
    --------
    >>> minutes_for(100)
    14
    """
    return (_LEAST_MINUTES + math.ceil(_MARGIN * seconds / 60)) * 2 ** (attempt - 1)


def _cost_of(statement, element, n, route):
    grid = statement.domain.get("kind", "rectangle") == "rectangle"
    return solve_cost(element, route, count_roughly(statement.domain, n), grid)


def _fits(element, route, kind):
    """What was measured: of this very solve, or else of the element, or else of any element."""
    measured = _costs()
    this = f"{element}/{route}/{kind}"
    if this in measured:
        return [measured[this]]
    alike = [fit for key, fit in measured.items() if key.startswith(f"{element}/")]
    return alike or list(measured.values())


def cost_at(fit, count):
    """A fitted curve at a number of unknowns or triangles.

    Parameters
    ----------
    fit : (float, float, float)
        Start, factor and power.
    count : float

    Returns
    -------
    float

    Examples
    --------
    >>> cost_at((1.0, 2.0, 0.5), 9)
    7.0
    """
    start, factor, power = fit
    return start + factor * count**power


@cache
def _costs():
    return json.loads(Path(__file__).with_name("costs.json").read_text(encoding="utf-8"))
