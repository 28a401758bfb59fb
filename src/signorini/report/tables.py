"""Table 5.1, in LaTeX and in Markdown, from the rows of the pipeline's CSV files."""

from signorini.errors.norms import NORMS, PAPER_NORMS, REFERENCE
from signorini.errors.rates import NO_LOGARITHM, ROUND_OFF, SOUND, trouble_of
from signorini.fem.element_facts import ABBREVIATIONS, ELEMENT_NAMES
from signorini.report.rounding import MISSING, column, fixed
from signorini.report.slopes import slopes_by_series
from signorini.report.table_writer import Table, Title, latex, markdown

INACCURATE = "†"
MARKS = {ROUND_OFF: "*", REFERENCE: "‡", NO_LOGARITHM: "§", SOUND: ""}  # of a slope
NOTES = {
    ROUND_OFF: "an error in this column is round-off, the slope means nothing",
    REFERENCE: (
        "a solution in this column is the reference itself and has no error, "
        "so that there is no slope"
    ),
    NO_LOGARITHM: (
        "a distance in this column is zero, or infinite for want of a point, "
        "so that there is no slope"
    ),
}
JUMPS = (
    "Critical points are known to half a mesh width: their distances jump, "
    "and only many levels show the slope 1."
)
_PROOF = ("residual", "accuracy", "multiplier_accuracy")


def error_table(
    errors, rates, norms=PAPER_NORMS, elements=ELEMENT_NAMES, kind="mean", decimals=8, note=None
):
    r"""Return Table 5.1 in LaTeX: a row for every N, a column for every norm and element.

    Parameters
    ----------
    errors : sequence of mapping
        Rows with ``element``, ``n`` and one column per norm (dimensionless), as text or numbers;
        and perhaps ``status``: where it is "inaccurate" the errors are marked, and a note tells the
        largest of ``residual``, ``accuracy`` and ``multiplier_accuracy``.
    rates : sequence of mapping
        Rows with ``element``, ``norm``, ``kind``, ``slope``, and perhaps ``floor``: where it is not
        0 the slope is marked and a note explains.
    norms, elements : sequence of str, optional
        The columns, and their order.
    kind : str, optional
        Which slopes fill the last row: "mean" or "fit".
    decimals : int, optional
        Decimals of an error. A column with a value below 1e-5, or from 1e4 on, is in scientific
        notation.
    note : str, optional
        One more note under the table, for instance `rates.reference_note`.

    Returns
    -------
    str
        A ``tabular``, which needs the package booktabs. What is not in the rows is a dash.

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
    return latex(_described(errors, rates, norms, elements, kind, decimals, note))


def markdown_table(
    errors, rates, norms=PAPER_NORMS, elements=ELEMENT_NAMES, kind="mean", decimals=8, note=None
):
    """Return Table 5.1 in Markdown.

    Parameters
    ----------
    errors, rates, norms, elements, kind, decimals, note
        As for `error_table`.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        As `error_table`.

    Examples
    --------
    >>> errors = [{"element": "P1", "n": 2, "l2": 0.10075495}]
    >>> print(markdown_table(errors, [], norms=["l2"], elements=["P1"]), end="")
    | N | L2 CF |
    | ---: | ---: |
    | 2 | 0.10075495 |
    | slope | -- |
    """
    return markdown(_described(errors, rates, norms, elements, kind, decimals, note))


def _described(errors, rates, norms, elements, kind, decimals, note):
    _check_known("norm", norms, NORMS)
    _check_known("element", elements, ELEMENT_NAMES)
    *levels, slopes = _rows(errors, rates, norms, elements, kind, decimals)
    return Table(
        first=Title("$N$", "N"),
        groups=tuple(Title(NORMS[norm].heading, NORMS[norm].text) for norm in norms),
        names=tuple(ABBREVIATIONS[element] for element in elements),
        body=tuple(levels),
        foot=(slopes,),
        notes=tuple(_notes(errors, rates, norms, elements, kind, note)),
    )


def _check_known(what, names, table):
    for name in names:
        if name not in table:
            raise ValueError(f"unknown {what} {name!r}; known: {', '.join(table)}")


def _rows(errors, rates, norms, elements, kind, decimals):
    """Return the cells as plain text: a row for every level, and the row of slopes."""
    by_level = {(row["element"], int(row["n"])): row for row in errors}
    if len(by_level) < len(errors):
        raise ValueError("errors: an element and n occur twice")
    levels = sorted({n for _, n in by_level})
    slopes = _marked_slopes(rates, kind)
    columns = [[*map(str, levels), "slope"]]
    for norm in norms:
        for element in elements:
            rows = [by_level.get((element, n), {}) for n in levels]
            slope = slopes.get((norm, element), MISSING)
            columns.append([*_marked_errors(rows, norm, decimals), slope])
    return [list(row) for row in zip(*columns, strict=True)]


def _marked_errors(rows, norm, decimals):
    """One column of errors as text; a dash has nothing to mark."""
    cells = column([row.get(norm) for row in rows], decimals)
    marks = [INACCURATE if _is_inaccurate(row) else "" for row in rows]
    pairs = zip(cells, marks, strict=True)
    return [cell if cell == MISSING else cell + mark for cell, mark in pairs]


def _marked_slopes(rates, kind):
    """(norm, element) -> slope as text, with the mark of what is wrong with it."""
    slopes = slopes_by_series(rates, kind)
    troubles = {
        (row["norm"], row["element"]): trouble_of(row) for row in rates if row["kind"] == kind
    }
    return {key: fixed(slope, 2) + MARKS[troubles[key]] for key, slope in slopes.items()}


def _notes(errors, rates, norms, elements, kind, note):
    """The lines under the table: what its marks mean, and what else is to be known."""
    inaccurate = [row for row in errors if row["element"] in elements and _is_inaccurate(row)]
    if inaccurate:
        yield _inaccuracy_note(inaccurate)
    troubles = {
        trouble_of(row)
        for row in rates
        if row["kind"] == kind and row["norm"] in norms and row["element"] in elements
    }
    for trouble, text in NOTES.items():
        if trouble in troubles:
            yield f"{MARKS[trouble]} {text}"
    if "critical_points" in norms:
        yield JUMPS
    if note:
        yield f"Note: {note}."


def _is_inaccurate(row):
    return row.get("status") == "inaccurate"


def _inaccuracy_note(rows):
    """What the mark of inaccurate rows means, with the worst of what their proofs say."""
    proofs = [float(row[name]) for row in rows for name in _PROOF if row.get(name)]
    worst = f" (at worst {max(proofs):.0e} of them)" if proofs else ""
    return (
        f"{INACCURATE} solved inaccurately, not to ten digits of u and of the contact force"
        f"{worst}: smaller changes of these errors mean nothing"
    )
