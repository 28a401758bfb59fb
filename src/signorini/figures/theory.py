"""Figures of the theory study: constants against h, contact terms against h, and traces."""

import matplotlib

from signorini.figures.style import ACCENT, BLACK, GREY, STYLE, TEXT_WIDTH, new_figure

SMALL = STYLE | {"font.size": 8, "axes.labelsize": 8, "legend.fontsize": 7, "lines.markersize": 3}
_SCENE_STYLES = (
    {"color": BLACK, "marker": "o", "linestyle": "-"},
    {"color": ACCENT, "marker": "s", "linestyle": "--"},
    {"color": GREY, "marker": "^", "linestyle": "-."},
    {"color": BLACK, "marker": "D", "linestyle": ":", "markerfacecolor": "white"},
)
_LABELS, _TITLE = 0.42, 0.22  # inches below and above the panels
_SHOWN = 1e-5  # of the largest value: what is smaller is left out
_TERMS = {"D1": "$|D_1| / E^2$", "D2": "$|D_2| / E^2$", "A": "$|A| / E^2$"}


@matplotlib.rc_context(SMALL)
def draw_estimates(rows):
    """Draw the smallest constant of each statement against h, a panel for each.

    Parameters
    ----------
    rows : list of dict
        ``scene``, ``statement``, ``h`` and ``constant``, the last two numbers.

    Returns
    -------
    matplotlib.figure.Figure
    """
    statements = list(dict.fromkeys(row["statement"] for row in rows))
    figure, panels = _panels(len(statements) + 1, columns=4)
    for axes, statement in zip(panels, statements, strict=False):
        shown = [row for row in rows if row["statement"] == statement]
        _draw_lines(axes, shown, "constant")
        axes.set_title(statement, fontsize=8)
    _name_scenes(panels[-1], rows)
    return figure


@matplotlib.rc_context(SMALL)
def draw_terms(rows):
    """Draw the contact terms of equation (4.10) against h, relative to the squared error.

    Parameters
    ----------
    rows : list of dict
        ``scene``, ``h``, ``error``, ``D1``, ``D2`` and ``A``; all but the first numbers.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure, panels = _panels(len(_TERMS) + 1, columns=4)
    for axes, (term, title) in zip(panels, _TERMS.items(), strict=False):
        shares = [row | {"share": abs(row[term]) / row["error"] ** 2} for row in rows]
        _draw_lines(axes, shares, "share")
        axes.set_title(title, fontsize=8)
    _name_scenes(panels[-1], rows)
    return figure


@matplotlib.rc_context(SMALL)
def draw_traces(rows):
    """Draw the constant of (3.6) against the number of cosines, a line for each edge length.

    Parameters
    ----------
    rows : list of dict
        ``statement``, ``space``, ``size``, ``h`` and ``constant``, the last three numbers.

    Returns
    -------
    matplotlib.figure.Figure
    """
    shown = [row for row in rows if row["statement"] == "(3.6)"]
    widths = list(dict.fromkeys(row["h"] for row in shown))
    figure = new_figure(TEXT_WIDTH, 0.42 * TEXT_WIDTH)
    axes = figure.add_axes((0.1, 0.17, 0.62, 0.78))
    for style, h in zip(_SCENE_STYLES, widths, strict=False):
        points = [row for row in shown if row["h"] == h and row["space"] == "cosines"]
        axes.semilogx(*_columns(points), label=f"$h = 1/{round(1 / h)}$", **style)
    functions = [row for row in shown if row["space"] == "v_m"]
    crosses = {"marker": "x", "markersize": 7, "color": BLACK, "linestyle": "none"}
    axes.semilogx(*_columns(functions), label="the functions $v_m$", **crosses)
    axes.set_xlabel("cosines")
    axes.set_ylabel("constant of (3.6)")
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return figure


def _columns(rows):
    return [row["size"] for row in rows], [row["constant"] for row in rows]


def _panels(count, columns):
    """A figure with room for so many panels."""
    rows = -(-count // columns)
    height = 0.3 * rows * TEXT_WIDTH
    figure = new_figure(TEXT_WIDTH, height)
    grid = figure.subplots(rows, columns, squeeze=False)
    margins = {"bottom": _LABELS / height, "top": 1 - _TITLE / height}
    figure.subplots_adjust(left=0.07, right=0.99, wspace=0.45, hspace=0.5, **margins)
    return figure, grid.ravel().tolist()


def _draw_lines(axes, rows, quantity):
    """A line for each scene over h; values of zero have no place on the axis.

    What varies by less than a decade is drawn over zero, so that a constant looks like one.
    """
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    values = [row[quantity] for row in rows if row[quantity] > 0]
    for style, scene in zip(_SCENE_STYLES, scenes, strict=False):
        points = [row for row in rows if row["scene"] == scene and row[quantity] > 0]
        if points:
            h, drawn = ([row[key] for row in points] for key in ("h", quantity))
            axes.semilogx(h, drawn, **style)
    axes.set_xlabel("$h$", labelpad=1)
    if max(values) < 10 * min(values):
        axes.set_ylim(0, 1.15 * max(values))
        return
    axes.set_yscale("log")
    axes.set_ylim(max(min(values) / 2, _SHOWN * max(values)), 2 * max(values))


def _name_scenes(axes, rows):
    """The legend, in a panel of its own."""
    axes.axis("off")
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    for style, scene in zip(_SCENE_STYLES, scenes, strict=False):
        axes.plot([], [], label=scene, **style)
    axes.legend(loc="center")
