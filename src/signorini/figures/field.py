"""A solution on any domain: filled contours of u, the boundary, and where the constraint binds."""

import matplotlib
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import MaxNLocator

from signorini.figures.frame import Frame
from signorini.figures.style import ACCENT, BLACK, CRITICAL, STYLE, TEXT_WIDTH, add_axes, new_figure
from signorini.figures.units import STEPS, plain, tidy_ticks, unit_exponent, with_unit

# From paper to brown in steps of about equal length in CIELAB, lightness falling all the way: it
# also reads in grey, and black and ACCENT stand out on all of it.
COLOURS = LinearSegmentedColormap.from_list(
    "sand", ["#fdf5ed", "#efdcc6", "#e0c3a0", "#cea97b", "#ba8d58", "#a26f37", "#87521c"]
)
BANDS = 9  # of colour, at most
FLAT = 1e-9  # a range of u this small against u is drawn as a constant
MOST_BAR_TICKS = 7

# Widths and heights in inches. From the bottom up: the legend; ticks and names of the axes; the
# domain, in the middle of a square that is left out where it is not filled; the title:
#
#            title
#          +-------+   |c|
#     ticks| domain|   |o|  bar of colours
#          +-------+   |l|
#            ticks
#           legend
WIDTH = 0.8 * TEXT_WIDTH  # of the figure
BOX = 2.9  # side of the square in which a domain must fit
LEFT, BOTTOM, TOP = 0.62, 0.46, 0.25  # margins
APART = 7  # points between the numbers of an upright label's axis and the label
LEGEND, TITLE = 0.38, 0.24  # below and above them
BAR, LEAST_BAR, BAR_GAP = 0.1, 1.0, 0.25  # width, least height, and distance from the domain

BOUNDARY = {
    "dirichlet": ("Dirichlet", {"color": BLACK, "linewidth": 0.8}),
    "neumann": ("Neumann", {"color": BLACK, "linewidth": 0.8, "linestyle": (0, (4, 3))}),
    "contact": ("contact", {"color": ACCENT, "linewidth": 2}),
    "binding": ("contact, binding", {"color": BLACK, "linewidth": 2.8}),
}
_JOINTS = {"solid_joinstyle": "round", "solid_capstyle": "butt"}


@matplotlib.rc_context(STYLE)
def draw_field(field, title=""):
    """Draw u as filled contours over a domain of any shape and size.

    The contours of CR, which jumps across facets, are drawn on every triangle by itself.

    Parameters
    ----------
    field : mapping of str to ndarray
        What `signorini.report.field.field_of` returns.
    title : str, optional
        Plain text above the figure.

    Returns
    -------
    matplotlib.figure.Figure
    """
    frame = Frame(field["p"])
    width, height = frame.fit(BOX)
    bar = max(height, LEAST_BAR)
    bottom, left = LEGEND + BOTTOM, LEFT + (BOX - width) / 2
    head = TOP + (TITLE if title else 0)
    page_height = LEGEND + BOTTOM + bar + head
    figure = new_figure(WIDTH, page_height)
    axes = add_axes(figure, left, bottom + (bar - height) / 2, width, height)
    contours, exponent = paint(axes, field, frame)
    _label(axes, frame)
    colours = add_axes(figure, left + width + BAR_GAP, bottom, BAR, bar)
    _draw_bar(figure, colours, contours, with_unit("$u$", exponent))
    figure.legend(
        loc="lower center",
        ncols=3,
        handlelength=2.4,
        columnspacing=1.6,
        borderaxespad=0.2,
    )
    if title:
        y = 1 - TOP / page_height
        figure.text(0.5, y, title, ha="center", va="bottom", **plain(title))
    return figure


def _label(axes, frame):
    width, height = frame.fit(BOX)
    axes.set_xlabel(frame.label(0, "x") + ("" if frame.to_scale else ", not to scale"))
    name = frame.label(1, "y")
    upright = {"rotation": 0, "ha": "right", "labelpad": APART} if name == "$y$" else {}
    axes.set_ylabel(name, **upright)
    tidy_ticks(axes.xaxis, width)
    tidy_ticks(axes.yaxis, height)


def _draw_bar(figure, axes, contours, label):
    bar = figure.colorbar(contours, cax=axes)
    axes.set_title(label, fontsize=9, pad=6)
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(length=2, width=0.5)
    ticks = _bar_ticks(contours.levels)
    bar.set_ticks(ticks, labels=[f"${tick:.4g}$" for tick in ticks])
    bar.ax.minorticks_off()


def _bar_ticks(levels):
    """Some of the levels, 0 among them if it is one; the value itself of a constant."""
    if len(levels) == 2:
        return [levels.mean()]
    every = -(-len(levels) // MOST_BAR_TICKS)
    nearest_to_zero = np.argmin(np.abs(levels))
    return levels[nearest_to_zero % every :: every]


def paint(axes, field, frame, thickness=1.0):
    """Fill `axes` with contours, boundary and critical points.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    field : mapping of str to ndarray
        See `draw_field`.
    frame : Frame
    thickness : float, optional
        Of lines and markers, relative to those of a figure of its own.

    Returns
    -------
    contours : matplotlib.tri.TriContourSet
    exponent : int
        The contours' numbers count units of ``10**exponent``.
    """
    exponent = unit_exponent(field["range"])
    contours = _draw_contours(axes, field, frame, 10.0**exponent, thickness)
    draw_boundary(axes, field, frame, thickness)
    _draw_turns(axes, field["by_turns"], frame, thickness)
    _draw_critical_points(axes, field, frame, thickness)
    axes.set(xlim=(frame.low[0], frame.high[0]), ylim=(frame.low[1], frame.high[1]))
    for side in ("left", "bottom"):
        axes.spines[side].set_position(("outward", 5))
    return contours, exponent


def _draw_contours(axes, field, frame, unit, thickness):
    values = field["values"] / unit
    levels = _levels(*(field["range"] / unit).tolist())
    x, y = frame.place(field["p"])[:, field["t"].ravel()]
    corners = np.arange(values.size).reshape(3, -1).T  # of each triangle by itself
    # The last band is open above.
    heights = np.clip(values.ravel(), levels[0], np.nextafter(levels[-1], -np.inf))
    bands = {"cmap": COLOURS, "antialiased": False, "zorder": 1}
    contours = axes.tricontourf(x, y, corners, heights, levels, **bands)
    contours.set_rasterized(True)  # the many triangles would show their seams, and weigh
    if len(levels) > 2:
        lines = {
            "colors": BLACK,
            "linewidths": 0.3 * thickness,
            "linestyles": "solid",
            "zorder": 2,
        }
        axes.tricontour(x, y, corners, heights, levels[1:-1], **lines)
    return contours


def _levels(low, high):
    """Round numbers from `low` to `high`, which a tenth of a band may exceed."""
    if high - low <= FLAT * max(abs(low), abs(high)):
        margin = 0.5 * max(abs(low), 1.0)
        return np.array([low - margin, low + margin])
    levels = MaxNLocator(BANDS, steps=STEPS).tick_values(low, high)
    slack = 0.9 * (levels[1] - levels[0])
    inner = levels[(levels > low - slack) & (levels < high + slack)]
    return inner if len(inner) > 1 else levels


def draw_boundary(axes, field, frame, thickness=1.0):
    """Draw the boundary, each part in its style, and where the constraint binds.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    field : mapping of str to ndarray
        ``p``; ``edges_dirichlet``, ``edges_neumann`` and ``edges_contact``; ``binding``.
    frame : Frame
    thickness : float, optional
        See `paint`.
    """
    pieces = {
        label: field["p"][:, field[f"edges_{label}"]].transpose(2, 1, 0)
        for label in ("dirichlet", "neumann", "contact")
    }
    pieces["binding"] = field["binding"]
    for order, (name, of_part) in enumerate(pieces.items()):
        if not len(of_part):
            continue
        label, style = BOUNDARY[name]
        style = style | {"linewidth": thickness * style["linewidth"]} | _JOINTS
        points = frame.place(_polyline(of_part).T)
        axes.plot(*points, label=label, zorder=3 + order, clip_on=False, **style)


def _polyline(pieces):
    """Points (k, 2) of a line through `pieces` (m, 2, 2), with NaN between those that do not join.

    ::

        a--b, b--c, d--e   becomes   a, b, c, NaN, d, e
    """
    joins = np.all(pieces[1:, 0] == pieces[:-1, 1], axis=1)
    runs = np.split(pieces, np.flatnonzero(~joins) + 1)
    lines = [np.append(run[:, 0], run[-1:, 1], axis=0) for run in runs]
    gap = np.full((1, 2), np.nan)
    return np.concatenate([part for line in lines for part in (line, gap)][:-1])


def style_of_turns(thickness=1.0):
    """Options of a line where contact and gaps alternate: white within black.

    Parameters
    ----------
    thickness : float, optional
        See `paint`.

    Returns
    -------
    dict
    """
    outer = thickness * CRITICAL["markersize"]
    return {
        "color": "white",
        "linewidth": 0.6 * outer,
        "path_effects": [Stroke(linewidth=outer, foreground=BLACK), Normal()],
        "solid_joinstyle": "round",
        "solid_capstyle": "round",
        "label": "alternating contact",
    }


def _draw_turns(axes, pieces, frame, thickness):
    """Intervals where contact and gaps alternate: as the marker of a critical point, drawn out."""
    if not len(pieces):
        return
    points = frame.place(_polyline(pieces).T)
    axes.plot(*points, zorder=7, clip_on=False, **style_of_turns(thickness))


def _draw_critical_points(axes, field, frame, thickness):
    points = field["critical_points"]
    if not len(points):
        return
    marker = CRITICAL | {"markersize": thickness * CRITICAL["markersize"]}
    x, y = frame.place(points.T)
    axes.plot(x, y, "o", label="critical point", zorder=7, clip_on=False, **marker)
