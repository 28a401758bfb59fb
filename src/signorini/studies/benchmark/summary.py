"""What the measured points say: the cost of reaching an error, how costs grow, who is faster."""

import math
import statistics
from itertools import pairwise, product

import pandas as pd

from signorini.errors.norms import ALWAYS_NAMED, PAPER_NORMS
from signorini.errors.rates import slopes
from signorini.studies.benchmark.accuracy import as_far_as_it_pays
from signorini.studies.benchmark.columns import SERIES, series
from signorini.studies.benchmark.routes import ROUGH

TARGETS = (1e-1, 1e-2, 1e-3, 1e-4)
COSTS = ("total", "total_min", "total_max", "dofs", "memory")
STATUSES = ("solved", "inaccurate", "failed", "left out", "absent")
_PAGE = 4096  # bytes: memory is measured in pages, and a coarse level may need none that is new
_ROUND_OFF = 1e5  # bytes: less is round-off of the allocator
_FITTED = 4  # finest levels that an exponent is fitted to


def with_errors(points, errors, rough):
    """Add the errors of their scene, element and level to the rows of the points.

    Parameters
    ----------
    points : list of dict
    errors, rough : dict
        Scene -> rows of its errors.csv: of solutions in full, which the routes of an element share,
        and of those to discretisation accuracy. The column `difference` of a point says how far its
        solution is from the one that the errors are of.

    Returns
    -------
    list of dict
        The norms are None where there are no errors.
    """
    in_full, not_in_full = _by_level(errors), _by_level(rough)
    rows = []
    for row in points:
        its_own = not_in_full if row["method"] == ROUGH else in_full
        known = its_own.get((row["scene"], *_level(row)), {})
        rows.append(row | {norm: known.get(norm) for norm in ALWAYS_NAMED})
    return rows


def _by_level(errors):
    """(scene, element, n) -> its row."""
    return {(scene, *_level(row)): row for scene, rows in errors.items() for row in rows}


def _level(row):
    return row["element"], int(row["n"])


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
        is not reached) and ``status``: "between levels", "coarsest level", which is better than the
        target already, or "not reached".
    """
    rows = []
    for key, levels in series(points).items():
        for norm, target in product(PAPER_NORMS, targets):
            identity = dict(zip(SERIES, key, strict=True)) | {"norm": norm, "target": target}
            status, costs = _cost([row for row in levels if row[norm]], norm, target)
            rows.append(identity | costs | {"status": status})
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
    return max(row[cost], _PAGE if cost == "memory" else 0.0)


def fastest(reached):
    """(scene, norm, target) -> element -> its row of least time, of all routes that reach it.

    Only routes in full count, whose solutions have a proof.
    """
    frame = pd.DataFrame([row for row in reached if row["method"] != ROUGH])
    frame = frame.dropna(subset="total").sort_values("total", kind="stable")
    frame = frame.drop_duplicates(["scene", "norm", "target", "element"]).sort_index()
    best = {}
    for row in frame.to_dict("records"):
        best.setdefault((row["scene"], row["norm"], row["target"]), {})[row["element"]] = row
    return best


def better(rows):
    """Which of two elements gets an error for less, per cost.

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

    Examples
    --------
    >>> row = {"status": "between levels", "dofs": 100.0, "memory": 1e6}
    >>> fast = row | {"total": 1.0, "total_min": 0.9, "total_max": 1.1}
    >>> slow = row | {"total": 3.0, "total_min": 2.9, "total_max": 3.1}
    >>> better({"P1": slow, "CR": fast})["total"]
    ('CR', 3.0)
    """
    if [row["status"] for row in rows.values()] != ["between levels"] * 2:
        return {}
    (one, a), (other, b) = rows.items()
    cheaper = {}
    for cost in ("total", "dofs", "memory"):
        x, y = _at_least(a, cost), _at_least(b, cost)
        cheaper[cost] = (one if x < y else other, max(x, y) / min(x, y))
    if min(a["memory"], b["memory"]) < _ROUND_OFF:
        del cheaper["memory"]
    if a["total_min"] <= b["total_max"] and b["total_min"] <= a["total_max"]:
        cheaper["total"] = (None, cheaper["total"][1])
    return cheaper


def growth(points):
    """Exponents of time and memory against unknowns, least squares over the finest levels.

    Returns
    -------
    list of dict
        ``scene``, ``element``, ``method``, ``quantity`` ("total" or "memory"), ``exponent``, and
        the levels it was fitted to, ``first`` to ``last``. Series of fewer than three levels have
        none.

    Examples
    --------
    >>> key = {"scene": "paper", "element": "P1", "method": "direct", "status": "measured"}
    >>> costs = [{"n": n, "dofs": n**2, "total": n**2 * 1e-6, "memory": n**3} for n in (8, 16, 32)]
    >>> points = [key | row for row in costs]
    >>> [(row["quantity"], round(row["exponent"], 6)) for row in growth(points)]
    [('total', 1.0), ('memory', 1.5)]
    """
    rows = []
    for key, levels_of_series in series(points).items():
        finest = levels_of_series[-_FITTED:]
        for quantity in ("total", "memory"):
            values = [row[quantity] for row in finest]
            if len(finest) < 3 or min(values) <= 0:
                continue
            exponent = slopes([row["dofs"] for row in finest], values)["fit"]
            identity = dict(zip(SERIES, key, strict=True)) | {"quantity": quantity}
            levels = {"first": int(finest[0]["n"]), "last": int(finest[-1]["n"])}
            rows.append(identity | {"exponent": exponent} | levels)
    return rows


def reference_bias(coarse, fine):
    """How a coarser reference changes errors, relative to those by a finer one.

    Parameters
    ----------
    coarse, fine : dict
        Scene -> rows of its errors.csv.

    Returns
    -------
    list of dict
        ``scene``, ``element``, ``n``, ``norm``, the errors ``coarse`` and ``fine``, ``change``.

    Examples
    --------
    >>> rows = [{"element": "P1", "n": 2, "l2": 0.1, "h1": None}]
    >>> finer = [{"element": "P1", "n": 2, "l2": 0.125, "h1": None}]
    >>> round(reference_bias({"paper": rows}, {"paper": finer})[0]["change"], 12)
    -0.2
    """
    if not coarse:
        return []
    frame = _errors(coarse).to_frame("coarse").join(_errors(fine).rename("fine"), how="inner")
    frame["change"] = frame["coarse"] / frame["fine"] - 1.0
    return frame[frame["coarse"] != 0.0].reset_index().to_dict("records")


def _errors(errors):
    """The errors that there are, by scene, element, n and norm."""
    frame = pd.DataFrame([{"scene": name, **row} for name, rows in errors.items() for row in rows])
    frame = frame.astype({"n": int}).set_index(["scene", "element", "n"])
    return frame[list(PAPER_NORMS)].rename_axis(columns="norm").stack().dropna().astype(float)


def comparisons(rivals):
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

    Examples
    --------
    >>> rival = {"rival": "bvls", "ours": "direct", "status": "solved"}
    >>> comparisons([rival | {"ratio": 2.0, "ratio_min": 1.5, "ratio_max": 2.5}])[0]["losses"]
    1
    """
    frame = pd.DataFrame(rivals)
    frame = frame[frame["ratio"].notna() & (frame["status"] != "failed")]
    frame = frame.assign(win=frame["ratio_max"] < 1.0, loss=frame["ratio_min"] > 1.0)
    by_route = frame.groupby(["rival", "ours"], sort=False).agg(
        problems=("ratio", "size"),
        wins=("win", "sum"),
        losses=("loss", "sum"),
        ratio=("ratio", lambda ratios: math.exp(statistics.fmean(map(math.log, ratios)))),
        ratio_min=("ratio_min", "min"),
        ratio_max=("ratio_max", "max"),
    )
    by_route["even"] = by_route["problems"] - by_route["wins"] - by_route["losses"]
    return by_route.reset_index().to_dict("records")


def verdicts(rivals):
    """Rival -> counts of its problems by status, and ``wrong``.

    ``wrong`` are those it claims to have solved although the residual says "failed"; they are among
    the failed.

    Examples
    --------
    >>> row = {"rival": "bvls", "scene": "paper", "element": "P1", "n": 4, "status": "failed"}
    >>> verdicts([row | {"claimed": 1}])["bvls"]["wrong"]
    1
    """
    frame = pd.DataFrame(rivals)
    frame = frame.drop_duplicates(["rival", "scene", "element", "n"], keep="last")
    counts = pd.crosstab(frame["rival"], frame["status"]).reindex(columns=STATUSES, fill_value=0)
    wrong = (frame["status"] == "failed") & (frame["claimed"] == 1)
    counts["wrong"] = wrong.groupby(frame["rival"]).sum()
    return counts.to_dict("index")


def summary(points, rivals, coarse, errors):
    """All of the above, for a file: a dict of lists and dicts.

    Parameters
    ----------
    points, rivals : list of dict
        Rows of benchmark.csv and rivals.csv, with numbers.
    coarse, errors : dict
        Scene -> rows of its errors.csv: by its own reference, and by the benchmark's.

    Returns
    -------
    dict
    """
    return {
        "reach": reach(points),
        "growth": growth(points),
        "accuracy": as_far_as_it_pays(points),
        "reference_bias": reference_bias(coarse, errors),
        "comparisons": comparisons(rivals),
        "verdicts": verdicts(rivals),
    }
