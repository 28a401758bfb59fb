"""Table 5.1, in LaTeX and in Markdown, from the rows of the pipeline's CSV files."""

from dataclasses import replace
from itertools import pairwise
from math import isclose

from signorini.errors.norms import NORMS, REFERENCE
from signorini.errors.rates import NO_LOGARITHM, ROUND_OFF, SOUND, rate_between, trouble_of
from signorini.report.rounding import MISSING, column, fixed
from signorini.report.slopes import slopes_by_series
from signorini.report.table_form import LEADING, UNKNOWNS, TableForm
from signorini.report.table_latex import latex
from signorini.report.table_writer import Column, Group, Table, Title, markdown

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


def error_table(errors, rates, /, form=None, **fields):
    r"""Return Table 5.1 in LaTeX: a row for every N, a column for every norm and element.

    Parameters
    ----------
    errors : sequence of mapping
        Rows with ``element``, ``n`` and one column per norm (dimensionless), as text or numbers;
        and perhaps ``h`` and ``dofs``, where they are shown; and ``status``: where it is
        "inaccurate" the errors are marked, and a note tells the largest of ``residual``,
        ``accuracy`` and ``multiplier_accuracy``.
    rates : sequence of mapping
        Rows with ``element``, ``norm``, ``kind``, ``slope``, and perhaps ``floor``: where it is not
        0 the slope is marked and a note explains.
    form : TableForm, optional
    **fields
        Of a `TableForm`, where there is none.

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
    return latex(_described(errors, rates, form or TableForm(**fields)))


def markdown_table(errors, rates, /, form=None, **fields):
    """Return Table 5.1 in Markdown.

    Parameters
    ----------
    errors, rates, form, **fields
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
    return markdown(_described(errors, rates, form or TableForm(**fields)))


def _described(errors, rates, form):
    rows = _by_level(errors, form.levels)
    slopes = _marked_slopes(rates, form.kind) if form.slopes else None
    names = form.columns or _telling(errors)
    leading = [_leading(name, rows) for name in names if name in LEADING]
    first = replace(leading[0], foot="slope")
    groups = [_unknowns(rows, form)] if UNKNOWNS in names else []
    groups += [_group(norm, rows, slopes, form) for norm in form.norms]
    return Table(
        leading=(first, *leading[1:]),
        groups=tuple(groups),
        notes=tuple(_notes(errors, rates, form)),
        has_foot=form.slopes,
        side_by_side=form.side_by_side,
    )


def _by_level(errors, levels):
    """n -> element -> row of errors, by increasing level."""
    pairs = {(int(row["n"]), row["element"]): row for row in errors}
    if len(pairs) < len(errors):
        raise ValueError("errors: an element and n occur twice")
    found = {}
    for (n, element), row in sorted(pairs.items()):
        if levels is None or n in levels:
            found.setdefault(n, {})[element] = row
    return found


def _telling(errors):
    """The columns that tell the mesh width: n, and h where that is not 1/n."""
    sizes = ((int(row["n"]), float(row["h"])) for row in errors if row.get("h"))
    return ("n",) if all(isclose(n * h, 1.0) for n, h in sizes) else ("n", "h")


def _leading(name, rows):
    """One of the columns that all elements share."""
    if name == "n":
        return Column(Title("$N$", "N"), tuple(map(str, rows)))
    sizes = (next(iter(by_element.values()))["h"] for by_element in rows.values())
    return Column(Title("$h$", "h"), tuple(f"{float(size):.6g}" for size in sizes))


def _unknowns(rows, form):
    """The columns with the number of unknowns."""
    columns = []
    for element in form.elements:
        cells = (str(row.get(element, {}).get("dofs", MISSING)) for row in rows.values())
        columns.append(Column(_plain(form.label(element)), tuple(cells)))
    return Group(Title("unknowns", "unknowns of"), tuple(columns))


def _group(norm, rows, slopes, form):
    """The columns of a norm: for each element the errors, and perhaps their rates."""
    columns = []
    for element in form.elements:
        own = [row.get(element, {}) for row in rows.values()]
        slope = slopes.get((norm, element), MISSING) if form.slopes else ""
        cells = _marked_errors(own, norm, form)
        columns.append(Column(_plain(form.label(element)), tuple(cells), slope))
        if form.rates:
            columns.append(Column(_plain("rate"), tuple(_rates(own, norm))))
    return Group(Title(NORMS[norm].heading, NORMS[norm].text), tuple(columns))


def _plain(text):
    return Title(text, text)


def _marked_errors(rows, norm, form):
    """One column of errors as text; a dash has nothing to mark."""
    values = [row.get(norm) for row in rows]
    cells = column(values, form.decimals, form.digits, form.notation)
    marks = [INACCURATE if _is_inaccurate(row) else "" for row in rows]
    pairs = zip(cells, marks, strict=True)
    return [cell if cell == MISSING else cell + mark for cell, mark in pairs]


def _rates(rows, norm):
    """The rate from the level before, as text; a dash where it means nothing."""
    yield MISSING
    for coarse, fine in pairwise(rows):
        round_off = any(norm in row.get("floor", "").split() for row in (coarse, fine))
        yield MISSING if round_off else fixed(rate_between(coarse, fine, norm), 2)


def _marked_slopes(rates, kind):
    """(norm, element) -> slope as text, with the mark of what is wrong with it."""
    slopes = slopes_by_series(rates, kind)
    troubles = {
        (row["norm"], row["element"]): trouble_of(row) for row in rates if row["kind"] == kind
    }
    return {key: fixed(slope, 2) + MARKS[troubles[key]] for key, slope in slopes.items()}


def _notes(errors, rates, form):
    """The lines under the table: what its marks mean, and what else is to be known."""
    shown = [row for row in errors if form.levels is None or int(row["n"]) in form.levels]
    inaccurate = [row for row in shown if row["element"] in form.elements and _is_inaccurate(row)]
    if inaccurate:
        yield _inaccuracy_note(inaccurate)
    troubles = {
        trouble_of(row)
        for row in rates
        if form.slopes
        and row["kind"] == form.kind
        and row["norm"] in form.norms
        and row["element"] in form.elements
    }
    for trouble, text in NOTES.items():
        if trouble in troubles:
            yield f"{MARKS[trouble]} {text}"
    if "critical_points" in form.norms:
        yield JUMPS
    if form.note:
        yield f"Note: {form.note}."


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
