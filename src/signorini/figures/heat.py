"""Tables of numbers on a coloured ground."""

import matplotlib

from signorini.figures.style import ACCENT, BLACK

FAINT_BLUES = matplotlib.colors.LinearSegmentedColormap.from_list("faint", [ACCENT, "white"])
WHITE_ON = 0.35  # of the range: below, the ground is so dark that text is white


def draw_heat(axes, values, texts, limits):
    """Draw a table of numbers, the ground of each the darker the smaller it is.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    values : sequence of sequence of float
        Rows; NaN has no ground.
    texts : sequence of sequence of str
        What is written in place of the values.
    limits : (float, float)
        Values of the darkest ground and of a white one.
    """
    low, high = limits
    axes.imshow(values, cmap=FAINT_BLUES, vmin=low, vmax=high, aspect="auto")
    threshold = WHITE_ON * high + (1 - WHITE_ON) * low
    for i, row in enumerate(texts):
        for j, text in enumerate(row):
            colour = "white" if values[i][j] < threshold else BLACK
            axes.text(j, i, text, ha="center", va="center", fontsize=6.5, color=colour)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(True)


def name_rows_and_columns(axes, rows, columns):
    """Write the names of rows and columns beside a table.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    rows, columns : sequence of str
        Empty text where a name would only repeat that of the table beside.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> axes = Figure().subplots()
    >>> name_rows_and_columns(axes, ["P1", "CR"], ["white"])
    >>> [label.get_text() for label in axes.get_yticklabels()]
    ['P1', 'CR']
    """
    axes.set_xticks(
        range(len(columns)),
        columns,
        rotation=40,
        ha="right",
        rotation_mode="anchor",
    )
    axes.set_yticks(range(len(rows)), rows)
