"""Rows of a small benchmark, for the tests of its page and of its figures."""

from signorini.studies.benchmark.columns import COUNTS, STAGES, TIMES
from signorini.studies.benchmark.guarantee_costs import costs
from signorini.studies.benchmark.routes import ROUGH
from signorini.studies.benchmark.summary import summary

FIGURES = ("error", "guaranteed", "dofs", "growth", "rivals")
ASKED = {
    "scenes": {"paper": {"finest": 16, "reference": 128}, "corner": {"finest": 16}},
    "limits": {"seconds": 3, "megabytes": 400},
    "repeats": {"least": 3, "most": 9, "seconds": 1},
    "rivals": {"levels": [8, 16], "seconds": 2},
    "truths": {"paper": 32},
    "guaranteed": {"scenes": {"corner": {"finest": 16, "max_dofs": 100}}, "repeats": 2},
}
MACHINE = {
    "processor": "Some_Chip 100%", "cores": 2, "memory": 8.0, "system": "Linux", "python": "3.11",
    "blas": "blas 1", "threads": 1, "load": 0.25, "date": "2026-01-01 00:00 UTC",
    "versions": {"numpy": "2.4.6"},
}  # fmt: skip


def point(scene, element, method, n):
    slow = {"fourier": 1e-6, "direct": 1e-5, "multigrid": 4e-5, ROUGH: 2e-6}[method] * {
        "P1": 1.0,
        "CR": 3.0,
    }[element]
    dofs = n * n * {"P1": 1, "CR": 3}[element]
    row = {
        "scene": scene,
        "element": element,
        "method": method,
        "status": "measured",
        "note": "",
        "n": n,
        "h": 1 / n,
    }
    row |= {name: slow * n**2 / (3 if name in STAGES else 1) for name in TIMES}
    row |= {f"{name}_min": 0.9 * row[name] for name in TIMES} | {
        f"{name}_max": 1.1 * row[name] for name in TIMES
    }
    row |= {"dofs": dofs, "memory": 1e3 * dofs, "peak": 1e8, "difference": 1e-13, "iterations": 4}
    row |= {"load": 1.0}
    return row | dict.fromkeys(COUNTS, 2) | {"l2": 1 / n**2, "h1_semi": 1 / n, "h1": 1 / n}


def rival(name, n, ratio, status="solved", ours="fourier"):
    row = {
        "scene": "paper",
        "element": "P1",
        "n": n,
        "rival": name,
        "status": status,
        "note": "",
        "claimed": 1,
    }
    row |= {"ours": ours, "auto": 1}
    return row | {
        "ratio": ratio,
        "ratio_min": ratio and 0.9 * ratio,
        "ratio_max": ratio and 1.1 * ratio,
    }


POINTS = [
    point(scene, element, method, n)
    for scene in ("paper", "corner")
    for element in ("P1", "CR")
    for method in ("fourier", "direct")
    for n in (2, 4, 8, 16)
]
POINTS += [
    point("paper", element, method, n)
    | {"note": "cannot be told" if n == 2 and method == ROUGH else ""}
    for element in ("P1", "CR")
    for method in ("multigrid", ROUGH)
    for n in (2, 4)
]
POINTS[31] |= {"status": "skipped", "note": "about 9 s foreseen"}
RIVALS = [rival("fast", 8, 0.5), rival("slow", 8, 20.0), rival("slow", 16, 40.0, "failed")]
RIVALS += [rival("gone", None, None, "absent", "") | {"note": "pip install gone"}]
ERRORS = {"paper": [{"element": "P1", "n": n, "l2": 1 / n**2, "h1": 1 / n} for n in (2, 4)]}
COARSE = {"paper": [{"element": "P1", "n": n, "l2": 1.01 / n**2, "h1": 1 / n} for n in (2, 4)]}
GUARANTEED = [
    {
        "scene": "corner", "element": element, "meshes": meshes, "step": k, "dofs": 4**k,
        "upper": 1.1 * 0.5**k, "lower": 0.9 * 0.5**k, "error": 0.5**k, "solved": slow * 4.0**k,
        "guaranteed": 2.0 * slow * 4.0**k,
    }
    for element in ("P1", "CR")
    for meshes, slow in (("uniform", 1e-3), ("adaptive", 4e-3))
    for k in (1, 2, 3)
]  # fmt: skip
SUMMARY = summary(POINTS, RIVALS, COARSE, ERRORS) | {
    "guaranteed": costs(GUARANTEED),
    "titles": {"fast": "Fast", "slow": "Slow & sure", "gone": "Gone"},
}
