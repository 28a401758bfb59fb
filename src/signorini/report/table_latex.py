"""A table in LaTeX, no wider than the article that takes it in."""

import math
import re
from itertools import accumulate, pairwise

# Characters of plain text that LaTeX reserves or lacks.
TEX = {"†": r"$^\dagger$", "‡": r"$^\ddagger$", "§": r"$^\S$", "%": r"\%"}
# Mantissa or dash, exponent, marks.
_NUMBER = re.compile(r"([-\d.]+)(?:e([-+]\d+))?(\D*)")
# Estimates for 11 pt type, in pt: a character, and the gaps around a column.
_CHARACTER, _GAPS = 5.5, 12.0
# Text of the narrowest article, 10 pt; a table below it needs no other cut.
_SURE = 345.0


def latex(table):
    """Return a table as a LaTeX ``tabular``, which needs the package booktabs.

    Parameters
    ----------
    table : Table

    Returns
    -------
    str
        Where the table may be wider than an article's lines, LaTeX measures it and cuts it into as
        few parts as fit, one below the other.

    Examples
    --------
    >>> from signorini.report.table_writer import Column, Group, Table, Title
    >>> levels = Column(Title("$N$", "N"), ("2",), "slope")
    >>> energy = Group(Title("$E$", "energy"), (Column(Title("CF", "CF"), ("0.5",), "1.0"),))
    >>> print(latex(Table((levels,), (energy,))), end="")
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
    count = len(table.groups)
    if table.side_by_side:
        return _tabular(table, table.side_by_side)
    if estimated_width(table) <= _SURE:
        return _tabular(table, count)
    return _measured(table)


def estimated_width(table):
    """The width of a table in 11 pt type, estimated from its longest cells.

    Parameters
    ----------
    table : Table

    Returns
    -------
    float
        In pt.
    """
    cells = [[*column.cells, column.foot] for column in table.columns]
    return math.fsum(_CHARACTER * max(map(len, column)) + _GAPS for column in cells)


def _measured(table):
    """The table in ever narrower cuts, of which LaTeX takes the first that fits."""
    count = len(table.groups)
    cuts = sorted({-(-count // parts) for parts in range(1, count + 1)}, reverse=True)
    candidates = [_tabular(table, cut) for cut in cuts]
    candidates.append(_SMALL + candidates[-1])
    first, *others = (f"\\setbox0\\hbox{{%\n{text}}}%\n" for text in candidates)
    narrower = [rf"\ifdim\wd0>\linewidth{chr(10)}{box}\fi{chr(10)}" for box in others]
    return "".join(["\\begingroup\n", first, *narrower, "\\leavevmode\\box0\\endgroup\n"])


_SMALL = "\\footnotesize\\setlength{\\tabcolsep}{3pt}%\n"


def _tabular(table, count):
    """The table with so many groups side by side."""
    blocks = table.blocks(count)
    width = max(len(block.columns) for block in blocks)
    lines = [rf"\begin{{tabular}}{{{'r' * width}}}", r"\toprule"]
    for block in blocks:
        lines += _block(block)
        lines += [r"\bottomrule" if block is blocks[-1] else r"\midrule[\heavyrulewidth]"]
    lines += [_note(text, width) for text in table.notes]
    return "\n".join([*lines, r"\end{tabular}"]) + "\n"


def _block(table):
    """Head, rows and foot."""
    lines = [*_head(table), r"\midrule"]
    lines += [_row(map(_cell, row)) for row in table.rows]
    if table.has_foot:
        lines += [r"\midrule", *(_row(map(_cell, row)) for row in table.feet)]
    return lines


def _head(table):
    """Titles of the groups, a rule under each, names of the columns."""
    spans = [len(group.columns) for group in table.groups]
    titles = [
        rf"\multicolumn{{{span}}}{{c}}{{{group.title.latex}}}"
        for span, group in zip(spans, table.groups, strict=True)
    ]
    yield _row([*[""] * len(table.leading), *titles])
    ends = list(accumulate(spans, initial=len(table.leading)))  # columns are counted from 1
    yield " ".join(rf"\cmidrule(lr){{{start + 1}-{end}}}" for start, end in pairwise(ends))
    names = [column.title.latex for group in table.groups for column in group.columns]
    names = [rf"\multicolumn{{1}}{{c}}{{{name}}}" for name in names]
    yield _row([*(column.title.latex for column in table.leading), *names])


def _note(text, width):
    return _row([rf"\multicolumn{{{width}}}{{p{{0.9\linewidth}}}}{{{_text(text)}}}"])


def _row(cells):
    return " & ".join(cells) + r" \\"


def _cell(text):
    """A number with its exponent as a power of ten, or any other text."""
    found = _NUMBER.fullmatch(text)
    if not found:
        return _text(text)
    number, exponent, marks = found.groups()
    if exponent:
        number = rf"${number}\times10^{{{int(exponent)}}}$"
    return number + _text(marks)


def _text(text):
    return text.translate(str.maketrans(TEX))
