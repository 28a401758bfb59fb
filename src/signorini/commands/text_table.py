"""Tables for a terminal."""


def text_table(rows, columns):
    """Rows as text, a heading first, columns aligned at the right.

    Parameters
    ----------
    rows : sequence of mapping
    columns : sequence of str
        Those of the rows that are shown.

    Returns
    -------
    str

    Examples
    --------
    >>> print(text_table([{"n": 8, "error": 0.01}, {"n": 16, "error": None}], ["n", "error"]))
     n       error
     8  1.0000e-02
    16
    """
    cells = [list(columns), *([_cell(row[name]) for name in columns] for row in rows)]
    widths = [max(len(line[k]) for line in cells) for k in range(len(columns))]
    lines = (
        "  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True))
        for line in cells
    )
    return "\n".join(line.rstrip() for line in lines)


def _cell(value):
    if isinstance(value, float):
        return f"{value:.4e}"
    return "" if value is None else str(value)
