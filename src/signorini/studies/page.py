"""A study's page in LaTeX, for the appendix of the PDF, and in Markdown, from the same blocks.

In a text, ``$...$`` is mathematics and ``@name`` refers to the figure or table of that name.
"""

import re
from dataclasses import dataclass

_RESERVED = {"%": r"\%", "&": r"\&", "_": r"\_", "#": r"\#"}


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    text: str


@dataclass(frozen=True)
class Figure:
    """A picture: the files ``<name>.pdf`` and ``<name>.png`` beside the page."""

    name: str
    caption: str


@dataclass(frozen=True)
class Table:
    """Rows of text under a head; the first `left` columns are words, the others numbers."""

    name: str
    caption: str
    head: tuple
    rows: list
    left: int = 1


def to_latex(title, blocks):
    """Return a LaTeX fragment that starts with a section; needs booktabs, caption and graphicx."""
    return "\n".join(
        [rf"\section{{{_tex(title)}}}", *(_LATEX[type(block)](block) for block in blocks)]
    )


def to_markdown(title, blocks):
    """Return a Markdown page."""
    numbers = {}
    for kind, word in ((Figure, "Figure"), (Table, "Table")):
        named = [block.name for block in blocks if isinstance(block, kind)]
        numbers |= {name: f"{word} {k}" for k, name in enumerate(named, 1)}
    parts = [_MARKDOWN[type(block)](block, numbers) for block in blocks]
    return "\n".join([f"# {title}\n", *parts])


def _tex(text):
    """Escape what is reserved outside of mathematics, and resolve references."""
    parts = re.split(r"(\$[^$]*\$)", text)
    plain = ["".join(_RESERVED.get(c, c) for c in part) for part in parts[::2]]
    parts[::2] = [re.sub(r"@([\w\\-]+)", _reference, part) for part in plain]
    return "".join(parts)


def _reference(found):
    name = found[1].replace("\\", "")
    return rf"\autoref{{{name}}}"


def _latex_text(block):
    return f"{_tex(block.text)}\n"


def _latex_figure(block):
    return (
        "\\begin{figure}[!htb]\n\\centering\n"
        f"\\includegraphics{{{block.name}.pdf}}\n\\caption{{{_tex(block.caption)}}}\n\\label{{{block.name}}}\n"
        "\\end{figure}\n"
    )


def _latex_table(block):
    columns = "l" * block.left + "r" * (len(block.head) - block.left)
    rows = [[_tex(cell) for cell in row] for row in (block.head, *block.rows)]
    head, *body = (" & ".join(row) + r" \\" for row in rows)
    lines = ["\\toprule", head, "\\midrule", *body, "\\bottomrule"]
    return (
        f"\\begin{{table}}[!htb]\n\\centering\\footnotesize\\setlength{{\\tabcolsep}}{{4pt}}\n\\caption{{{_tex(block.caption)}}}\n\\label{{{block.name}}}\n"
        f"\\begin{{tabular}}{{@{{}}{columns}@{{}}}}\n"
        + "\n".join(lines)
        + "\n\\end{tabular}\n\\end{table}\n"
    )


def _markdown_text(block, numbers):
    return re.sub(r"@([\w-]+)", lambda found: numbers[found[1]], block.text) + "\n"


def _markdown_figure(block, numbers):
    return f"![{block.name}]({block.name}.png)\n\n*{numbers[block.name]}.* {_plain(block.caption, numbers)}\n"


def _markdown_table(block, numbers):
    marks = [":---"] * block.left + ["---:"] * (len(block.head) - block.left)
    lines = "".join(f"| {' | '.join(row)} |\n" for row in (block.head, marks, *block.rows))
    return f"*{numbers[block.name]}.* {_plain(block.caption, numbers)}\n\n{lines}"


def _plain(text, numbers):
    return _markdown_text(Text(text), numbers).rstrip()


_LATEX = {Text: _latex_text, Figure: _latex_figure, Table: _latex_table}
_MARKDOWN = {Text: _markdown_text, Figure: _markdown_figure, Table: _markdown_table}
