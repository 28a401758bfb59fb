"""Panels of coloured tiles: a row for each way to cut the cells, with its picture."""

from signorini.figures.style import BLACK, GREY, add_axes

DIAGONALS = {
    "falling": "falling",
    "rising": "rising",
    "alternating": "alternating\n(falling)",
    "alternating-rising": "alternating\n(rising)",
    "criss-cross": "criss-cross",
}

# Inches.
LABELS = 1.08  # left of the panels
GAP = 0.1  # between panels
PICTURE, PICTURE_SHARE = 0.24, 0.75  # side of a row at most, and how much of it the picture fills
PICTURE_GAP, NAME_GAP = 0.07, 0.13  # between picture and panel, name and picture (and panel)

# Ends (x, y) of the line that cuts a cell.
_CUTS = {"/": ((0, 1), (0, 1)), "\\": ((0, 1), (1, 0))}
# Of two cells in a row.
_FIRST_CUTS = {
    "falling": "\\\\",
    "rising": "//",
    "alternating": "\\/",
    "alternating-rising": "/\\",
}


def add_panel(figure, place, diagonals, named):
    """Add axes whose unit squares are tiles, the first diagonal on top.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    place : (float, float, float, float)
        Left, bottom, width and height, in inches.
    diagonals : sequence of str
        One for each row.
    named : bool
        Whether names and pictures of the diagonals stand on the left.

    Returns
    -------
    matplotlib.axes.Axes
    """
    axes = add_axes(figure, *place)
    axes.set(xlim=(0, 1), ylim=(len(diagonals), 0), xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0, pad=1)
    if named:
        _name_rows(figure, place, diagonals)
    return axes


def _name_rows(figure, place, diagonals):
    left, bottom, _, height = place
    page_width, page_height = figure.get_size_inches()
    side = PICTURE_SHARE * min(height / len(diagonals), PICTURE)
    for y, diagonal in enumerate(diagonals):
        middle = bottom + height - (y + 0.5) * height / len(diagonals)
        _draw_cells(figure, left - side - PICTURE_GAP, middle - side / 2, side, diagonal)
        figure.text(
            (left - side - NAME_GAP) / page_width,
            middle / page_height,
            DIAGONALS.get(diagonal, diagonal),
            ha="right",
            va="center",
            fontsize=7,
        )


def _draw_cells(figure, left, bottom, side, diagonal):
    """Draw two by two cells, cut as the diagonal says, at a place in inches."""
    axes = add_axes(figure, left, bottom, side, side)
    axes.set(xlim=(0, 2), ylim=(0, 2), xticks=[], yticks=[])
    axes.spines[:].set(visible=True, linewidth=0.5)
    for k in (0, 1):
        axes.plot([1, 1], [k, k + 1], [k, k + 1], [1, 1], color=GREY, linewidth=0.4)
        for m in (0, 1):
            for x, y in _cuts(diagonal, k, m):
                axes.plot([k + a for a in x], [m + b for b in y], color=BLACK, linewidth=0.6)


def _cuts(diagonal, column, row):
    """The lines that cut a cell of a pattern."""
    if diagonal == "criss-cross":
        return [_CUTS["/"], _CUTS["\\"]]
    return [_CUTS[_FIRST_CUTS[diagonal][(column + row) % 2]]]


def draw_tile(axes, x, y, colour):
    """Fill a unit square, and let the axes reach over it.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    x, y : int
        Its corner of least coordinates.
    colour : tuple of float
        Red, green, blue and opacity.
    """
    axes.set_xlim(0, max(axes.get_xlim()[1], x + 1))
    axes.fill(
        [x, x + 1, x + 1, x],
        [y, y, y + 1, y + 1],
        facecolor=colour,
        edgecolor="white",
        linewidth=1,
    )


def write_on_tile(axes, x, y, text, *, size, dark):
    """Write text on a tile, centred at a point.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    x, y : float
    text : str
    size : float
        Of the letters, in points.
    dark : bool
        Whether the tile is so dark that the text must be white.
    """
    axes.text(
        x,
        y,
        text,
        ha="center",
        va="center",
        fontsize=size,
        color="white" if dark else BLACK,
    )
