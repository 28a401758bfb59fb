r"""One description of a page, rendered to Markdown and to LaTeX.

A page is a Jinja2 template in a light markup::

    # Title
    ## Heading

    A paragraph with $mathematics$, `code`, *emphasis*, a [link](file.csv), a number
    {{ found.seconds|seconds }}, and a reference to @name.

    $$displayed mathematics$$

    {% call figure("name") %} The caption of the files name.pdf and name.png. {% endcall %}

    {% call table("name") %}
    The caption.

    | word | number |
    | :--- | ---: |
    {% for row in rows %}
    | {{ row.name|cell }} | {{ row.size|formatted(".2f") }} |
    {% endfor %}
    {% endcall %}

A line that does not start with a bar continues the row before; a row of one cell is a heading
within the table. Rows may also come as a `Table`, as in
``table("name", rows)``; its other fields are keywords. The variable ``latex`` says which of the two
it is rendered to. LaTeX has no links. It needs booktabs, graphicx and hyperref.
"""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import jinja2

from signorini.report import quantities
from signorini.report.markup import alternative, latex_text, markdown_text
from signorini.report.rounding import percent

LAYOUTS = {"markdown": "report/document.md.j2", "latex": "report/document.tex.j2"}
_LIBRARY = Path(__file__).parents[1]
_PIPE = re.compile(r"(?<!\\)\|")
_INLINE = {"markdown": markdown_text, "latex": latex_text}


@dataclass(frozen=True)
class Table:
    """Cells of text in the markup of pages.

    Parameters
    ----------
    header : sequence of str
    rows : sequence of sequence
        A row of one cell is a heading within the table.
    groups : sequence of (str, int), optional
        Titles above so many columns each, of all columns; an empty title is none.
    left : int, optional
        So many columns are words, aligned left; the others are numbers.
    sentences : bool, optional
        Whether the first column holds sentences, which LaTeX is to break into lines.

    Examples
    --------
    >>> Table(("solver", "time"), [("BVLS", "3.0 s")], left=1).width
    2
    """

    header: tuple
    rows: list
    groups: tuple = ()
    left: int = 1
    sentences: bool = False

    @property
    def width(self):
        """Number of columns."""
        return len(self.header)

    @property
    def titled_header(self):
        """The header in one line: the title of its group before each cell."""
        titles = [title for title, span in self.groups for _ in range(span)] or [""] * self.width
        pairs = zip(titles, self.header, strict=True)
        return [f"{title} {cell}".strip() for title, cell in pairs]

    @property
    def rules(self):
        """First and last column under each title of a group, counted from 1."""
        ends = [sum(span for _, span in self.groups[: k + 1]) for k in range(len(self.groups))]
        spans = zip(self.groups, ends, strict=True)
        return [(end - span + 1, end) for (title, span), end in spans if title]


@dataclass
class Block:
    """A part of a page: ``kind`` is section, subsection, paragraph, figure or table."""

    kind: str
    text: str
    name: str = ""
    number: int = 0
    table: Table | None = None


def render(template, layout, **slots):
    """Fill the slots of a page and render it.

    Parameters
    ----------
    template : str
        File in the folder of the library, such as ``studies/benchmark/page.md.j2``.
    layout : {"markdown", "latex"}
    **slots
        What the template names: numbers, text, `Table` objects.

    Returns
    -------
    str
        A Markdown page, or a LaTeX fragment that starts with its section.

    Raises
    ------
    jinja2.UndefinedError
        If a slot is missing.
    KeyError
        If a text refers to no figure or table of the page.
    """
    page = environment().get_template(template)
    return _render(page, layout, slots)


def render_text(text, layout, **slots):
    r"""Fill the slots of a template given as text and render it.

    Parameters
    ----------
    text : str
        The template.
    layout, **slots
        As for `render`.

    Returns
    -------
    str

    Raises
    ------
    jinja2.UndefinedError, KeyError
        As for `render`.

    Examples
    --------
    >>> print(render_text("# Costs & times\n\n{{ t|seconds }}, 2e-14 *wasted*", "latex", t=0.0021))
    \section{Costs \& times}
    <BLANKLINE>
    2.1 ms, $2\times10^{-14}$ \emph{wasted}
    <BLANKLINE>
    \clearpage
    <BLANKLINE>
    """
    return _render(environment().from_string(text), layout, slots)


def _render(page, layout, slots):
    floats = {}
    text = page.render(slots, latex=layout == "latex", **_float_makers(floats))
    parts = re.split(r"\n\s*\n", text.strip())
    blocks = [floats.get(part.strip()) or _block(" ".join(part.split())) for part in parts]
    known = {block.name: block for block in floats.values()}

    def inline(cell):
        return _INLINE[layout](str(cell), known)

    macros = (
        environment()
        .get_template(LAYOUTS[layout])
        .make_module({"inline": inline, "alternative": alternative})
    )
    shown = [getattr(macros, block.kind)(block).rstrip() for block in blocks]
    return "\n\n".join(shown) + "\n" + macros.end


def _float_makers(floats):
    """Functions for ``{% call %}``: each keeps a block and leaves its mark in the text."""

    def add(kind, name, caption, table=None):
        number = 1 + sum(block.kind == kind for block in floats.values())
        mark = f"[{kind} {name}]"
        floats[mark] = Block(kind, " ".join(caption.split()), name, number, table)
        return f"\n\n{mark}\n\n"

    def figure(name, caller):
        return add("figure", name, caller())

    def table(name, rows=None, *, caller, **form):
        caption, bar, rows_text = caller().partition("\n|")
        return add("table", name, caption, rows or _piped_table(bar + rows_text, form))

    return {"figure": figure, "table": table}


def _piped_table(text, form):
    rows = [" ".join(row.split())[:-1] for row in text.split("\n|")[1:]]
    cells = [[cell.strip().replace(r"\|", "|") for cell in _PIPE.split(row)] for row in rows]
    header, marks, *body = cells
    left = sum(not mark.endswith(":") for mark in marks)
    return Table(header, body, left=left, **form)


def _block(text):
    for mark, kind in (("# ", "section"), ("## ", "subsection")):
        if text.startswith(mark):
            return Block(kind, text.removeprefix(mark))
    return Block("paragraph", text)


@cache
def environment():
    """Where templates are found, with the filters of `quantities`; a `jinja2.Environment`."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_LIBRARY),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= quantities.FILTERS | {"percent": percent}
    return environment
