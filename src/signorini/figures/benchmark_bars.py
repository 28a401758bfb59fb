"""The time of the rivals over ours."""

import matplotlib
from matplotlib.lines import Line2D

from signorini.figures.benchmark_style import SMALL
from signorini.figures.style import ELEMENT_STYLES, GREY, MM, TEXT_WIDTH, new_figure

BAND = 0.6  # of a rival's row, which its levels share


@matplotlib.rc_context(SMALL)
def draw_rivals(rivals, titles):
    """Draw the time of the rivals over ours.

    There is a panel per route of ours, and a point per scene, element and level.

    Parameters
    ----------
    rivals : sequence of dict
        Rows of rivals.csv with numbers; those with a ratio are drawn, hollow where the rival
        failed.
    titles : dict
        Rival -> name.

    Returns
    -------
    matplotlib.figure.Figure
    """
    drawn = [row for row in rivals if row["ratio"] is not None]
    names = list(dict.fromkeys(row["rival"] for row in drawn))
    levels = sorted({row["n"] for row in drawn})
    figure, panels = _panels(drawn, names)
    for route, axes in panels.items():
        axes.axvline(1.0, color=GREY, linewidth=0.6)
        for row in drawn:
            if row["ours"] == route:
                _draw_ratio(axes, _ordinate(row, names, levels), row)
        axes.set(xscale="log", xlabel="time of the rival / ours")
        axes.set_title(f"against {route}", fontsize=7)
    first = next(iter(panels.values()))
    first.set_yticks(range(len(names)), [titles.get(name, name) for name in names])
    first.set_ylim(len(names) - 0.4, -0.6)
    _add_key(figure, drawn, levels)
    return figure


def _add_key(figure, drawn, levels):
    """What the marks mean, above the panels."""
    elements = sorted({row["element"] for row in drawn}, reverse=True)  # P1 first
    marks = {f"{element} solved": _mark(element, "solved") for element in elements}
    marks |= {f"{element} failed": _mark(element, "failed") for element in elements}
    lines = [Line2D([], [], linestyle="none", **mark) for mark in marks.values()]
    named = [f"1/{levels[0]:g}", f"1/{levels[-1]:g}"] if levels else ["", ""]
    figure.legend(
        [*lines, Line2D([], [], color=GREY, linewidth=0.6)],
        [*marks, "equal; right of it ours is faster"],
        loc="upper center",
        ncols=len(marks) + 1,
        columnspacing=1.2,
        handletextpad=0.4,
        borderaxespad=0.1,
        title="in each row, from top to bottom: $h$ = {} to {}".format(*named),
        title_fontsize=6,
    )


def _panels(drawn, names):
    """A figure with a row for each of `names`, and its axes by the route of ours."""
    routes = list(dict.fromkeys(row["ours"] for row in drawn)) or ["ours"]
    figure = new_figure(TEXT_WIDTH, (25 + 6 * len(names)) * MM)
    height = figure.get_figheight() / MM
    place = {
        "left": 0.22,
        "right": 0.99,
        "bottom": 9 / height,
        "top": 1 - 14 / height,
        "wspace": 0.05,
    }
    (row,) = figure.subplots(
        1,
        len(routes),
        squeeze=False,
        sharey=True,
        sharex=True,
        gridspec_kw=place,
    )
    return figure, dict(zip(routes, row, strict=True))


def _ordinate(row, names, levels):
    """In the row of its rival, where the levels share a band, the coarsest on top."""
    place = (levels.index(row["n"]) + 0.5) / len(levels)
    return names.index(row["rival"]) + BAND * place - BAND / 2


def _draw_ratio(axes, y, row):
    colour = ELEMENT_STYLES[row["element"]]["color"]
    axes.plot([row["ratio_min"], row["ratio_max"]], [y, y], color=colour, linewidth=0.4)
    axes.plot(row["ratio"], y, linestyle="none", **_mark(row["element"], row["status"]))


def _mark(element, status):
    style = ELEMENT_STYLES[element]
    return {
        "color": style["color"],
        "marker": style["marker"],
        "markersize": 2.2,
        "markerfacecolor": "white" if status == "failed" else style["color"],
        "markeredgewidth": 0.4,
    }
