"""Table 5.1, in LaTeX and in Markdown, from the rows of the pipeline's CSV files.

Every number is rounded once, from its binary value straight to the printed digits (Python's float
formatting is correctly rounded, exact ties to even).
"""

from decimal import Decimal

from signorini.errors.norms import NORMS, REFERENCE
from signorini.errors.rates import NO_LOGARITHM, ROUND_OFF, SOUND, trouble_of
from signorini.fem.element_facts import ABBREVIATIONS, ELEMENT_NAMES

ELEMENTS = ABBREVIATIONS  # the name under which studies.sensitivity.page imports it

SCIENTIFIC_BELOW, SCIENTIFIC_FROM = (
    1e-5,
    1e4,
)  # outside, eight decimals show too few digits or too many
MISSING = "--"
INACCURATE = "†"
MARKS = {ROUND_OFF: "*", REFERENCE: "‡", NO_LOGARITHM: "§", SOUND: ""}  # of a slope
NOTES = {
    ROUND_OFF: "an error in this column is round-off, the slope means nothing",
    REFERENCE: "a solution in this column is the reference itself and has no error, so that there is no slope",
    NO_LOGARITHM: "a distance in this column is zero, or infinite for want of a point, so that there is no slope",
}
JUMPS = "Critical points are known to half a mesh width: their distances jump, and only many levels show the slope 1."
TEX = {"†": r"$^\dagger$", "‡": r"$^\ddagger$", "§": r"$^\S$", "%": r"\%"}


def error_table(
    errors, rates, norms=("l2", "h1"), elements=ELEMENT_NAMES, kind="mean", decimals=8, note=None
):
    r"""Return the LaTeX ``tabular`` of Table 5.1: a row for every N, a column for every norm and element.

    Parameters
    ----------
    errors : sequence of mapping
        Rows with ``element``, ``n`` and one column per norm (dimensionless), as text or numbers; and perhaps
        ``status``: where it is "inaccurate" the errors are marked, and a note tells the largest of ``residual``,
        ``accuracy`` and ``multiplier_accuracy``.
    rates : sequence of mapping
        Rows with ``element``, ``norm``, ``kind``, ``slope``, and perhaps ``floor``: where it is not 0 the slope is
        marked and a note explains.
    norms, elements : sequence of str, optional
        The columns, and their order.
    kind : str, optional
        Which slopes fill the last row: "mean" or "fit".
    decimals : int, optional
        Decimals of an error. A column with a value below 1e-5, or from 1e4 on, is in scientific notation.
    note : str, optional
        One more note under the table, for instance `rates.reference_note`.

    Returns
    -------
    str
        Needs the package booktabs. What is not in the rows is printed as a dash.

    Raises
    ------
    ValueError
        If a norm or an element is unknown, or a level occurs twice.

    Examples
    --------
    >>> errors = [{"element": "P1", "n": 2, "l2": 0.10075495}]
    >>> rates = [{"element": "P1", "norm": "l2", "kind": "mean", "slope": 1.8955}]
    >>> print(error_table(errors, rates, norms=["l2"], elements=["P1"]))
    \begin{tabular}{rr}
    \toprule
     & \multicolumn{1}{c}{$L^2$ error} \\
    \cmidrule(lr){2-2}
    $N$ & \multicolumn{1}{c}{CF} \\
    \midrule
    2 & 0.10075495 \\
    \midrule
    slope & 1.90 \\
    \bottomrule
    \end{tabular}
    <BLANKLINE>
    """
    *levels, slopes = _grid(errors, rates, norms, elements, kind, decimals)
    width = len(elements)
    ends = [(2 + width * k, 1 + width * (k + 1)) for k in range(len(norms))]
    lines = [
        rf"\begin{{tabular}}{{r{'r' * width * len(norms)}}}",
        r"\toprule",
        _tex_row(
            ["", *(rf"\multicolumn{{{width}}}{{c}}{{{NORMS[norm].heading}}}" for norm in norms)]
        ),
        " ".join(rf"\cmidrule(lr){{{first}-{last}}}" for first, last in ends),
        _tex_row(
            [
                "$N$",
                *(
                    rf"\multicolumn{{1}}{{c}}{{{ABBREVIATIONS[e]}}}"
                    for _ in norms
                    for e in elements
                ),
            ]
        ),
        r"\midrule",
        *(_tex_row(map(_tex_number, row)) for row in levels),
        r"\midrule",
        _tex_row(map(_tex, slopes)),
        r"\bottomrule",
        *(
            _tex_row(
                [rf"\multicolumn{{{1 + width * len(norms)}}}{{p{{0.9\linewidth}}}}{{{_tex(text)}}}"]
            )
            for text in _notes(errors, rates, norms, elements, kind, note)
        ),
        r"\end{tabular}",
    ]
    return "\n".join(lines) + "\n"


def markdown_table(
    errors, rates, norms=("l2", "h1"), elements=ELEMENT_NAMES, kind="mean", decimals=8, note=None
):
    """Return the table of `error_table`, with the same arguments, as Markdown."""
    head = [
        "N",
        *(f"{NORMS[norm].text} {ABBREVIATIONS[element]}" for norm in norms for element in elements),
    ]
    rows = _grid(errors, rates, norms, elements, kind, decimals)
    table = "".join(f"| {' | '.join(row)} |\n" for row in [head, ["---:"] * len(head), *rows])
    notes = _notes(errors, rates, norms, elements, kind, note)
    return table + "".join(f"\n{text.replace('*', chr(92) + '*')}\n" for text in notes)


def _grid(errors, rates, norms, elements, kind, decimals):
    """Return the cells as plain text: a row for every level, and the row of slopes."""
    _known("norm", norms, NORMS)
    _known("element", elements, ELEMENT_NAMES)
    rows = {(row["element"], int(row["n"])): row for row in errors}
    if len(rows) < len(errors):
        raise ValueError("errors: an element and n occur twice")
    levels = sorted({n for _, n in rows})
    slopes = slopes_by_series(rates, kind)
    marks = {
        (row["norm"], row["element"]): MARKS[trouble_of(row)]
        for row in rates
        if row["kind"] == kind
    }
    inaccurate = {key for key, row in rows.items() if row.get("status") == "inaccurate"}
    columns = [[*map(str, levels), "slope"]]
    for norm in norms:
        for element in elements:
            cells = [rows.get((element, n), {}).get(norm) for n in levels]
            slope = fixed(slopes.get((norm, element)), 2) + marks.get((norm, element), "")
            printed = zip(levels, _format_column(cells, decimals), strict=True)
            marked = [
                cell + INACCURATE * ((element, n) in inaccurate and cell != MISSING)
                for n, cell in printed
            ]
            columns.append([*marked, slope])
    return [list(row) for row in zip(*columns, strict=True)]


def _notes(errors, rates, norms, elements, kind, note):
    """The lines under the table: what its marks mean, and what else is to be known."""
    marked = [
        row for row in errors if row["element"] in elements and row.get("status") == "inaccurate"
    ]
    shown = [
        row
        for row in rates
        if row["kind"] == kind and row["norm"] in norms and row["element"] in elements
    ]
    troubles = {trouble_of(row) for row in shown}
    notes = [_inaccurate(marked)] if marked else []
    notes += [f"{MARKS[trouble]} {text}" for trouble, text in NOTES.items() if trouble in troubles]
    notes += [JUMPS] if "critical_points" in norms else []
    return notes + ([f"Note: {note}."] if note else [])


def _inaccurate(rows):
    """What the mark of inaccurate rows means, with the worst of what their proofs say."""
    proofs = [float(row[name]) for row in rows for name in _PROOF if row.get(name)]
    worst = f" (at worst {max(proofs):.0e} of them)" if proofs else ""
    return (
        f"{INACCURATE} solved inaccurately, not to ten digits of u and of the contact force{worst}: smaller changes of "
        "these errors mean nothing"
    )


_PROOF = ("residual", "accuracy", "multiplier_accuracy")


def _known(kind, names, table):
    for name in names:
        if name not in table:
            raise ValueError(f"unknown {kind} {name!r}; known: {', '.join(table)}")


def slopes_by_series(rates, kind):
    """Return the slopes of one kind by (norm, element)."""
    return {(row["norm"], row["element"]): row["slope"] for row in rates if row["kind"] == kind}


def fixed(value, decimals):
    """Return a number with that many decimals, correctly rounded; a dash for None or empty text."""
    return MISSING if value in (None, "") else f"{float(value):.{decimals}f}"


def percent(share):
    """Return 100 `share` with two significant digits and no exponent."""
    return f"{Decimal(f'{100 * share:.1e}'):f}"


def _format_column(values, decimals):
    sizes = [abs(float(v)) for v in values if v not in (None, "")]
    if any(s >= SCIENTIFIC_FROM or 0 < s < SCIENTIFIC_BELOW for s in sizes):
        return [MISSING if v in (None, "") else f"{float(v):.4e}" for v in values]
    return [fixed(v, decimals) for v in values]


def _tex_number(text):
    number = text.rstrip(INACCURATE)
    mantissa, e, exponent = number.partition("e")
    return (rf"${mantissa}\times10^{{{int(exponent)}}}$" if e else number) + _tex(
        text[len(number) :]
    )


def _tex(text):
    return text.translate(str.maketrans(TEX))


def _tex_row(cells):
    return " & ".join(cells) + r" \\"
