"""The page of the benchmark: the numbers and rows that fill ``page.md.j2``."""

from signorini.errors.norms import PAPER_NORMS
from signorini.report.document import render
from signorini.solvers.solution import INACCURATE, SOLVED
from signorini.studies.benchmark.columns import COUNTS, SERIES, TOLERANCE, series
from signorini.studies.benchmark.summary import TARGETS, better, fastest

PAGE = "studies/benchmark/page.md.j2"
_SOONER = ("P1", "CR", "even")
_OUTCOMES = ("wins", "even", "losses")


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
        "comparisons": _comparisons(summary),
        "absent": {row["rival"]: row["note"] for row in rivals if row["status"] == "absent"},
    }
    shown |= _reach(curves, summary["reach"]) | _compared(shown["comparisons"])
    shown["answer"] = _answer(shown["reach"], summary)
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


def _comparisons(summary):
    """Per rival and route of ours, in the order of the rivals' titles."""
    verdicts, titles = summary["verdicts"], summary["titles"]
    rows = [row | {"verdict": verdicts[row["rival"]]} for row in summary["comparisons"]]
    return sorted(rows, key=lambda row: titles[row["rival"]].lower())


def _compared(comparisons):
    """Rival -> route of ours -> row, and the routes."""
    by_rival = {}
    for row in comparisons:
        by_rival.setdefault(row["rival"], {})[row["ours"]] = row
    routes = list(dict.fromkeys(row["ours"] for row in comparisons))
    return {"compared": by_rival, "routes": routes}


def _answer(reached, summary):
    """What the page begins with: who is sooner, how time grows, ours against others."""
    firsts = [row["better"]["total"][0] or "even" for row in reached if "total" in row["better"]]
    counts = {key: sum(row[key] for row in summary["comparisons"]) for key in _OUTCOMES}
    found = {"errors": len(firsts), "sooner": {key: firsts.count(key) for key in _SOONER}}
    return found | counts | {"pairs": sum(counts.values()), "times": _times(summary["growth"])}


def _times(growth):
    """Route -> least and largest exponent of its time."""
    by_route = {}
    for row in growth:
        if row["quantity"] == "total":
            by_route.setdefault(row["method"], []).append(row["exponent"])
    return {method: (min(found), max(found)) for method, found in by_route.items()}


def tables(summary):
    """Tables too wide for the page, for files of their own.

    Returns
    -------
    dict
        Name -> rows: what each error costs by each route, what a coarser reference changes, and
        the rivals against each route of ours.
    """
    verdicts = summary["verdicts"]
    compared = [row | verdicts[row["rival"]] for row in summary["comparisons"]]
    return {
        "reach": summary["reach"],
        "bias": summary["reference_bias"],
        "comparisons": compared,
    }
