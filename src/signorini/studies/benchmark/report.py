"""The page of the benchmark: the numbers and tables that fill ``page.md.j2``."""

import pandas as pd

from signorini.report.document import Table, render
from signorini.report.quantities import factor, megabytes, seconds, thousands
from signorini.solvers.solution import INACCURATE, SOLVED
from signorini.studies.benchmark.columns import COUNTS, SERIES, TOLERANCE, series
from signorini.studies.benchmark.summary import NORMS, TARGETS, better, fastest

PAGE = "studies/benchmark/page.md.j2"
NAMES = {"l2": "L2", "h1": "H1"}


def page(layout, points, rivals, summary, machine, asked):
    """Put the page together.

    Parameters
    ----------
    layout : {"markdown", "latex"}
    points, rivals : sequence of dict
        Rows of benchmark.csv and rivals.csv, with numbers.
    summary : dict
        Of `summary.summary`, with the rivals' ``titles``.
    machine : dict
        Of `machine.describe`.
    asked : dict
        config/benchmark.yaml, and the level of each scene's own reference under ``truths``.

    Returns
    -------
    str
    """
    return render(PAGE, layout, **slots(points, rivals, summary), machine=machine, asked=asked)


def slots(points, rivals, summary):
    """What the template shows of the measurements; parameters as in `page`."""
    found, compared = series(points), pd.DataFrame(summary["comparisons"])
    absent = {row["rival"]: row["note"] for row in rivals if row["status"] == "absent"}
    titles, elements = summary["titles"], _elements(found)
    routes = list(compared["ours"].unique()) if len(compared) else []
    return {
        "judged": {"tolerance": TOLERANCE, "solved": SOLVED, "inaccurate": INACCURATE},
        "difference": max(row["difference"] for rows in found.values() for row in rows),
        "methods": list(dict.fromkeys(method for _, _, method in found)),
        "elements": elements,
        "absent": {titles.get(name, name): note for name, note in absent.items()},
        "won": compared[["wins", "even", "losses"]].sum() if len(compared) else None,
        "biases": _last_biases(summary["reference_bias"]),
        "reach": _reach_table(found, summary["reach"]),
        "bias": _bias_table(summary["reference_bias"]),
        "growth": _growth_table(found, summary["growth"]),
        "counts": _counts_table(found),
        "skipped": _skipped_table(points),
        "comparisons": _comparisons_table(summary),
        "ratios": {ours: _ratio_table(rivals, ours, titles) for ours in routes},
    }


def _elements(found):
    """The elements measured, P1 first."""
    return sorted({element for _, element, _ in found}, reverse=True)


def _last_biases(rows):
    """Scene -> what its own reference does to the errors of its last level."""
    found = {}
    for row in rows:
        last = max(other["n"] for other in rows if other["scene"] == row["scene"])
        if row["n"] == last:
            change = f"{row['element']} {NAMES[row['norm']]} {_percent(row['change'])}"
            found.setdefault(row["scene"], {"n": last, "changes": []})["changes"].append(change)
    return found


def _reach_table(found, reached):
    """Time, unknowns and memory to reach each error, by the fastest route of each element."""
    best, elements, rows = fastest(reached), _elements(found), []
    for norm in NORMS:
        rows.append([f"{NAMES[norm]} error"])
        for scene in dict.fromkeys(scene for scene, _, _ in found):
            for target in TARGETS:
                spent = best.get((scene, norm, target), {})
                costs = [cell for name in elements for cell in _cost_cells(spent.get(name))]
                verdict = better(spent)
                winners = [_winner(verdict.get(cost)) for cost in ("total", "dofs", "memory")]
                title = scene if target == TARGETS[0] else ""
                rows.append([title, f"{target:g}", *costs, *winners])
    each = ("time", "", "unknowns", "MB") * len(elements)
    groups = (("", 2), *((name, 4) for name in elements), ("more accurate per", 3))
    return Table(("scene", "error", *each, "second", "unknown", "byte"), rows, groups)


def _cost_cells(row):
    if row is None:
        return ["--", "", "--", "--"]
    sign = "≤" if row["status"] == "coarsest level" else ""
    memory = megabytes(row["memory"])
    memory = memory if memory.startswith("<") else sign + memory
    return [sign + seconds(row["total"]), row["method"][0], sign + thousands(row["dofs"]), memory]


def _winner(verdict):
    if verdict is None:
        return ""
    element, ratio = verdict
    return f"{element or 'even'} {factor(ratio)}"


def _bias_table(rows):
    """Errors by the scene's own reference and by the finer one."""
    cells = [
        (
            f"{row['scene']} {row['element']} {NAMES[row['norm']]}",
            f"1/{row['n']}",
            f"{row['coarse']:.8f}",
            f"{row['fine']:.8f}",
            _percent(row["change"]),
        )
        for row in rows
    ]
    return Table(("error", "h", "by the scene's reference", "by the finer one", "change"), cells)


def _percent(change):
    return f"{100 * change:+.2f} %"


def _growth_table(found, growth):
    """Exponents of time and memory, and time per unknown on the finest level."""
    exponents = {tuple(row[key] for key in (*SERIES, "quantity")): row for row in growth}
    rows = []
    for key, points in found.items():
        finest = points[-1]
        fits = [exponents.get((*key, quantity)) for quantity in ("total", "memory")]
        rows.append(
            (
                *_finest(key, points),
                thousands(finest["dofs"]),
                seconds(finest["total"]),
                megabytes(finest["memory"]),
                f"{finest['memory'] / finest['dofs']:.0f}",
                *(f"{fit['exponent']:.2f}" if fit else "--" for fit in fits),
            )
        )
    costs = ("unknowns", "time", "MB", "bytes per unknown")
    return Table(("series", "finest h", *costs, "exponent of time", "of memory"), rows)


def _counts_table(found):
    """What the routes did on the finest level of each series."""
    rows = [
        (*_finest(key, points), *(f"{points[-1][name]:g}" for name in COUNTS))
        for key, points in found.items()
    ]
    return Table(("series", "finest h", *COUNTS), rows)


def _finest(key, points):
    return " ".join(key), f"1/{points[-1]['n']:g}"


def _skipped_table(points):
    """The first level left out of each series, and why."""
    first = {}
    for row in points:
        if row["status"] != "measured":
            first.setdefault(tuple(row[key] for key in SERIES), row)
    rows = [(" ".join(key), f"1/{row['n']:g}", row["note"]) for key, row in first.items()]
    return Table(("series", "from h", "why"), rows, left=3)


def _comparisons_table(summary):
    """Per rival: what became of its problems, and its time over each of our routes."""
    titles, rows, before = summary["titles"], [], None
    fates = ("solved", "inaccurate", "failed", "wrong", "left out")
    order = sorted(summary["comparisons"], key=lambda row: titles.get(row["rival"]).lower())
    for row in order:
        verdict = summary["verdicts"][row["rival"]]
        name = [titles[row["rival"]], *(verdict[fate] for fate in fates)]
        if row["rival"] == before:
            name = [""] * 6
        span = f"{factor(row['ratio_min'])} to {factor(row['ratio_max'])}"
        won = row["wins"], row["even"], row["losses"]
        rows.append([*name, row["ours"], factor(row["ratio"]), span, *won])
        before = row["rival"]
    header = ("rival", *fates[:4], "left", "ours", "mean", "range", "w", "e", "l")
    return Table(header, rows, (("", 1), ("problems", 5), ("time of the rival / ours", 6)))


def _ratio_table(rivals, ours, titles):
    """The ratios to one of our routes, a row per problem, a column per rival."""
    rows = [row | {"text": _ratio(row)} for row in rivals if row["ours"] == ours]
    frame = pd.DataFrame(rows).set_index(["scene", "element", "n", "rival"])["text"]
    cells = frame.unstack(fill_value="", sort=False)
    lines = [(f"{key[0]} {key[1]}", f"1/{key[2]:g}", *line) for key, line in cells.T.items()]
    return Table(("problem", "h", *(titles.get(name, name) for name in cells)), lines)


def _ratio(row):
    if row["ratio"] is None:
        return ""
    text = f"{factor(row['ratio'])} ({factor(row['ratio_min'])} to {factor(row['ratio_max'])})"
    return f"{text} *failed*" if row["status"] == "failed" else text
