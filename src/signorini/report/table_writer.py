"""A table, described once, and written in Markdown; `table_latex` writes it in LaTeX."""

from dataclasses import dataclass, replace

# All characters that LaTeX reserves.
ESCAPES = {c: f"\\{c}" for c in "&%$#_{}"} | {"\\": r"\textbackslash{}", "~": r"\~{}", "^": r"\^{}"}


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
class Column:
    """A column of a table.

    Parameters
    ----------
    title : Title
    cells : tuple of str
        Plain text: numbers, with or without exponent, and marks behind them.
    foot : str, optional
        What stands below the rule.
    """

    title: Title
    cells: tuple
    foot: str = ""


@dataclass(frozen=True)
class Group:
    """Columns under one title."""

    title: Title
    columns: tuple


@dataclass(frozen=True)
class Table:
    """A table of numbers: leading columns, which say what a row is, then groups of columns.

    Parameters
    ----------
    leading : sequence of Column
    groups : sequence of Group
    notes : sequence of str, optional
        Lines under the table, plain text.
    has_foot : bool, optional
        Whether the foots of the columns are a row.
    side_by_side : int, optional
        Groups beside each other in LaTeX, before the table goes on below; where it is None, as many
        as the lines hold.
    """

    leading: tuple
    groups: tuple
    notes: tuple = ()
    has_foot: bool = True
    side_by_side: int | None = None

    @property
    def columns(self):
        """All columns in their order."""
        return [*self.leading, *(column for group in self.groups for column in group.columns)]

    @property
    def rows(self):
        """Rows of cells."""
        return list(zip(*(column.cells for column in self.columns), strict=True))

    @property
    def feet(self):
        """Rows below the rule, one or none."""
        return [[column.foot for column in self.columns]] * self.has_foot

    def blocks(self, count):
        """The table cut into tables of at most so many groups each.

        Examples
        --------
        >>> groups = [Group(Title(name, name), ()) for name in "abc"]
        >>> [len(block.groups) for block in Table((), groups).blocks(2)]
        [2, 1]
        """
        starts = range(0, len(self.groups), count)
        return [replace(self, groups=self.groups[k : k + count]) for k in starts]


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
    >>> levels = Column(Title("$N$", "N"), ("2",), "slope")
    >>> energy = Group(Title("$E$", "energy"), (Column(Title("CF", "CF"), ("0.5",), "--*"),))
    >>> print(markdown(Table((levels,), (energy,))), end="")
    | N | energy CF |
    | ---: | ---: |
    | 2 | 0.5 |
    | slope | --* |
    """
    header = [column.title.markdown for column in table.leading]
    for group in table.groups:
        header += [f"{group.title.markdown} {column.title.markdown}" for column in group.columns]
    rows = [header, ["---:"] * len(header), *table.rows, *table.feet]
    lines = [f"| {' | '.join(row)} |\n" for row in rows]
    notes = [text.replace("*", r"\*") for text in table.notes]
    return "".join(lines) + "".join(f"\n{text}\n" for text in notes)
