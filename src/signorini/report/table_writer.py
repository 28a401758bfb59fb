"""A table, described once and written in LaTeX and in Markdown."""

import re
from dataclasses import dataclass

# Characters of plain text that LaTeX reserves or lacks.
TEX = {"†": r"$^\dagger$", "‡": r"$^\ddagger$", "§": r"$^\S$", "%": r"\%"}
# All characters that LaTeX reserves.
ESCAPES = {c: f"\\{c}" for c in "&%$#_{}"} | {"\\": r"\textbackslash{}", "~": r"\~{}", "^": r"\^{}"}
# Mantissa or dash, exponent, marks.
_NUMBER = re.compile(r"([-\d.]+)(?:e([-+]\d+))?(\D*)")


@dataclass(frozen=True)
class Title:
    """A title of a column or of a group of columns, in both notations.

    Examples
    --------
    >>> Title("$L^2$ error", "L2").latex
    '$L^2$ error'
    """

    latex: str
    markdown: str


@dataclass(frozen=True)
class Table:
    """A table of numbers: a first column of levels, then groups of columns.

    Parameters
    ----------
    first : Title
        Of the first column.
    groups : sequence of Title
        Each stands above one column for each of `names`.
    names : sequence of str
        Of the columns in every group.
    body, foot : sequence of sequence of str
        Rows of cells, the foot below a rule. Plain text: numbers, with or without exponent, and
        marks behind them.
    notes : sequence of str
        Lines under the table, plain text.
    """

    first: Title
    groups: tuple
    names: tuple
    body: tuple
    foot: tuple
    notes: tuple

    @property
    def width(self):
        """Number of columns."""
        return 1 + len(self.groups) * len(self.names)


def latex(table):
    """Return a table as a LaTeX ``tabular``, which needs the package booktabs.

    Parameters
    ----------
    table : Table

    Returns
    -------
    str

    Examples
    --------
    >>> energy = Title("$E$", "energy")
    >>> table = Table(Title("$N$", "N"), [energy], ["CF"], [["2", "0.5"]], [["slope", "1.0"]], [])
    >>> print(latex(table), end="")
    \\begin{tabular}{rr}
    \\toprule
     & \\multicolumn{1}{c}{$E$} \\\\
    \\cmidrule(lr){2-2}
    $N$ & \\multicolumn{1}{c}{CF} \\\\
    \\midrule
    2 & 0.5 \\\\
    \\midrule
    slope & 1.0 \\\\
    \\bottomrule
    \\end{tabular}
    """
    lines = [
        rf"\begin{{tabular}}{{{'r' * table.width}}}",
        r"\toprule",
        *_latex_head(table),
        r"\midrule",
        *(_latex_row(map(_latex_cell, row)) for row in table.body),
        r"\midrule",
        *(_latex_row(map(_latex_cell, row)) for row in table.foot),
        r"\bottomrule",
        *(_latex_note(text, table.width) for text in table.notes),
        r"\end{tabular}",
    ]
    return "\n".join(lines) + "\n"


def markdown(table):
    """Return a table in Markdown, every note a paragraph below it.

    Parameters
    ----------
    table : Table

    Returns
    -------
    str

    Examples
    --------
    >>> energy = Title("$E$", "energy")
    >>> table = Table(Title("$N$", "N"), [energy], ["CF"], [["2", "0.5"]], [["slope", "--*"]], [])
    >>> print(markdown(table), end="")
    | N | energy CF |
    | ---: | ---: |
    | 2 | 0.5 |
    | slope | --* |
    """
    titles = [f"{group.markdown} {name}" for group in table.groups for name in table.names]
    header = [table.first.markdown, *titles]
    alignment = ["---:"] * table.width
    rows = [header, alignment, *table.body, *table.foot]
    lines = [f"| {' | '.join(row)} |\n" for row in rows]
    notes = [text.replace("*", r"\*") for text in table.notes]
    return "".join(lines) + "".join(f"\n{text}\n" for text in notes)


def _latex_head(table):
    """Titles of the groups, a rule under each, names of the columns."""
    span = len(table.names)
    titles = [rf"\multicolumn{{{span}}}{{c}}{{{group.latex}}}" for group in table.groups]
    yield _latex_row(["", *titles])
    starts = range(2, table.width + 1, span)  # columns are counted from 1
    yield " ".join(rf"\cmidrule(lr){{{start}-{start + span - 1}}}" for start in starts)
    names = [rf"\multicolumn{{1}}{{c}}{{{name}}}" for name in table.names]
    yield _latex_row([table.first.latex, *names * len(table.groups)])


def _latex_note(text, width):
    return _latex_row([rf"\multicolumn{{{width}}}{{p{{0.9\linewidth}}}}{{{_latex_text(text)}}}"])


def _latex_row(cells):
    return " & ".join(cells) + r" \\"


def _latex_cell(text):
    """A number with its exponent as a power of ten, or any other text."""
    found = _NUMBER.fullmatch(text)
    if not found:
        return _latex_text(text)
    number, exponent, marks = found.groups()
    if exponent:
        number = rf"${number}\times10^{{{int(exponent)}}}$"
    return number + _latex_text(marks)


def _latex_text(text):
    return text.translate(str.maketrans(TEX))
