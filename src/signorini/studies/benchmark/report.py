"""The page of the benchmark: the numbers and rows that fill ``page.md.j2``."""

from decimal import ROUND_CEILING

from signorini.errors.norms import PAPER_NORMS
from signorini.report.certificates import outward
from signorini.report.curves import stacked_shares
from signorini.report.document import render
from signorini.solvers.proof import INACCURATE, SOLVED
from signorini.studies.benchmark.accuracy import finest
from signorini.studies.benchmark.columns import COUNTS, SERIES, STAGES, TOLERANCE, series
from signorini.studies.benchmark.routes import ROUGH, in_full
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
        "difference": outward(_difference(curves), ROUND_CEILING, digits=1),
        "methods": list(dict.fromkeys(method for _, _, method in in_full(curves))),
        "accuracy": _accuracy(curves, summary["accuracy"]),
        "guaranteed": _guaranteed(summary["guaranteed"]),
        "loads": [row["load"] for row in points if row["load"] is not None],
        "counts": COUNTS,
        "titles": titles,
        "bias": summary["reference_bias"],
        "finest": _finest(curves, summary["growth"]),
        "comparisons": _comparisons(summary),
        "absent": {row["rival"]: row["note"] for row in rivals if row["status"] == "absent"},
    }
    shown |= _reach(curves, summary["reach"]) | _compared(shown["comparisons"])
    shown["answer"] = _answer(shown["reach"], summary)
    shown["times"] = _times(summary["growth"])
    return render(PAGE, layout, **shown, machine=machine, settings=settings)


def _difference(curves):
    """The largest of u, relative to max |u|, by any route in full."""
    return max(row["difference"] for rows in curves.values() for row in rows)


def _reach(curves, reached):
    """What each element spends to reach each error by its fastest route, and which spends less."""
    best, rows = fastest(reached), []
    elements = sorted({element for _, element, _ in curves}, reverse=True)  # P1 first
    for norm in PAPER_NORMS:
        for scene in dict.fromkeys(scene for scene, _, _ in curves):
            for target in TARGETS:
                spent = best.get((scene, norm, target), {})
                identity = {"norm": norm, "scene": scene, "target": target}
                rows.append(identity | {"spent": spent, "better": better(spent)})
    groups = (("", 2), *((name, 4) for name in elements), ("more accurate per", 3))
    return {"elements": elements, "reach": rows, "reach_groups": groups}


def _finest(curves, growth):
    """The finest point of each series, with the exponents of its time and memory."""
    exponents = {}
    for row in growth:
        key = tuple(row[name] for name in SERIES)
        exponents.setdefault(key, {})[row["quantity"]] = row["exponent"]
    return [
        rows[-1] | {"exponents": exponents.get(key, {}), "shares": _shares(rows[-1])}
        for key, rows in curves.items()
    ]


def _shares(row):
    """Percent of the time that each stage takes."""
    return {stage: 100.0 * share for stage, _, share in stacked_shares(row, STAGES)}


def _accuracy(curves, compared):
    """Multigrid as far as it pays: its finest levels, where it pays, and where it is not told."""
    rows = finest(compared)
    rough = [row for (_, _, route), rows in curves.items() if route == ROUGH for row in rows]
    return {
        "rows": rows,
        "pays": [row for row in rows if row["pays"] > 0],
        "does_not": [row for row in rows if row["pays"] < 0],
        "most": max(rows, key=lambda row: row["less"], default=None),
        "not_told": [row for row in rough if row["note"]],
        "levels": len(rough),
    }


def _guaranteed(rows):
    """What a guarantee costs: the ratios on either kind of meshes, and the sooner kind by scene."""
    by_scene = {}
    for row in rows:
        by_scene.setdefault(row["scene"], {})[row["element"], row["meshes"]] = row
    gains = {}
    for scene, runs in by_scene.items():
        uniform, adaptive = (runs["P1", meshes] for meshes in ("uniform", "adaptive"))
        gains[scene] = uniform | {"gain": uniform["guaranteed"] / adaptive["guaranteed"]}
    dearer = {
        meshes: [row["dearer"] for row in rows if row["meshes"] == meshes]
        for meshes in ("uniform", "adaptive")
    }
    return {
        "rows": rows,
        "dearer": dearer,
        "adaptive": {scene: row for scene, row in gains.items() if row["gain"] > 1.0},
        "uniform": {scene: row for scene, row in gains.items() if row["gain"] <= 1.0},
    }


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
    """What the page begins with: who is sooner, and ours against others."""
    firsts = [row["better"]["total"][0] or "even" for row in reached if "total" in row["better"]]
    counts = {key: sum(row[key] for row in summary["comparisons"]) for key in _OUTCOMES}
    found = {"errors": len(firsts), "sooner": {key: firsts.count(key) for key in _SOONER}}
    return found | counts | {"pairs": sum(counts.values())}


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
        Name -> rows: what each error costs by each route, what a coarser reference changes, the
        rivals against each route of ours, and multigrid as far as it pays against it in full.
    """
    verdicts = summary["verdicts"]
    compared = [row | verdicts[row["rival"]] for row in summary["comparisons"]]
    return {
        "reach": summary["reach"],
        "bias": summary["reference_bias"],
        "comparisons": compared,
        "accuracy": summary["accuracy"],
    }
