"""The blocks of docs/applications.md and docs/many-papers.md, from the results of their scenes."""

import csv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "results"
APPLICATIONS = ROOT / "docs/applications.md"
MANY_PAPERS = ROOT / "docs/many-papers.md"

PRACTICE = ("electropaint", "seepage", "membrane")
PUBLISHED = (
    "hansbo-larson",
    "hansbo-larson-corner",
    "cascavita-chouly-ern",
    "ceiling",
    "thin-obstacle",
    "annulus",
)
COUNTED = ("ceiling", "thin-obstacle")
SHOWN = ("l2", "h1_semi", "trace_l2", "multiplier_l2")
# Picture in docs/pictures -> the figure of a scene that it is a copy of.
PICTURES = {f"{name}.png": RESULTS / name / "figures/contact_line.png" for name in PRACTICE}


def blocks():
    """Page -> its generated blocks by name."""
    return {
        APPLICATIONS: {f"outputs of {name}": outputs(name) for name in PRACTICE},
        MANY_PAPERS: {"rates": rates(), "steps": steps()},
    }


def outputs(name):
    """The quantities of a scene by element and level, as Markdown."""
    rows = _rows(name, "outputs.csv")
    names = list(dict.fromkeys(row["name"] for row in rows))
    units = {row["name"]: row["unit"] for row in rows}
    headings = [f"{key.replace('_', ' ')} {_in_unit(units[key])}".strip() for key in names]
    values = {}
    for row in rows:
        values.setdefault((row["element"], row["n"]), {})[row["name"]] = row["value"]
    lines = [
        [element, n, *(_five_digits(found[key]) for key in names)]
        for (element, n), found in values.items()
    ]
    return _table(["element", "n", *headings], lines)


def _in_unit(unit):
    return f"[{unit}]" if unit else ""


def _five_digits(value):
    return f"{float(value):.5g}" if value else "none"


def rates():
    """The mean slopes of the published experiments, as Markdown."""
    lines = []
    for name in PUBLISHED:
        means = [row for row in _rows(name, "rates.csv") if row["kind"] == "mean"]
        for element in dict.fromkeys(row["element"] for row in means):
            slopes = {row["norm"]: row["slope"] for row in means if row["element"] == element}
            lines.append([f"`{name}`", element, *(_slope(slopes.get(norm)) for norm in SHOWN)])
    return _table(["scene", "element", "L2", "H1 seminorm", "trace", "contact force"], lines)


def _slope(value):
    return f"{float(value):.2f}" if value else ""


def steps():
    """Active-set steps, as Markdown."""
    lines = []
    for name in COUNTED:
        lines += [
            [
                f"`{name}`",
                *(row[key] for key in ("element", "n", "contact", "plain", "ours", "warm")),
            ]
            for row in _rows(name, "steps.csv")
        ]
    headings = ["scene", "element", "n", "contact unknowns", "plain", "ours", "ours, warm"]
    return _table(headings, lines)


def _rows(name, file):
    with open(RESULTS / name / file, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def _table(headings, lines):
    rows = [headings, [":---", *["---:"] * (len(headings) - 1)], *lines]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)
