"""Words, numbers and tables of the studies' pages, in LaTeX and in Markdown."""

import re
from dataclasses import dataclass

from signorini.report.macros import ESCAPES


@dataclass(frozen=True)
class Table:
    """Cells of plain text.

    Parameters
    ----------
    header : sequence of str
    rows : sequence of sequence of str
        A row of one cell is a heading within the table.
    caption : str
    groups : sequence of (str, int), optional
        Titles above so many columns each, of all columns; an empty title is none.
    sentences : bool, optional
        Whether the first column is of sentences, which LaTeX is to break into lines.
    """

    header: tuple
    rows: list
    caption: str = ""
    groups: tuple = ()
    sentences: bool = False


def tex(text):
    """Plain text as LaTeX, with minus signs, powers of ten and thin spaces where there are numbers."""
    text = (
        str(text)
        .translate(str.maketrans(ESCAPES))
        .replace("≤", r"$\le$")
        .replace("×", r"$\times$")
        .replace(r" \%", r"\,\%")
    )
    text = re.sub(r"\b(\d[\d.]*)e([+-])0*(\d+)", _power, text)
    return re.sub(r"(?<![\w{}])-(?=\d)", "$-$", text)


def _power(found):
    mantissa, sign, exponent = found.groups()
    times = "" if mantissa == "1" else rf"{mantissa}\times"
    return rf"${times}10^{{{sign.strip('+')}{exponent}}}$"


def tex_table(table, label, more=""):
    """A floating table, the first column aligned left, all others right; `more`, in LaTeX, ends the
    caption.

    A table that is wider than the page is scaled down to it.
    """
    width, first = len(table.header), r"p{0.66\linewidth}" if table.sentences else "l"
    lines = [
        r"\begin{table}[tp]",
        r"\centering\scriptsize\setlength{\tabcolsep}{2.5pt}",
        rf"\caption{{{tex(table.caption)}{more}}}\label{{tab:{label}}}",
        r"\resizebox{\ifdim\width>\linewidth\linewidth\else\width\fi}{!}{%",
        rf"\begin{{tabular}}{{{first}{'r' * (width - 1)}}}",
        r"\toprule",
        *_tex_groups(table.groups),
        _tex_row(table.header),
        r"\midrule",
        *(_heading(row[0], width) if len(row) == 1 else _tex_row(row) for row in table.rows),
        r"\bottomrule",
        r"\end{tabular}}",
        r"\end{table}",
    ]
    return "\n".join(lines) + "\n"


def _tex_groups(groups):
    if not groups:
        return
    yield (
        " & ".join(rf"\multicolumn{{{span}}}{{c}}{{{tex(title)}}}" for title, span in groups)
        + r" \\"
    )
    first = 1
    for title, span in groups:
        if title:
            yield rf"\cmidrule(lr){{{first}-{first + span - 1}}}"
        first += span


def _tex_row(cells):
    return " & ".join(map(tex, cells)) + r" \\"


def _heading(text, width):
    return rf"\addlinespace\multicolumn{{{width}}}{{l}}{{\emph{{{tex(text)}}}}} \\"


def markdown_table(table):
    """The same in Markdown, its caption above."""
    width = len(table.header)
    rows = [[f"*{row[0]}*", *[""] * (width - 1)] if len(row) == 1 else row for row in table.rows]
    groups = [title for title, span in table.groups for _ in range(span)] or [""] * width
    header = [f"{title} {name}".strip() for title, name in zip(groups, table.header, strict=True)]
    lines = [header, [":---", *["---:"] * (width - 1)], *rows]
    body = "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines)
    return f"{table.caption}\n\n{body}" if table.caption else body


def tex_figure(name, caption, label):
    """A floating figure of the file name.pdf, unscaled; the caption is LaTeX."""
    return (
        f"\\begin{{figure}}[tp]\n\\centering\\includegraphics{{{name}.pdf}}\n"
        f"\\caption{{{caption}}}\\label{{fig:{label}}}\n\\end{{figure}}\n"
    )


def seconds(value):
    """A time with two digits, in the unit that suits it."""
    for size, unit in ((0.9995, "s"), (0.9995e-3, "ms")):
        if value >= size:
            return f"{_two_digits(value / (1.0 if unit == 's' else 1e-3))} {unit}"
    return f"{_two_digits(value / 1e-6)} us"


def thousands(value):
    """A count with two digits and k or M."""
    for size, unit in ((1e6, " M"), (1e3, " k")):
        if value >= 0.995 * size:
            return f"{_two_digits(value / size)}{unit}"
    return f"{value:.0f}"


def megabytes(value):
    """Bytes as a number of MB with two digits; less than a tenth is not worth a digit."""
    return _two_digits(value / 1e6) if value >= 1e5 else "<0.1"


def _two_digits(value):
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


def factor(value):
    """A ratio with two digits."""
    return f"{value:.2f}" if value < 0.995 else _two_digits(value)
