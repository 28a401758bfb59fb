"""Figures of the adaptive study: bounds against unknowns and time, and meshes."""

import math

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import NullFormatter

from signorini.figures.style import ACCENT, BLACK, FAINT, GREY, STYLE, TEXT_WIDTH, new_figure

SMALL = STYLE | {"font.size": 8, "axes.labelsize": 8, "lines.markersize": 3}
_ADAPTIVE = {"color": ACCENT, "marker": "s", "linestyle": "-"}
_UNIFORM = {"color": BLACK, "marker": "o", "markerfacecolor": "white", "linestyle": "--"}
_COLUMNS = 3


@matplotlib.rc_context(SMALL)
def draw_bounds(runs, column, label):
    """Draw the guaranteed error of P1 against a cost, a panel for each scene.

    Parameters
    ----------
    runs : dict
        Scene -> (adaptive, uniform), each a pair of lists: costs and bounds.
    column : {"dofs", "seconds"}
        What the cost is; the optimal slope is drawn for unknowns.
    label : str
        Of the cost.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure, panels = _panels(len(runs), 0.31)
    for axes, (scene, pair) in zip(panels, runs.items(), strict=False):
        for (cost, bounds), style in zip(pair, (_ADAPTIVE, _UNIFORM), strict=True):
            axes.loglog(cost, bounds, **style)
        if column == "dofs":
            _draw_optimal(axes, *pair[0])
        axes.set_title(scene, fontsize=8)
        axes.set_xlabel(label, labelpad=1)
        _show_decades(axes, pair)
    for axes in panels[::_COLUMNS]:
        axes.set_ylabel("guaranteed error")
    panels[0].legend(["adaptive", "uniform"], fontsize=7, loc="lower left")
    return figure


def _show_decades(axes, pair):
    """Let both axes run over whole decades, labelled at those alone."""
    values = [[value for curve in pair for value in curve[k]] for k in (0, 1)]
    limits = axes.set_xlim, axes.set_ylim
    for axis, shown, set_limits in zip((axes.xaxis, axes.yaxis), values, limits, strict=True):
        exponents = [math.log10(value) for value in shown]
        set_limits(10.0 ** math.floor(min(exponents)), 10.0 ** math.ceil(max(exponents)))
        axis.set_minor_formatter(NullFormatter())


def _draw_optimal(axes, dofs, bounds):
    """A line of slope -1/2 below the adaptive bounds."""
    first, last = dofs[0], dofs[-1]
    least = min(bound * math.sqrt(n) for n, bound in zip(dofs, bounds, strict=True))
    ends = [0.6 * least / math.sqrt(n) for n in (first, last)]
    axes.loglog([first, last], ends, color=FAINT, linewidth=1.2, zorder=0)


@matplotlib.rc_context(SMALL)
def draw_meshes(pictures):
    """Draw a mesh of each scene with its contact set.

    Parameters
    ----------
    pictures : dict
        Scene -> what `signorini.adapt.record.picture_of` returns.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure, panels = _panels(len(pictures), 0.34)
    for axes, (scene, picture) in zip(panels, pictures.items(), strict=False):
        x, y = picture["p"]
        axes.triplot(x, y, picture["t"].T, color=GREY, linewidth=0.2)
        _draw_facets(axes, picture["contact"], ACCENT, 2.0)
        _draw_facets(axes, picture["binding"], BLACK, 2.6)
        axes.set_title(scene, fontsize=8)
        axes.set_aspect("equal")
        axes.axis("off")
    return figure


def _draw_facets(axes, ends, colour, width):
    """Segments (2, 2, k): axis, end, facet."""
    segments = np.moveaxis(ends, (0, 1, 2), (2, 1, 0))
    axes.add_collection(LineCollection(segments, colors=colour, linewidths=width))


def _panels(count, share):
    """A figure with a panel for each scene, three in a row; those left over are hidden."""
    rows = -(-count // _COLUMNS)
    height = share * rows * TEXT_WIDTH
    figure = new_figure(TEXT_WIDTH, height)
    grid = figure.subplots(rows, _COLUMNS, squeeze=False)
    margins = {"bottom": 0.36 / height, "top": 1 - 0.22 / height}
    figure.subplots_adjust(left=0.09, right=0.99, wspace=0.3, hspace=0.42, **margins)
    panels = grid.ravel().tolist()
    for axes in panels[count:]:
        axes.axis("off")
    return figure, panels[:count]
