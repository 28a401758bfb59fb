"""What a guaranteed error costs beside the true one: the rows of `guarantee`, summed up."""

import math

from signorini.studies.benchmark.columns import with_range

FACTS = ("element", "method", "triangles", "dofs", "upper", "lower", "error")
MEANT = ("solved", "guaranteed")
GUARANTEED = (
    *("scene", "meshes", "step", *FACTS),
    *(column for name in MEANT for column in with_range(name)),
)
"""A mesh and an element: the guaranteed bounds of its energy error, and that error where the
solution is known; seconds until it is `solved` and until it is `guaranteed`, medians, least and
largest. Those of an adaptive mesh are of all steps that led to it, those of a uniform one of it
alone. Either begins with the statement of the problem."""

_WORDS = ("scene", "meshes", "element", "method")
GUARANTEED_NUMBERS = tuple(name for name in GUARANTEED if name not in _WORDS)


def by_run(rows):
    """Scene -> (element, meshes) -> its rows, coarsest mesh first.

    Parameters
    ----------
    rows : sequence of dict
        With the columns `GUARANTEED`, and numbers.

    Returns
    -------
    dict

    Examples
    --------
    >>> rows = [{"scene": "l", "element": "CR", "meshes": "uniform", "n": n} for n in (4, 8)]
    >>> [row["n"] for row in by_run(rows)["l"]["CR", "uniform"]]
    [4, 8]
    """
    runs = {}
    for row in rows:
        of_scene = runs.setdefault(row["scene"], {})
        of_scene.setdefault((row["element"], row["meshes"]), []).append(row)
    return runs


def costs(rows):
    """What the smallest error that all runs of a scene guarantee costs, and what to have it costs.

    Parameters
    ----------
    rows : sequence of dict
        With the columns `GUARANTEED`, and numbers.

    Returns
    -------
    list of dict
        ``scene``, ``bound``, ``element``, ``meshes``; seconds until the error is ``guaranteed`` to
        be the bound; seconds ``least`` and ``most`` until it is, the same where the solution is
        known, and else by its own bounds; ``dearer``, the guaranteed one over the most.
    """
    found = []
    for scene, runs in by_run(rows).items():
        bound = max(min(row["upper"] for row in steps) for steps in runs.values())
        for (element, meshes), steps in runs.items():
            identity = {"scene": scene, "bound": bound, "element": element, "meshes": meshes}
            found.append(identity | _seconds(steps, bound))
    return found


def _seconds(steps, bound):
    known = steps[0]["error"] is not None
    least, most = ("error", "error") if known else ("lower", "upper")
    guaranteed = reached(steps, "upper", "guaranteed", bound)
    seconds = {
        "guaranteed": guaranteed,
        "least": reached(steps, least, "solved", bound),
        "most": reached(steps, most, "solved", bound),
    }
    return seconds | {"dearer": guaranteed / seconds["most"]}


def reached(steps, error, cost, target):
    """When a run's error is down to a target, interpolated between its meshes in logarithms.

    Parameters
    ----------
    steps : sequence of dict
        Coarsest first.
    error, cost : str
        Columns.
    target : float

    Returns
    -------
    float or None
        In the unit of the cost; None where the run does not get there.

    Examples
    --------
    >>> steps = [{"e": 1.0, "s": 1.0}, {"e": 0.25, "s": 4.0}]
    >>> reached(steps, "e", "s", 0.5), reached(steps, "e", "s", 0.1)
    (2.0, None)
    """
    before = None
    for step in steps:
        if step[error] <= target:
            return step[cost] if before is None else _between(before, step, error, cost, target)
        before = step
    return None


def _between(coarse, fine, error, cost, target):
    share = math.log(coarse[error] / target) / math.log(coarse[error] / fine[error])
    return coarse[cost] ** (1.0 - share) * fine[cost] ** share
