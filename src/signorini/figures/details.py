"""What is local, drawn on the triangles: the mesh, errors, jumps of CR, parts of bounds.

Sizes that span decades are shown by their logarithm, the larger the darker. What is filled or has
many lines is a picture within the PDF; text and boundary are not.
"""

import math

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LogNorm

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.field import COLOURS, draw_boundary
from signorini.figures.frame import Frame
from signorini.figures.style import GREY, STYLE, TEXT_WIDTH, add_axes, new_figure
from signorini.figures.units import tidy_ticks

DECADES = 4  # below the largest, what is smaller is drawn as the smallest
MOST_LINES = 5000  # more are a picture within the PDF
ERROR = r"$k^{1/2}\,|\nabla(u - u_h)|$, root mean square on each triangle"
BOUND = "share in the guaranteed bound of the energy error, root mean square on each triangle"
JUMP = r"$|[u_h]|$ of CR at the ends of each facet"

# Inches. One panel or two beside each other, with one bar of colours at their right; a title
# above, ticks and, where a boundary has more parts than one, a legend below.
BOX, ALONE = 2.06, 3.2  # side of the square in which a domain must fit, of two and of one
LEFT, GAP, BOTTOM, LEGEND, TOP, TITLE = 0.66, 0.2, 0.46, 0.26, 0.1, 0.22
BAR, BAR_GAP, LEAST_BAR = 0.1, 0.2, 0.9


@matplotlib.rc_context(STYLE)
def draw_details(details):
    """Draw a figure of each kind of number that there is.

    Parameters
    ----------
    details : mapping of str to ndarray
        What `signorini.report.details.details_of` returns.

    Returns
    -------
    dict of str to matplotlib.figure.Figure
        ``mesh``; ``errors`` and ``bounds``, where there are any; ``jumps``, where there is CR.
    """
    figures = {"mesh": _draw_mesh(details)}
    for name, kind, title in (("errors", "error", ERROR), ("bounds", "bound", BOUND)):
        own = {element: details.get(f"{kind}_{element}") for element in ELEMENT_FACTS}
        own = {element: values for element, values in own.items() if values is not None}
        if own:
            figures[name] = _draw_triangles(details, own, title)
    if "jump" in details:
        figures["jumps"] = _draw_jumps(details)
    return figures


def _draw_mesh(details):
    """The lines of the finest mesh of which they can be told apart."""
    own = {
        name.removeprefix("mesh_"): part
        for name, part in details.items()
        if name.startswith("mesh_")
    }
    title = f"{own['t'].shape[1]:,} triangles, level $n = {int(own['n'])}$"
    figure, (axes,), frame = _panels(own, [title])
    corners = frame.place(own["p"])[:, own["t"]]
    many = own["t"].shape[1] > MOST_LINES
    outlines = PolyCollection(
        np.moveaxis(corners, (0, 1, 2), (2, 1, 0)),
        facecolors="none",
        edgecolors=GREY,
        linewidths=0.25,
        rasterized=many,
    )
    axes.add_collection(outlines, autolim=False)
    return figure


def _draw_triangles(details, values, title):
    """A panel for each element, under one scale of colours."""
    labels = [ELEMENT_FACTS[element].label for element in values]
    figure, panels, frame = _panels(details, labels, title)
    colours = _scale(np.concatenate(list(values.values())))
    corners = np.moveaxis(frame.place(details["p"])[:, details["t"]], (0, 1, 2), (2, 1, 0))
    for axes, of_element in zip(panels, values.values(), strict=True):
        triangles = PolyCollection(
            corners,
            array=_held(of_element, colours),
            cmap=COLOURS,
            norm=colours,
            edgecolors="face",
            linewidths=0.1,
            antialiased=False,
            rasterized=True,
        )
        axes.add_collection(triangles, autolim=False)
    _draw_bar(figure, panels[-1], colours)
    return figure


def _draw_jumps(details):
    """The facets, in the colour of the jump across them."""
    figure, (axes,), frame = _panels(details, [JUMP])
    colours = _scale(details["jump"])
    ends = frame.place(details["p"])[:, details["jump_ends"]]
    many = details["jump"].size
    length = 72.0 * ALONE / math.sqrt(max(many, 3) / 3.0)  # of a facet on the page, in points
    facets = LineCollection(
        np.moveaxis(ends, (0, 1, 2), (2, 1, 0)),
        array=_held(details["jump"], colours),
        cmap=COLOURS,
        norm=colours,
        linewidths=min(1.6, 0.45 * length),
        rasterized=many > MOST_LINES,
    )
    axes.add_collection(facets, autolim=False)
    _draw_bar(figure, axes, colours)
    return figure


def _panels(details, labels, title=""):
    """Axes of equal size beside each other, each with the boundary and its label above it."""
    frame = Frame(details["p"])
    width, height = frame.fit(BOX if len(labels) == 2 else ALONE)
    tall = max(height, LEAST_BAR)
    page = BOTTOM + LEGEND + tall + TITLE + TOP + (TITLE if title else 0.0)
    total = len(labels) * width + (len(labels) - 1) * GAP
    left = max(LEFT, (TEXT_WIDTH - total) / 2)
    figure = new_figure(TEXT_WIDTH, page)
    bottom = BOTTOM + LEGEND + (tall - height) / 2
    panels = []
    for k, label in enumerate(labels):
        axes = add_axes(figure, left + k * (width + GAP), bottom, width, height)
        draw_boundary(axes, {"binding": np.zeros((0, 2, 2))} | details, frame)
        axes.set(xlim=(frame.low[0], frame.high[0]), ylim=(frame.low[1], frame.high[1]))
        axes.set_title(label, fontsize=9, pad=6)
        _name_axes(axes, frame, width, height, first=k == 0)
        panels.append(axes)
    if title:
        figure.text(0.5, 1 - TOP / page, title, ha="center", va="top", fontsize=9)
    handles, names = panels[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncols=3, borderaxespad=0.2)
    return figure, panels, frame


def _name_axes(axes, frame, width, height, first):
    for side in ("left", "bottom"):
        axes.spines[side].set_position(("outward", 5))
    axes.set_xlabel(frame.label(0, "x") + ("" if frame.to_scale else ", not to scale"))
    tidy_ticks(axes.xaxis, width)
    tidy_ticks(axes.yaxis, height)
    axes.tick_params(labelleft=first)
    if first:
        name = frame.label(1, "y")
        axes.set_ylabel(name, rotation=0 if name == "$y$" else 90, labelpad=8)


def _scale(values):
    """Colours for sizes: by the logarithm, over the decades that there are and at most `DECADES`.

    Two in a thousand may be smaller than the smallest that is told apart.
    """
    positive = values[values > 0.0]
    if not positive.size:
        return LogNorm(0.1, 1.0)
    high = float(positive.max())
    low = max(float(np.quantile(positive, 0.002, method="lower")), high / 10.0**DECADES)
    return LogNorm(min(low, high / 2.0), high)


def _held(values, colours):
    """Values within the scale: zero has no logarithm."""
    return np.clip(values, colours.vmin, colours.vmax)


def _draw_bar(figure, axes, colours):
    box = axes.get_position()
    page_width, page_height = figure.get_size_inches()
    tall = max(box.height * page_height, LEAST_BAR)
    middle = (box.y0 + box.y1) / 2 * page_height
    place = box.x1 * page_width + BAR_GAP, middle - tall / 2, BAR, tall
    bar = figure.colorbar(ScalarMappable(colours, COLOURS), cax=add_axes(figure, *place))
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(length=2, width=0.5)
    ticks = bar_ticks(colours.vmin, colours.vmax)
    bar.set_ticks(ticks, labels=[_power(tick) for tick in ticks])
    bar.ax.minorticks_off()


def bar_ticks(low, high):
    """Round numbers between two, decades where there are at least two of them.

    Parameters
    ----------
    low, high : float
        Positive.

    Returns
    -------
    list of float

    Examples
    --------
    >>> bar_ticks(2e-3, 3.0), bar_ticks(0.15, 0.7)
    ([0.01, 0.1, 1.0], [0.2, 0.5])
    """
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    for parts in ((1,), (1, 2, 5), (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)):
        ticks = [float(f"{part}e{k}") for k in range(first, last + 1) for part in parts]
        ticks = [tick for tick in ticks if low <= tick <= high]
        if len(ticks) > 1:
            return ticks
    return [low, high]


def _power(value):
    """A number as its decade and, in front of it, what is not 1."""
    digits, exponent = f"{value:.1e}".split("e")
    digits = digits.removesuffix(".0")
    ten = f"10^{{{int(exponent)}}}"
    return f"${ten}$" if digits == "1" else rf"${digits}\cdot{ten}$"
