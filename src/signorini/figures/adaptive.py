"""Figures of the adaptive study: bounds against unknowns and time, and meshes."""

import math

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import NullFormatter

from signorini.figures.style import (
    ACCENT,
    BLACK,
    ELEMENT_STYLES,
    FAINT,
    GREY,
    STYLE,
    TEXT_WIDTH,
    new_figure,
)

SMALL = STYLE | {"font.size": 8, "axes.labelsize": 8, "lines.markersize": 3}
# (element, run) -> how its guaranteed error is drawn; the true error, where known, is a thin line.
_RUNS = {
    "adaptive": {"linestyle": "-"},
    "uniform": {"linestyle": "--", "markerfacecolor": "white"},
}
_STYLES = {
    (element, run): {"color": own["color"], "marker": own["marker"]} | style
    for element, own in ELEMENT_STYLES.items()
    for run, style in _RUNS.items()
}
_TRUE = {"color": GREY, "linewidth": 0.7, "linestyle": ":", "marker": "none"}
_COLUMNS = 3


@matplotlib.rc_context(SMALL)
def draw_bounds(curves, label, optimal=False):
    """Draw guaranteed errors against a cost, a panel for each scene.

    Parameters
    ----------
    curves : dict
        Scene -> (element, run) -> costs, guaranteed errors, true errors; lists, the last of None
        where the solution is not known.
    label : str
        Of the cost.
    optimal : bool
        Whether to draw the optimal slope of affine elements, for costs that are unknowns.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure, panels = _panels(len(curves), 0.31, legend=0.2)
    for axes, (scene, of_scene) in zip(panels, curves.items(), strict=False):
        for key, (cost, bounds, errors) in of_scene.items():
            axes.loglog(cost, bounds, label=" ".join(key), **_STYLES[key])
            if None not in errors:
                axes.loglog(cost, errors, **_TRUE)
        if optimal:
            _draw_optimal(axes, *of_scene["P1", "adaptive"][:2])
        axes.set_title(scene, fontsize=8)
        axes.set_xlabel(label, labelpad=1)
        _show_decades(axes, of_scene.values())
    for axes in panels[::_COLUMNS]:
        axes.set_ylabel("guaranteed error")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=4, handlelength=2.6)
    return figure


def _show_decades(axes, curves):
    """Let both axes run over whole decades, labelled at those alone."""
    values = [[value for curve in curves for value in curve[k]] for k in (0, 1)]
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


def _panels(count, share, legend=0.0):
    """A figure with a panel for each scene, three in a row, and room for a legend above them."""
    rows = -(-count // _COLUMNS)
    height = share * rows * TEXT_WIDTH + legend
    figure = new_figure(TEXT_WIDTH, height)
    grid = figure.subplots(rows, _COLUMNS, squeeze=False)
    margins = {"bottom": 0.36 / height, "top": 1 - (0.22 + legend) / height}
    figure.subplots_adjust(left=0.09, right=0.98, wspace=0.3, hspace=0.42, **margins)
    panels = grid.ravel().tolist()
    for axes in panels[count:]:
        axes.axis("off")
    return figure, panels[:count]
