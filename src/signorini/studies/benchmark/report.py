"""The benchmark in words: a fragment for the paper's appendix, and a page for the documentation."""

from signorini.solvers.solution import INACCURATE, SOLVED
from signorini.studies.benchmark.columns import COUNTS, TOLERANCE
from signorini.studies.benchmark.summary import NORMS, TARGETS, better, fastest, series
from signorini.studies.machine import sentence
from signorini.studies.texts import (
    Table,
    factor,
    markdown_table,
    megabytes,
    seconds,
    tex,
    tex_figure,
    tex_table,
    thousands,
)

NAMES = {"l2": "L2", "h1": "H1"}
FIGURES = {
    "error": "Time against error; labels are 1/h, whiskers the least and the largest time.",
    "dofs": "Unknowns against error; the routes of an element share a curve.",
    "growth": "Time and memory against unknowns; in the legends exponents, fitted to the finest levels, at most four.",
    "stages": "Where time goes on the finest level of each series; on the right the total.",
    "rivals": "Time of the rivals over ours on the same matrices, a point for each scene, element (P1 black, CR blue) "
    "and level (coarsest on top), with the range over the pairs; hollow where the rival failed by our residual.",
}

_AS_ABOVE = r" Machine, versions, threads and load as in Figure~\ref{fig:benchmark-error}."


class Report:
    """All that the benchmark says.

    Parameters
    ----------
    points, rivals : sequence of dict
        Rows of benchmark.csv and rivals.csv, with numbers.
    summary : dict
        Of `benchmark_summary.summary`, with the rivals' ``titles``.
    machine : dict
        Of `machine.describe`.
    asked : dict
        config/benchmark.yaml, and the level of each scene's own reference under ``truths``.
    """

    def __init__(self, points, rivals, summary, machine, asked):
        self.points, self.rivals, self.summary, self.asked = points, rivals, summary, asked
        self.series = series(points)
        self.scenes = list(dict.fromkeys(scene for scene, _, _ in self.series))
        self.machine = f"{sentence(machine)}."

    def tex(self):
        """The fragment, which starts with its section; the figures benchmark_*.pdf lie beside it."""
        words = (self.method(), " ".join([self.truth(), *self.bending_words()]), self.duel_words())
        first, *others = FIGURES
        parts = [
            "\\section{Run time against error}\\label{sec:benchmark}",
            *map(tex, words),
            tex_figure(
                f"benchmark_{first}", tex(f"{FIGURES[first]} {self.machine}"), f"benchmark-{first}"
            ),
            tex_table(self.reach_table(), "benchmark-reach", _AS_ABOVE),
            *(
                tex_figure(f"benchmark_{name}", tex(FIGURES[name]) + _AS_ABOVE, f"benchmark-{name}")
                for name in others
            ),
            tex_table(self.duel_table(), "benchmark-rivals", _AS_ABOVE),
        ]
        return "\n\n".join(parts) + "\\clearpage\n"

    def markdown(self):
        """The page; the figures benchmark_*.png and the tables *.csv lie beside it."""
        figures = {
            name: f"![{words}](benchmark_{name}.png)\n\n{words}" for name, words in FIGURES.items()
        }
        parts = [
            "# Run time against error",
            f"`snakemake --cores 2 benchmark`; {self.machine}",
            self.method()
            + " All numbers: [benchmark.csv](benchmark.csv), [rivals.csv](rivals.csv).",
            figures["error"],
            "## Which element gets there first",
            markdown_table(self.reach_table()),
            " ".join([self.truth(), *self.bending_words()]),
            *([markdown_table(self.bending_table())] if self.summary["bending"] else []),
            figures["dofs"],
            "## What more costs",
            figures["growth"],
            markdown_table(self.growth_table()),
            figures["stages"],
            markdown_table(self.counts_table()),
            *([markdown_table(self.skipped_table())] if self.skipped_table().rows else []),
            "## Rivals",
            self.duel_words(),
            markdown_table(self.duel_table()),
            figures["rivals"],
            *(markdown_table(self.ratio_table(ours)) for ours in self.routes()),
        ]
        return "\n\n".join(part.strip() for part in parts) + "\n"

    def method(self):
        """How it was measured."""
        limits, repeats = self.asked["limits"], self.asked["repeats"]
        differences = [row["difference"] for rows in self.series.values() for row in rows]
        return (
            "Each point is a process of its own, alone on the machine as far as this workflow goes, from the scene's "
            "statement to the solution with its proof: mesh, assembly, solve. The time is the median of "
            f"{_range(repeats['least'], repeats['most'])} runs after a warm-up on the level before; memory is what the "
            "process held at its peak beyond what it held after the warm-up. A level is left out where the one before "
            f"foretells more than {limits['seconds']:g} s or {limits['megabytes']:g} MB. The solutions of all routes "
            f"agree to {max(differences):.0e} of max |u| with those whose errors are shown."
        )

    def truth(self):
        """What the errors are held against."""
        references = {
            name: part["reference"]
            for name, part in self.asked["scenes"].items()
            if "reference" in part
        }
        told = ", ".join(f"{name} by P1 with h = 1/{n}" for name, n in references.items())
        return "Errors are against the exact solution" + (
            f", or against a reference at least four times finer than any level shown ({told})."
            if told
            else "."
        )

    def bending_words(self):
        """What the scenes' own references do to the last level of their tables."""
        rows = self.summary["bending"]
        for scene in dict.fromkeys(row["scene"] for row in rows):
            found = [row for row in rows if row["scene"] == scene]
            last = max(row["n"] for row in found)
            changes = [
                f"{row['element']} {NAMES[row['norm']]} {100 * row['change']:+.2f} %"
                for row in found
                if row["n"] == last
            ]
            yield (
                f"The reference of the scene {scene} itself, h = 1/{self.asked['truths'][scene]}, bends the errors of "
                f"its last level, h = 1/{last}, by {', '.join(changes)}."
            )

    def reach_table(self):
        """Time, unknowns and memory to reach each error, by the fastest route of each element."""
        best, rows = fastest(self.summary["reach"]), []
        for norm in NORMS:
            rows.append([f"{NAMES[norm]} error"])
            for scene in self.scenes:
                for target in TARGETS:
                    found = best.get((scene, norm, target), {})
                    cells = [
                        cell
                        for element in self.elements()
                        for cell in _cost_cells(found.get(element))
                    ]
                    verdict = better(found)
                    winners = [_winner(verdict.get(cost)) for cost in ("total", "dofs", "memory")]
                    rows.append(
                        [scene if target == TARGETS[0] else "", f"{target:g}", *cells, *winners]
                    )
        each = ("time", "", "unknowns", "MB") * len(self.elements())
        groups = (("", 2), *((name, 4) for name in self.elements()), ("more accurate per", 3))
        caption = (
            "What an error costs each element by its fastest route (initials: "
            f"{', '.join(self.methods())}), interpolated between levels; ≤: the coarsest level is better already; "
            "--: not reached. Then which element is more accurate per second, per unknown and per byte, as the factor "
            "that the other one pays; even: the ranges of the times overlap."
        )
        return Table(("scene", "error", *each, "second", "unknown", "byte"), rows, caption, groups)

    def growth_table(self):
        """Exponents of time and memory, and time per unknown on the finest level."""
        exponents = {
            (row["scene"], row["element"], row["method"], row["quantity"]): row
            for row in self.summary["growth"]
        }
        rows = []
        for key, found in self.series.items():
            fits = [exponents.get((*key, quantity)) for quantity in ("total", "memory")]
            finest = found[-1]
            fitted = [f"{fit['exponent']:.2f}" if fit else "--" for fit in fits]
            costs = [
                seconds(finest["total"]),
                megabytes(finest["memory"]),
                f"{finest['memory'] / finest['dofs']:.0f}",
            ]
            rows.append(
                [" ".join(key), f"1/{finest['n']:g}", thousands(finest["dofs"]), *costs, *fitted]
            )
        header = (
            "series",
            "finest h",
            "unknowns",
            "time",
            "MB",
            "bytes per unknown",
            "exponent of time",
            "of memory",
        )
        return Table(header, rows, "Exponents are fitted to the finest levels, at most four.")

    def counts_table(self):
        """What the routes did on the finest level of each series."""
        rows = [
            [" ".join(key), f"1/{found[-1]['n']:g}", *(f"{found[-1][c]:g}" for c in COUNTS)]
            for key, found in self.series.items()
        ]
        return Table(
            ("series", "finest h", *COUNTS),
            rows,
            "Counts of work on the finest level of each series.",
        )

    def skipped_table(self):
        """The first level left out of each series, and why."""
        first = {}
        for row in self.points:
            if row["status"] != "measured":
                first.setdefault((row["scene"], row["element"], row["method"]), row)
        rows = [[" ".join(key), f"1/{row['n']:g}", row["note"]] for key, row in first.items()]
        return Table(("series", "from h", "why"), rows, "Levels left out:")

    def bending_table(self):
        """Errors by the scene's own reference and by the finer one."""
        rows = [
            [
                f"{r['scene']} {r['element']} {NAMES[r['norm']]}",
                f"1/{r['n']}",
                f"{r['coarse']:.8f}",
                f"{r['fine']:.8f}",
                f"{100 * r['change']:+.2f} %",
            ]
            for r in self.summary["bending"]
        ]
        return Table(("error", "h", "by the scene's reference", "by the finer one", "change"), rows)

    def duel_words(self):
        """What the rivals were asked, and who won how often."""
        asked, duels = self.asked["rivals"], self.summary["duels"]
        levels = ", ".join(f"1/{n}" for n in asked["levels"])
        wins, even, losses = (sum(row[key] for row in duels) for key in ("wins", "even", "losses"))
        absent = dict.fromkeys(
            f"{self.title(r['rival'])} ({r['note']})"
            for r in self.rivals
            if r["status"] == "absent"
        )
        return (
            "Rivals solve the same matrices, assembled beforehand, in turn with each of our routes, at "
            f"h = {levels}, as far as one solve takes no more than {asked['seconds']:g} s; ours include the proof. "
            f"They are asked for a tolerance of {TOLERANCE:g} and judged by our residual: solved up to {SOLVED:g}, "
            f"inaccurate up to {INACCURATE:g}. Over all pairs of a rival and a route of ours in which the rival did "
            f"not fail, ours was faster in {losses}, the rival in {wins}, and in {even} the ranges overlap."
            + (f" Not installed: {', '.join(absent)}." if absent else "")
        )

    def duel_table(self):
        """Per rival: what became of its problems, and its time over each of our routes."""
        verdicts, rows, before = self.summary["verdicts"], [], None
        for row in sorted(self.summary["duels"], key=lambda row: self.title(row["rival"]).lower()):
            fate = [
                verdicts[row["rival"]][key]
                for key in ("solved", "inaccurate", "failed", "wrong", "left out")
            ]
            first = [""] * 6 if row["rival"] == before else [self.title(row["rival"]), *fate]
            times = [
                factor(row["ratio"]),
                f"{factor(row['ratio_min'])} to {factor(row['ratio_max'])}",
            ]
            rows.append([*first, row["ours"], *times, row["wins"], row["even"], row["losses"]])
            before = row["rival"]
        caption = (
            "Rivals: problems solved, solved inaccurately, failed, claimed but wrong (among the failed), and scenes "
            "with an element left for want of time; their time over ours, geometric mean and range, and how often they "
            "win (w), are even (e), or lose (l)."
        )
        header = (
            "rival",
            "solved",
            "inaccurate",
            "failed",
            "wrong",
            "left",
            "ours",
            "mean",
            "range",
            "w",
            "e",
            "l",
        )
        return Table(
            header, rows, caption, (("", 1), ("problems", 5), ("time of the rival / ours", 6))
        )

    def ratio_table(self, ours):
        """The ratios to one of our routes, a row per problem, a column per rival."""
        rows = [row for row in self.rivals if row["ours"] == ours]
        names = list(dict.fromkeys(row["rival"] for row in rows))
        problems = dict.fromkeys((row["scene"], row["element"], row["n"]) for row in rows)
        found = {(row["scene"], row["element"], row["n"], row["rival"]): row for row in rows}
        lines = [
            [
                f"{problem[0]} {problem[1]}",
                f"1/{problem[2]:g}",
                *(_ratio(found.get((*problem, name))) for name in names),
            ]
            for problem in problems
        ]
        caption = f"Time of the rivals over `{ours}`: median (least to largest); *failed* where our residual says so."
        return Table(("problem", "h", *map(self.title, names)), lines, caption)

    def title(self, name):
        """A rival's name in words."""
        return self.summary["titles"].get(name, name)

    def elements(self):
        """The elements measured, P1 first."""
        return sorted({element for _, element, _ in self.series}, reverse=True)

    def methods(self):
        """Our routes measured."""
        return list(dict.fromkeys(method for _, _, method in self.series))

    def routes(self):
        """Our routes that met rivals."""
        return list(dict.fromkeys(row["ours"] for row in self.summary["duels"]))


def _range(least, most):
    return f"{least} to {most}" if least < most else f"{least}"


def _cost_cells(row):
    if row is None:
        return ["--", "", "--", "--"]
    sign = "≤" if row["status"] == "coarsest level" else ""
    memory = megabytes(row["memory"])
    costs = [sign + thousands(row["dofs"]), memory if memory.startswith("<") else sign + memory]
    return [sign + seconds(row["total"]), row["method"][0], *costs]


def _winner(verdict):
    if verdict is None:
        return ""
    element, ratio = verdict
    return f"{element or 'even'} {factor(ratio)}"


def _ratio(row):
    if row is None or row["ratio"] is None:
        return ""
    text = f"{factor(row['ratio'])} ({factor(row['ratio_min'])} to {factor(row['ratio_max'])})"
    return f"{text} *failed*" if row["status"] == "failed" else text
