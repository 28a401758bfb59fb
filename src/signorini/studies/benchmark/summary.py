"""What the measured points say: the cost of reaching an error, how costs grow, who is faster."""

import math
import statistics
from itertools import pairwise

from signorini.errors.rates import slopes
from signorini.studies.benchmark.columns import ERRORS

NORMS = ("l2", "h1")
TARGETS = (1e-1, 1e-2, 1e-3, 1e-4)
COSTS = ("total", "total_min", "total_max", "dofs", "memory")
_FLOOR = {
    "memory": 4096
}  # bytes: it is measured in pages, and a coarse level may need none that are new
_TOLD = 1e5  # bytes: less is round-off of the allocator
_FITTED = 4  # finest levels that an exponent is fitted to


def with_errors(points, errors):
    """The rows of the points with the errors of their scene, element and level; None where there
    are none.

    `errors` maps each scene to the rows of its errors.csv. All routes of an element share them: the
    column `difference` of a point says how far its solution is from the one that they were computed
    of.
    """
    found = {
        (scene, row["element"], int(row["n"])): row
        for scene, rows in errors.items()
        for row in rows
    }
    none = dict.fromkeys(ERRORS)
    keyed = [
        (row, found.get((row["scene"], row["element"], int(row["n"])), none)) for row in points
    ]
    return [row | {norm: known[norm] for norm in ERRORS} for row, known in keyed]


def series(points):
    """(scene, element, method) -> its measured points, coarsest first."""
    found = {}
    for row in points:
        if row["status"] == "measured":
            found.setdefault((row["scene"], row["element"], row["method"]), []).append(row)
    return {key: sorted(rows, key=lambda row: int(row["n"])) for key, rows in found.items()}


def reach(points, targets=TARGETS):
    """What each scene, element and route spends to reach each error, interpolated between levels.

    Parameters
    ----------
    points : sequence of dict
        Of `with_errors`, with numbers.
    targets : sequence of float

    Returns
    -------
    list of dict
        ``scene``, ``element``, ``method``, ``norm``, ``target``, the `COSTS` (None where the error
        is not reached) and
        ``status``: "between levels", "coarsest level", which is better than the target already, or
        "not reached".
    """
    rows = []
    for (scene, element, method), found in series(points).items():
        for norm in NORMS:
            shown = [row for row in found if row[norm]]
            for target in targets:
                status, costs = _cost(shown, norm, target)
                what = {
                    "scene": scene,
                    "element": element,
                    "method": method,
                    "norm": norm,
                    "target": target,
                }
                rows.append(what | costs | {"status": status})
    return rows


def _cost(rows, norm, target):
    if rows and rows[0][norm] <= target:
        return "coarsest level", {cost: rows[0][cost] for cost in COSTS}
    for coarse, fine in pairwise(rows):
        if fine[norm] <= target:
            share = math.log(coarse[norm] / target) / math.log(coarse[norm] / fine[norm])
            return "between levels", {cost: _between(coarse, fine, cost, share) for cost in COSTS}
    return "not reached", dict.fromkeys(COSTS)


def _between(coarse, fine, cost, share):
    """The cost at a share of the way from one level to the next, on a logarithmic scale."""
    return _at_least(coarse, cost) ** (1.0 - share) * _at_least(fine, cost) ** share


def _at_least(row, cost):
    return max(row[cost], _FLOOR.get(cost, 0.0))


def fastest(reached):
    """(scene, norm, target) -> element -> its row of least time, of all routes; no entry where it
    is not reached.
    """
    best = {}
    for row in reached:
        if row["total"] is not None:
            elements = best.setdefault((row["scene"], row["norm"], row["target"]), {})
            if row["element"] not in elements or row["total"] < elements[row["element"]]["total"]:
                elements[row["element"]] = row
    return best


def better(rows):
    """Which of two elements gets an error for less, per cost: ``(element or None, factor)``.

    Parameters
    ----------
    rows : dict
        Element -> row of `reach`.

    Returns
    -------
    dict
        Cost -> (element, how many times more the other one pays). For ``total`` the element is None
        where the ranges of the measured times overlap; ``memory`` is absent below what can be told.
        Empty unless there are two, both between levels.
    """
    if [row["status"] for row in rows.values()] != ["between levels"] * 2:
        return {}
    (one, a), (other, b) = rows.items()
    found = {}
    for cost in ("total", "dofs", "memory"):
        x, y = _at_least(a, cost), _at_least(b, cost)
        found[cost] = (one if x < y else other, max(x, y) / min(x, y))
    if min(a["memory"], b["memory"]) < _TOLD:
        del found["memory"]
    if a["total_min"] <= b["total_max"] and b["total_min"] <= a["total_max"]:
        found["total"] = (None, found["total"][1])
    return found


def growth(points):
    """Exponents of time and memory against unknowns, least squares over the finest levels.

    Returns
    -------
    list of dict
        ``scene``, ``element``, ``method``, ``quantity`` ("total" or "memory"), ``exponent``, and
        the levels it was fitted to, ``first`` to ``last``. Series of fewer than three levels have
        none.
    """
    rows = []
    for (scene, element, method), found in series(points).items():
        finest = found[-_FITTED:]
        for quantity in ("total", "memory"):
            if len(finest) < 3 or not all(row[quantity] > 0 for row in finest):
                continue
            exponent = slopes([row["dofs"] for row in finest], [row[quantity] for row in finest])[
                "fit"
            ]
            levels = {"first": int(finest[0]["n"]), "last": int(finest[-1]["n"])}
            what = {"scene": scene, "element": element, "method": method, "quantity": quantity}
            rows.append(what | {"exponent": exponent} | levels)
    return rows


def bending(coarse, fine):
    """What a coarser reference does to errors: rows of the changes that it makes, relative to those
    by the finer one.

    Both map a scene to the rows of an errors.csv.
    """
    rows = []
    for scene, found in coarse.items():
        true = {(row["element"], int(row["n"])): row for row in fine[scene]}
        for row in found:
            key = (row["element"], int(row["n"]))
            for norm in (norm for norm in NORMS if key in true and row[norm]):
                by_fine = true[key][norm]
                what = {"scene": scene, "element": key[0], "n": key[1], "norm": norm}
                rows.append(
                    what
                    | {"coarse": row[norm], "fine": by_fine, "change": row[norm] / by_fine - 1.0}
                )
    return rows


def duels(rivals):
    """Sum up the rivals: per rival and route of ours, over all problems both solved.

    Parameters
    ----------
    rivals : sequence of dict
        Rows of rivals.csv, with numbers.

    Returns
    -------
    list of dict
        ``rival``, ``ours``, ``problems``, the rival's ``wins``, ``even`` (the ratios' range holds
        1) and ``losses``, and ``ratio``, ``ratio_min``, ``ratio_max``: geometric mean, least and
        largest of its time over ours.
    """
    pairs = {}
    for row in rivals:
        if row["ratio"] is not None and row["status"] != "failed":
            pairs.setdefault((row["rival"], row["ours"]), []).append(row)
    return [_duel(*key, rows) for key, rows in pairs.items()]


def _duel(rival, ours, rows):
    wins = sum(row["ratio_max"] < 1.0 for row in rows)
    losses = sum(row["ratio_min"] > 1.0 for row in rows)
    return {
        "rival": rival,
        "ours": ours,
        "problems": len(rows),
        "wins": wins,
        "even": len(rows) - wins - losses,
        "losses": losses,
        "ratio": math.exp(statistics.fmean(math.log(row["ratio"]) for row in rows)),
        "ratio_min": min(row["ratio_min"] for row in rows),
        "ratio_max": max(row["ratio_max"] for row in rows),
    }


def verdicts(rivals):
    """Rival -> counts of its problems: ``solved``, ``inaccurate``, ``failed``, ``left out``,
    ``absent``, and ``wrong``.

    ``wrong`` are those it claims to have solved although the residual says "failed"; they are among
    the failed.
    """
    names = ("solved", "inaccurate", "failed", "left out", "absent")
    found = {}
    for row in {
        (row["rival"], row["scene"], row["element"], row["n"]): row for row in rivals
    }.values():
        counts = found.setdefault(row["rival"], dict.fromkeys((*names, "wrong"), 0))
        counts[row["status"]] += 1
        counts["wrong"] += row["status"] == "failed" and row["claimed"] == 1
    return found


def summary(points, rivals, coarse, errors):
    """All of the above, for a file: a dict of lists and dicts."""
    return {
        "reach": reach(points),
        "growth": growth(points),
        "bending": bending(coarse, errors),
        "duels": duels(rivals),
        "verdicts": verdicts(rivals),
    }
