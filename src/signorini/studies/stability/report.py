"""The stability suite's claims, tables and texts, from the rows that its jobs wrote."""

import numpy as np

from signorini.studies import machine
from signorini.studies.rivals import RIVALS
from signorini.studies.stability.claims import claims
from signorini.studies.stability.digits import digits
from signorini.studies.stability.parts import title
from signorini.studies.stability.proof import (
    ERROR,
    INACCURATE_FROM,
    NEEDLESS,
    OVERESTIMATE,
    REFUSED_FROM,
    UNDERESTIMATE,
    estimates,
    statuses,
)
from signorini.studies.stability.round_off import EPS, crossings, growth
from signorini.studies.stability.success import SLOW, summary
from signorini.studies.texts import Table, markdown_table, seconds, tex, tex_figure, tex_table

ELEMENTS = {"P1": "CF (P1)", "CR": "NCF (CR)"}
NORMS = {"l2": "L2", "h1_semi": "H1 seminorm", "h1": "H1"}
PACKAGES = (*machine.OURS, "clarabel", "highspy", "ngsolve", "osqp", "piqp", "proxsuite", "pyamg")


class Report:
    """What the suite found.

    Parameters
    ----------
    parts : dict
        ``success`` and ``digits``: all rows; ``floor`` and ``extremes``: dicts of rows by piece.
    time_limit : float
        Of a rival on a problem, in seconds.
    seeds : int
        The first seed of every kind of problem; 0 where they are the fixed ones.
    """

    def __init__(self, parts, time_limit, seeds=0):
        self.success, self.floor, self.extremes = (
            parts["success"],
            parts["floor"],
            parts["extremes"],
        )
        self.time_limit, self.seeds = time_limit, seeds
        self.solvers = summary(self.success, time_limit)
        self.statuses, self.estimates = statuses(self.success), estimates(self.success)
        base = [row for row in parts["digits"] if row["variant"] == "auto"]
        self.digits = digits(base, [row for row in parts["digits"] if row["variant"] != "auto"])
        rows = [row for name, piece in self.floor.items() if "-" in name for row in piece]
        self.crossings = crossings(rows)
        self.finest = {
            family: max(row["n"] for row in rows if row["family"] == family)
            for family in ("smooth", "patch")
        }

    def claims(self):
        """See `stability_claims.claims`."""
        return claims(self.success, self.statuses, self.digits, self.extremes)

    def tables(self):
        """The tables of the page, by label."""
        return {
            "claims": self._claims(),
            "solvers": self._solvers(),
            "statuses": self._statuses(),
            "estimates": self._estimates(),
            "digits": self._digits(),
            "crossings": self._crossings(),
        }

    def _claims(self):
        rows = [
            (row["claim"], row["measured"], row["limit"], "yes" if row["met"] else "NO")
            for row in self.claims()
        ]
        header = ("claim", "measured", "limit", "met")
        return Table(header, rows, "What is promised, and what was measured.", sentences=True)

    def _solvers(self):
        rows = []
        for row in self.solvers:
            share = [_share(row[key]) for key in ("solved_1e-06", "solved_1e-09", "ordinary_1e-09")]
            counts = [row["unclaimed"], row["wrong"], seconds(row["seconds"])]
            steps = f"{row['median_iterations']:.0f}, {row['most_iterations']}"
            rows.append((title(row["solver"]), row["problems"], *share, *counts, steps))
        header = (
            "solver",
            "problems",
            "1e-6",
            "1e-9",
            "ordinary",
            "unclaimed",
            "wrong",
            "time",
            "iterations",
        )
        slow = ", ".join(
            RIVALS[name].title for name in SLOW if any(r["solver"] == name for r in self.solvers)
        )
        absent = ", ".join(f"{r.title} ({r.install})" for r in RIVALS.values() if not r.available())
        caption = (
            "Success on generated problems: claimed solved, with a recomputed KKT residual of at most 1e-6 and 1e-9; "
            "the latter also without the loads tiny and huge (ordinary). Unclaimed: solved to 1e-9, but reported as "
            "failed. Wrong: claimed solved with a residual above 1e-6. Time: shifted geometric mean, shift 10 ms, a "
            f"failure counting {self.time_limit:g} s. Iterations, in each solver's own count: median, most. The time "
            f"limit is {self.time_limit:g} s a problem."
            + (f" On the first problems of each kind alone, being slow: {slow}." if slow else "")
            + (f" Not installed: {absent}." if absent else "")
            + f" {self._machine()}"
        )
        return Table(header, rows, caption)

    def _machine(self):
        found = machine.describe(PACKAGES)
        busy = [row["busy"] for row in self.success]
        versions = ", ".join(f"{name} {number}" for name, number in found["versions"].items())
        return (
            f"{found['processor']}, {found['cores']} cores; Python {found['python']}, {versions}; one thread per "
            f"process, several processes at a time, load average {min(busy):.1f} to {max(busy):.1f}."
        )

    def _statuses(self):
        rows = []
        for row in self.statuses:
            keys = ("solved_error", "solved_multiplier_error", "inaccurate_error")
            u, force, other = (_power(row[key]) if row[key] else "--" for key in keys)
            named = (
                row["solved"],
                u,
                force,
                row["wrong"],
                row["inaccurate"],
                other,
                row["needed"],
                row["refused"],
            )
            counts = (
                row["unneeded"],
                f"{row['wrong_side']:g}",
                f"{row['undecided']:g}",
                f"{row['needless']:g}",
            )
            rows.append((row["family"], row["element"], *named, *counts))
        header = (
            *(
                "bodies",
                "",
                "number",
                "u",
                "force",
                "wrong",
                "number",
                "u",
                "needed",
                "number",
                "unneeded",
            ),
            *("wrong", "open", "needless"),
        )
        groups = (
            ("", 2),
            ("solved", 4),
            ("inaccurate", 3),
            ("refused", 1),
            ("", 1),
            ("contact unknowns", 3),
        )
        caption = (
            "Statuses held against solutions in extended precision (80 bits), all routes. Solved: how many "
            "are called so, their largest error of u relative to its variation, of the contact forces "
            f"relative to the largest, and how many are wrong, by an error above {ERROR:g} or a contact "
            "unknown on the wrong side. Inaccurate: how many, their largest error of u, and how many have an "
            f"error above {ERROR:g}. Refused: how many. Unneeded: called inaccurate where double precision "
            f"makes no error above {INACCURATE_FROM:g} likely, refused where none above {REFUSED_FROM:g}, or "
            "with a residual above 1e-9. Contact unknowns of all answers: decided for the wrong side; called "
            "undecided; and that though gap or force exceed what rounding does to them by a factor of "
            f"{NEEDLESS:g}."
        )
        return Table(header, rows, caption, groups)

    def _estimates(self):
        rows = []
        for row in self.estimates:
            cells = [
                "--" if row[f"{which}{name}"] is None else f"{row[f'{which}{name}']:.2g}"
                for which in ("", "multiplier_")
                for name in ("least", "median", "most", "missed")
            ]
            rows.append((row["family"], row["element"], row["answers"], *cells))
        header = ("bodies", "", "answers", *("least", "median", "most", "missed") * 2)
        caption = (
            "The accuracy that a solution states, over its true error, of u and of the contact forces, all "
            f"routes: least, median, most. Missed: below 1/{UNDERESTIMATE:g}, or above {OVERESTIMATE:g}. In "
            "most and missed, an error below four roundings counts as so much."
        )
        return Table(header, rows, caption, (("", 3), ("u", 4), ("contact forces", 4)))

    def _digits(self):
        cells = {(row["element"], row["norm"], row["n"]): row["digits"] for row in self.digits}
        columns = list(dict.fromkeys((norm, element) for element, norm, _ in cells))
        columns.sort(
            key=lambda column: (list(NORMS).index(column[0]), list(ELEMENTS).index(column[1]))
        )
        rows = [
            (
                "slope" if n == 0 else f"{n:g}",
                *(f"{cells[element, norm, n]:.1f}" for norm, element in columns),
            )
            for n in sorted({n for *_, n in cells}, key=lambda n: (n == 0, n))
        ]
        header = (
            "N",
            *(f"{NORMS[norm]} {'CF' if element == 'P1' else 'NCF'}" for norm, element in columns),
        )
        variants = [
            key.removeprefix("digits_") for key in self.digits[0] if key.startswith("digits_")
        ]
        caption = (
            "Digits of Table 5.1 that one can trust: -log10 of the largest relative change of each number, "
            f"at most {-np.log10(EPS):.1f}, over all of: {', '.join(variants)}. Renumbered: vertices, triangles and "
            "edges of every mesh, the reference's too, in random order. Last bit: every datum moved by one unit in its "
            "last binary digit, up or down, or not at all. An entry e is the size of a difference of two functions of "
            "size one, so that -log10 e of the digits of these are not its own."
        )
        return Table(header, rows, caption)

    def _crossings(self):
        rows = [
            (
                f"{ELEMENTS[row['element']]}, {NORMS[row['norm']]}",
                f"{row['order']:.2f}",
                _power(row["floor"]) if row["floor"] else "0",
                "--" if row["floor_order"] is None else f"{row['floor_order']:.2f}",
                "--" if row["h"] is None else _power(row["h"]),
            )
            for row in self.crossings
        ]
        conditions, stretched = self.floor["conditions"], self.floor["stretching"]
        power = ", ".join(
            f"{name} {-slope:.2f}" for name, (slope, _) in growth(conditions, "condition").items()
        )
        flat = [row for row in stretched if row["aspect"] <= 1e-2]
        aspect = ", ".join(
            f"{name} {slope:.2f}" for name, (slope, _) in growth(flat, "error", by="aspect").items()
        )
        caption = (
            "Where accuracy ends, by the route taken unasked: the order of the error of the family smooth; round-off, "
            f"as the error of the family patch at h = 1/{self.finest['patch']:g}, and the power of 1/h with which it "
            "grows; and the h at which the two would meet if both went on so. The condition number of the stiffness "
            f"matrix goes with h to the power {power}. On cells pressed flat to an aspect of 1e-2 and below, "
            f"the error of the patch test goes with the aspect to the power {aspect}."
        )
        return Table(("", "order", "round-off", "grows", "would meet at h"), rows, caption)

    def markdown(self, figures):
        """The page, with its pictures beside it."""
        parts = ["# Stability", self.answer(), _INTRODUCTION + self._seeds()]
        pictures = [
            f"![{caption}](stability_{name}.png)\n\n{caption}" for name, caption in figures.items()
        ]
        tables = list(self.tables().values())
        parts += [markdown_table(tables[0]), markdown_table(tables[1]), *pictures[:2]]
        parts += [markdown_table(table) for table in tables[2:4]] + pictures[2:3]
        parts += [markdown_table(table) for table in tables[4:]] + pictures[3:]
        return "\n\n".join(part.strip() for part in parts) + "\n"

    def tex(self, figures):
        """The fragment for the paper's appendix."""
        floats = [
            tex_figure(f"stability_{name}", tex(caption), f"stability-{name}")
            for name, caption in figures.items()
        ]
        tables = [tex_table(table, f"stability-{name}") for name, table in self.tables().items()]
        texts = [
            part
            for text in (self.answer(), _INTRODUCTION + self._seeds())
            for part in (tex(text), "")
        ]
        return "\n".join(
            [r"\section{Stability}\label{sec:stability}", "", *texts, *tables, *floats]
        )

    def answer(self):
        """What was found, in three sentences."""
        keys = ("solutions", "solved", "wrong", "unneeded")
        solves, solved, wrong, unneeded = (sum(row[key] for row in self.statuses) for key in keys)
        problems = next(row["problems"] for row in self.solvers if row["solver"] == "ours")
        missed = sum(row["missed"] + row["multiplier_missed"] for row in self.estimates)
        broken = [row["claim"] for row in self.claims() if not row["met"]]
        return (
            f"Of {solves} solves of {problems} generated problems by all routes that apply, {solved} are "
            f"called solved, {_none(wrong)} of them wrong in u, in a contact force or in the contact set; the "
            f"other {solves - solved} are called inaccurate or refused, {_none(unneeded)} of them where "
            "double precision could do better. The accuracy that a solution states falls short of the true "
            f"error by more than a factor of {UNDERESTIMATE:g}, or exceeds it by more than {OVERESTIMATE:g}, "
            f"{_none(missed, 'never')}{' times' if missed else ''}. "
            + (f"Promises not kept: {'; '.join(broken)}." if broken else "All promises are kept.")
        )

    def _seeds(self):
        if not self.seeds:
            return " The seeds are fixed."
        return f" The seeds are random: --config seeds={self.seeds} runs them again."


_INTRODUCTION = (
    "Success rates on generated problems, ours on every route that applies and other people's solvers on the "
    "same matrices; the digits of Table 5.1 that one can trust; where round-off ends accuracy; and extremes. "
    "Every KKT residual is recomputed from the problem, whatever a solver claims. Bodies are families of "
    "meshes, and discs, layers and waves of stiff or soft material on them. The judge of u, contact forces "
    "and contact sets is a solution in extended precision: it works by couplings and differences instead of "
    "a matrix, finds the contact set itself, knows its own error, and counts no sign that does not exceed it."
)


def _none(count, word="none"):
    return str(count or word)


def _share(value):
    """Percent, never rounded up to 100."""
    return "100 %" if value == 1 else f"{np.floor(1000 * value) / 10:.1f} %"


def _power(value):
    return f"{value:.1e}"
