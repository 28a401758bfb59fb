"""The page of the benchmark: the numbers and rows that fill ``page.md.j2``."""

from signorini.errors.norms import PAPER_NORMS
from signorini.report.document import render
from signorini.solvers.solution import INACCURATE, SOLVED
from signorini.studies.benchmark.columns import COUNTS, SERIES, TOLERANCE, series
from signorini.studies.benchmark.summary import TARGETS, better, fastest

PAGE = "studies/benchmark/page.md.j2"


def page(layout, points, rivals, summary, machine, settings):
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
    settings : dict
        config/benchmark.yaml, and the level of each scene's own reference under ``truths``.

    Returns
    -------
    str
    """
    curves, titles = series(points), summary["titles"]
    shown = {
        "judged": {"tolerance": TOLERANCE, "solved": SOLVED, "inaccurate": INACCURATE},
        "difference": max(row["difference"] for rows in curves.values() for row in rows),
        "methods": list(dict.fromkeys(method for _, _, method in curves)),
        "counts": COUNTS,
        "titles": titles,
        "bias": summary["reference_bias"],
        "finest": _finest(curves, summary["growth"]),
        "skipped": _skipped(points),
        "comparisons": _comparisons(summary),
        "absent": {row["rival"]: row["note"] for row in rivals if row["status"] == "absent"},
        "ratios": _ratios(rivals),
    }
    shown |= _reach(curves, summary["reach"])
    return render(PAGE, layout, **shown, machine=machine, settings=settings)


def _reach(curves, reached):
    """What each element spends to reach each error by its fastest route, and which spends less."""
    best, rows = fastest(reached), []
    elements = sorted({element for _, element, _ in curves}, reverse=True)  # P1 first
    for norm in PAPER_NORMS:
        for scene in dict.fromkeys(scene for scene, _, _ in curves):
            for target in TARGETS:
                spent = best.get((scene, norm, target), {})
                what = {"norm": norm, "scene": scene, "target": target}
                rows.append(what | {"spent": spent, "better": better(spent)})
    groups = (("", 2), *((name, 4) for name in elements), ("more accurate per", 3))
    return {"elements": elements, "reach": rows, "reach_groups": groups}


def _finest(curves, growth):
    """The finest point of each series, with the exponents of its time and memory."""
    exponents = {}
    for row in growth:
        key = tuple(row[name] for name in SERIES)
        exponents.setdefault(key, {})[row["quantity"]] = row["exponent"]
    return [rows[-1] | {"exponents": exponents.get(key, {})} for key, rows in curves.items()]


def _skipped(points):
    """The first point left out of each series."""
    first = {}
    for row in points:
        if row["status"] != "measured":
            first.setdefault(tuple(row[name] for name in SERIES), row)
    return list(first.values())


def _comparisons(summary):
    """Per rival and route of ours, in the order of the rivals' titles."""
    verdicts, titles = summary["verdicts"], summary["titles"]
    rows = [row | {"verdict": verdicts[row["rival"]]} for row in summary["comparisons"]]
    return sorted(rows, key=lambda row: titles[row["rival"]].lower())


def _ratios(rivals):
    """Route of ours -> problem -> rival -> row."""
    by_route = {}
    for row in rivals:
        if row["ratio"] is not None:
            problems = by_route.setdefault(row["ours"], {})
            problem = row["scene"], row["element"], row["n"]
            problems.setdefault(problem, {})[row["rival"]] = row
    return by_route
