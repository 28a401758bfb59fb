"""The page of the sensitivity study: its findings in words and tables, every number from the
study's rows.
"""

from collections import Counter

from signorini.report.tables import ELEMENTS, percent
from signorini.studies.page import Figure, Table, Text
from signorini.studies.sensitivity.combinations import NORMS, SERIES, TIE, one_at_a_time, where
from signorini.studies.sensitivity.unsaid import CHOICES, PAPER, count_solves

TITLE = "Sensitivity to what the paper leaves unsaid"
SYMBOLS = {"l2": "$L^2$", "h1": "$H^1$"}
NAMES = {
    "diagonal": {
        "falling": "falling",
        "rising": "rising",
        "alternating": "alternating (falling)",
        "alternating-rising": "alternating (rising)",
        "criss-cross": "criss-cross",
    },
    "load": {"exact": "exact", "nodal": "nodal"},
    "rule": {"exact": "exact"},
    "h1": {"full": "full norm", "semi": "seminorm"},
    "slope": {"mean": "mean", "fit": "least-squares fit"},
}
WORDS = {
    "diagonal": "diagonal",
    "load": "load",
    "rule": "norms",
    "h1": "$H^1$ error",
    "slope": "slope",
}
_LETTERS = {"P1": "C", "CR": "N", TIE: "="}


def page(rows, errors, reference_n, quick=False):
    """Put the page together.

    Parameters
    ----------
    rows : sequence of mapping
        Of `combinations.combinations`.
    errors : sequence of mapping
        What the rows were computed from.
    reference_n : int
        1/h of the reference.
    quick : bool, optional
        Whether this is a part of the study only.

    Returns
    -------
    title : str
    blocks : list
        For `page.to_latex` and `page.to_markdown`.
    """
    levels = sorted({int(row["n"]) for row in errors})
    pairs = where(rows, **{choice: PAPER[choice] for choice in ("rule", "h1", "slope")})
    blocks = [
        *[_warning(levels, reference_n)] * quick,
        _question(rows),
        _answer(rows),
        _matches_figure(rows),
        _changes_table(rows),
        _conclusions(rows, pairs, levels),
        _ratios_figure(),
        _rankings_table(pairs, levels),
        _loads_table(pairs),
        _method(rows, errors, levels, reference_n),
    ]
    return TITLE + " (quick variant)" * quick, blocks


def _prose(text):
    return " ".join(text.split())


def _warning(levels, reference_n):
    return Text(
        _prose(f"""
        This is the quick variant of the study: $N$ up to {levels[-1]} and a reference with $h = 1/{reference_n}$,
        which is not the paper's. So the published numbers cannot be expected to come out, and the average slopes,
        which are of other levels, are not compared.
        """)
    )


def _question(rows):
    counts = ", ".join(str(len({row[choice] for row in rows})) for choice in CHOICES)
    slopes = f" and {rows[0]['slopes']} slopes" if rows[0]["slopes"] else ""
    return Text(
        _prose(f"""
        Five choices are not stated in the paper: the diagonal that cuts the squares, the rule for the load, the rule
        for the norms of the error, whether the $H^1$ error is the full norm or the seminorm, and what an average
        slope is. All {len(rows)} combinations of their {counts} options are held against {rows[0]["errors"]}
        errors{slopes} of Table 5.1, of conforming P1 (CF) and Crouzeix-Raviart elements (NCF). A number is matched if
        it is within one unit of its last printed digit.
        """)
    )


def _answer(rows):
    counts = Counter(row["matched"] for row in rows)
    other = [
        row for row in rows if any(row[choice] != PAPER[choice] for choice in ("diagonal", "load"))
    ]
    nearest = min(other, key=lambda row: row["largest_miss"])
    return Text(
        _prose(f"""
        {_best(rows, counts)}; {counts[0]} match none (@sensitivity_matches). With another diagonal or load rule, some
        error is off by {percent(nearest["largest_miss"])} % or more; nearest comes the load
        {_name("load", nearest["load"])} with the diagonal {_name("diagonal", nearest["diagonal"])}.
        @sensitivity_changes changes one choice at a time.
        """)
    )


def _best(rows, counts):
    total = rows[0]["errors"]
    if not counts[total]:
        return f"No combination matches all {total} errors, none more than {max(counts)}"
    found = [row for row in rows if row["matched"] == total]
    slopes = [row for row in found if row["slopes_matched"] == row["slopes"] > 0]
    also = (
        f"With the slope {_named(slopes, 'slope')} its {rows[0]['slopes']} slopes come out as well."
        * bool(slopes)
    )
    return f"""
        All {total} errors come out under {counts[total]} of them: {_options(found)}. The midpoint rule is exact for
        squares of affine functions, and the errors do not depend on what a slope is, so that this is a single table.
        {also}
        No other combination matches more than {max(k for k in counts if k < total)} errors"""


def _options(rows):
    """The options that rows have for each choice, as a phrase."""
    return ", ".join(f"{WORDS[choice]} {_named(rows, choice)}" for choice in CHOICES)


def _named(rows, choice):
    return " or ".join(
        _name(choice, option) for option in dict.fromkeys(row[choice] for row in rows)
    )


def _name(choice, option):
    return NAMES[choice].get(option, f"by {option}")


def _matches_figure(rows):
    caption = f"""
        How many of {rows[0]["errors"]} errors each combination matches, and by how much it misses the worst of them.
        What a slope is does not matter here.
        """
    return Figure("sensitivity_matches", _prose(caption))


def _ratios_figure():
    caption = """
        The $L^2$ error of NCF relative to that of CF, norms integrated exactly. Below 1, NCF is the better element.
        """
    return Figure("sensitivity_ratios", _prose(caption))


def _changes_table(rows):
    found, body = one_at_a_time(rows), []
    for row in found:
        changed = [choice for choice in CHOICES if row[choice] != PAPER[choice]]
        name = (
            f"{WORDS[changed[0]]}: {_name(changed[0], row[changed[0]])}" if changed else "as found"
        )
        letters = "".join(_LETTERS[word] for word in row["l2_smaller"].split())
        slopes = [str(row["slopes_matched"])] * bool(row["slopes"])
        rates = [", ".join(pair) for pair in (_rates(row)[:2], _rates(row)[2:])]
        body.append(
            [
                name,
                letters,
                str(row["matched"]),
                *slopes,
                f"{percent(row['largest_miss'])} %",
                *rates,
            ]
        )
    head = ["choice", "$L^2$ smaller", "errors", *["slopes"] * bool(found[0]["slopes"]), "off by"]
    caption = """
        One choice changed at a time: who has the smaller $L^2$ error on each level, coarsest first (C is CF, N is
        NCF, = a tie); how many published errors and slopes are matched, and by how much the worst of the errors is
        off; the average slopes of CF and NCF to one decimal.
        """
    head += [f"slopes {SYMBOLS[norm]}" for norm in NORMS]
    return Table("sensitivity_changes", _prose(caption), tuple(head), body, left=2)


def _conclusions(rows, pairs, levels):
    base = where(rows, **PAPER)[0]
    same = [row for row in pairs if row["l2_smaller"] == base["l2_smaller"]]
    rates = [row for row in pairs if _rates(row) == _rates(base)]
    better = [row for row in pairs if row["l2_ratio"] < 1.0]
    ties = (
        "Ties occur where $f$ vanishes at all points of the load rule, and both elements give zero."
    )
    return Text(
        _prose(f"""
        What would have been concluded? As found, {_ranking(base, levels)}. Of the {len(pairs)} pairs of a diagonal
        and a load rule, {len(same)} give this ranking on every level, {len(better)} give NCF the smaller $L^2$ error
        on the geometric mean over the levels (@sensitivity_ratios, @sensitivity_rankings), and {len(rates)} give the
        same four slopes to one decimal; @sensitivity_loads gathers them by load rule. The rule for the norms and the
        meaning of the $H^1$ error change the ranking in $L^2$ for {_unstable(rows, "l2") or "none"} of these pairs,
        and that in $H^1$ for {_unstable(rows, "h1") or "none"}.
        {ties if any(TIE in row["l2_smaller"] for row in pairs) else ""}
        """)
    )


def _rates(row):
    return [f"{row[f'slope_{norm}_{element}']:.1f}" for norm, element in SERIES]


def _ranking(row, levels):
    found = list(zip(levels, row["l2_smaller"].split(), strict=True))
    parts = []
    for element, name in ELEMENTS.items():
        where_better = [str(n) for n, word in found if word == element]
        parts += [f"{name} has the smaller $L^2$ error at $N$ = {', '.join(where_better)}"] * bool(
            where_better
        )
    return " and ".join(parts)


def _unstable(rows, norm):
    """Pairs of diagonal and load for which the ranking depends on the norm rule or the meaning of
    the H1 error.
    """
    found = {}
    for row in rows:
        found.setdefault((row["diagonal"], row["load"]), set()).add(row[f"{norm}_smaller"])
    return sum(len(rankings) > 1 for rankings in found.values())


def _rankings_table(pairs, levels):
    body = []
    for k, n in enumerate(levels):
        counts = [Counter(row[f"{norm}_smaller"].split()[k] for row in pairs) for norm in NORMS]
        body.append([str(n), *(str(count[word]) for count in counts for word in ("P1", "CR", TIE))])
    means = [[row[f"{norm}_ratio"] for row in pairs] for norm in NORMS]
    body.append(
        [
            "mean",
            *(str(c) for m in means for c in (sum(r >= 1 for r in m), sum(r < 1 for r in m), 0)),
        ]
    )
    head = ("$N$", *(f"{SYMBOLS[norm]} {word}" for norm in NORMS for word in ("CF", "NCF", "tie")))
    caption = _prose(f"""
        In how many of the {len(pairs)} pairs of a diagonal and a load rule each element has the smaller error; in the
        last row, by the geometric mean over the levels.
        """)
    return Table("sensitivity_rankings", caption, head, body)


def _loads_table(pairs):
    body = []
    for load in dict.fromkeys(row["load"] for row in pairs):
        found = where(pairs, load=load)
        columns = ["l2_ratio", *(f"slope_{norm}_{element}" for norm, element in SERIES)]
        body.append(
            [_name("load", load), *(_range([row[column] for row in found]) for column in columns)]
        )
    head = (
        "load",
        "$L^2$ NCF/CF",
        *(f"slope {SYMBOLS[norm]} {ELEMENTS[element]}" for norm, element in SERIES),
    )
    caption = _prose("""
        For each load rule, the range over the diagonals of the geometric mean of the ratios of @sensitivity_ratios,
        and of the average slopes.
        """)
    return Table("sensitivity_loads", caption, head, body)


def _range(values):
    return f"{min(values):.2f} to {max(values):.2f}"


def _method(rows, errors, levels, reference_n):
    each = len(levels) * len(ELEMENTS) + 1
    return Text(
        _prose(f"""
        Every combination has its own reference, CF with $h = 1/{reference_n}$ under the same diagonal and load rule.
        Solves are shared: {count_solves(errors)} in place of {each * len(rows)}, which are {each} for each
        combination. In an alternating pattern the diagonals change like the colours of a chessboard; (falling) and
        (rising) tell how the lower left square is cut, and with it all others of its colour. Falling, rising,
        criss-cross, and alternating (rising) meshes nest in the reference's ({2 * reference_n**2} triangles, twice as
        many for criss-cross, at equal $N$). In the alternating (falling) pattern, edges of the coarse mesh cut
        through triangles of the reference's, which are halved there. On the triangles of this common refinement both
        functions are affine, and the rule for the norms is applied to them: the exact one is exact for all diagonals.
        With the nodal load, $f$ is replaced by its interpolant in the element's own nodes; for NCF this is the rule
        of the midpoints.
        """)
    )
