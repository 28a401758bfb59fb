"""A random walk over the space of scenes, each solution held against bounded least squares."""

import warnings

import numpy as np

from signorini.judge.dense import bounded_least_squares
from signorini.solvers.attempts import attempts


def walk(examples):
    """Solve so many random scenes; see `compare`.

    Parameters
    ----------
    examples : int

    Returns
    -------
    list of dict
        The rows of `compare` of all of them.
    """
    from hypothesis import HealthCheck, Phase, given, settings

    from signorini.generated.scenes import problems

    rows = []

    # Hypothesis draws by a seed made of the text of this function: editing it changes the scenes.
    @settings(
        max_examples=examples,
        derandomize=True,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(problems())
    def visit(problem):
        rows.extend(compare(problem))

    visit()
    return rows


def compare(problem):
    """Solve a problem by every route that applies, and by bounded least squares (BVLS).

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    list of dict
        Per route: ``element``, ``dofs``, ``contact``, ``method``, ``active``, ``condition`` of the
        stiffness matrix, ``difference`` of the two solutions relative to the larger of u and the
        minimum without contact, ``residual``, ``status``, and ``stored``, what rounding u to double
        precision does relative to its variation. A refusal counts as the status ``refused``.
    """
    u, condition, size = bounded_least_squares(problem)
    identity = {"element": problem.element, "dofs": problem.b.size, "contact": problem.contact.size}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return [
            identity | {"method": tried.method} | _compared(tried.solution, u, condition, size)
            for tried in attempts(problem)
        ]


def _compared(solution, u, condition, size):
    row = {"active": None, "condition": condition, "difference": None, "residual": None}
    if solution is None:
        return row | {"status": "refused", "stored": 0.0}
    row["active"] = int(solution.active.sum())
    row["difference"] = float(np.max(np.abs(solution.u - u))) / size
    row["residual"] = solution.residual
    row["status"] = solution.status
    relative = np.max(np.abs(solution.u)) / (np.ptp(solution.u) or np.inf)
    return row | {"stored": np.finfo(float).eps * float(relative)}
