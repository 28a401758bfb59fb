"""A mesh: its triangles, and the names of the parts of its boundary and of its subdomains."""

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from signorini.figures.field import COLOURS
from signorini.figures.frame import Frame
from signorini.figures.style import (
    ACCENT,
    BLACK,
    FAINT,
    GREY,
    STYLE,
    TEXT_WIDTH,
    add_axes,
    new_figure,
)
from signorini.figures.units import plain, tidy_ticks

MOST_LINES = 5000  # triangles; more are a picture within the PDF
BOX = 3.6  # inches: side of the square in which a domain must fit
LEFT, BOTTOM, TOP = 0.66, 0.5, 0.34
DISTANCE = 7  # of a name from its part, in points
SLANTED = 0.4  # a component of the normal that is smaller moves no name sideways, or up or down
LIGHT, DARK = 0.05, 0.45  # of the colours of subdomains, on the scale of figures of u

_BESIDE = {"textcoords": "offset points", "fontsize": 8, "zorder": 6, "annotation_clip": False}
_PAPER = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.8}


@matplotlib.rc_context(STYLE)
def draw_mesh(shown, title=""):
    """Draw triangles, and the parts of boundary and body by their names.

    Parts are black and blue by turns, with a dot where one ends. What has no name is dashed.

    Parameters
    ----------
    shown : mapping
        What `signorini.report.named_parts.named_parts` returns.
    title : str, optional
        Plain text above the figure.

    Returns
    -------
    matplotlib.figure.Figure
    """
    frame = Frame(shown["p"])
    width, height = frame.fit(BOX)
    figure = new_figure(min(LEFT + width + LEFT, TEXT_WIDTH), BOTTOM + height + TOP)
    axes = add_axes(figure, LEFT, BOTTOM, width, height)
    corners = frame.place(shown["p"])
    _draw_triangles(axes, corners, shown)
    _draw_lines(axes, corners, shown["nameless"], GREY, 0.8, linestyle=(0, (3, 2)))
    axes.set(xlim=(frame.low[0], frame.high[0]), ylim=(frame.low[1], frame.high[1]))
    for number, (name, ends, middle, inside) in enumerate(shown["parts"]):
        colour = (BLACK, ACCENT)[number % 2]
        _draw_part(axes, corners, ends, colour)
        _write(axes, name, colour, corners[:, middle], corners[:, inside])
    for name, _, place in shown["regions"]:
        x, y = frame.place(place[:, None])[:, 0]
        axes.text(x, y, name, style="italic", ha="center", va="center", bbox=_PAPER, zorder=5)
    _name_axes(axes, frame, width, height)
    if title:
        axes.set_title(title, fontsize=9, pad=8, **plain(title))
    return figure


def _draw_triangles(axes, corners, shown):
    outlines = np.moveaxis(corners[:, shown["t"]], (0, 1, 2), (2, 1, 0))
    colours = np.ones((len(outlines), 4))
    tones = np.linspace(LIGHT, DARK, len(shown["regions"]))
    for tone, (_, triangles, _) in zip(tones, shown["regions"], strict=True):
        colours[triangles] = COLOURS(tone)
    style = {"facecolors": colours, "edgecolors": FAINT, "linewidths": 0.25, "zorder": 1}
    many = len(outlines) > MOST_LINES
    axes.add_collection(PolyCollection(outlines, rasterized=many, **style), autolim=False)


def _draw_lines(axes, corners, ends, colour, width, **style):
    pieces = np.moveaxis(corners[:, ends], (0, 1, 2), (2, 1, 0))
    style = {"linewidths": width, "capstyle": "round", "zorder": 3, "clip_on": False} | style
    axes.add_collection(LineCollection(pieces, colors=colour, **style), autolim=False)


def _draw_part(axes, corners, ends, colour):
    _draw_lines(axes, corners, ends, colour, 1.4)
    vertices, times = np.unique(ends, return_counts=True)
    dots = {"color": BLACK, "markersize": 3, "zorder": 4, "clip_on": False}
    axes.plot(*corners[:, vertices[times == 1]], "o", **dots)


def _write(axes, name, colour, facet, inside):
    """Write a name beside the middle of a facet, within the body."""
    x, y = _inward(axes, facet, inside)
    horizontal = "center" if abs(x) < SLANTED else ("right", "left")[int(x > 0)]
    vertical = "center" if abs(y) < SLANTED else ("top", "bottom")[int(y > 0)]
    words = {"color": colour, "ha": horizontal, "va": vertical, "bbox": _PAPER} | plain(name)
    offset = (DISTANCE * x, DISTANCE * y)
    axes.annotate(name, facet.mean(axis=1), offset, **_BESIDE, **words)


def _inward(axes, facet, inside):
    """The normal of a facet on the page, of length 1."""
    start, end, across = axes.transData.transform([*facet.T, inside])
    normal = np.array([start[1] - end[1], end[0] - start[0]])
    towards = np.copysign(1.0, normal @ (across - start))
    return towards * normal / np.linalg.norm(normal)


def _name_axes(axes, frame, width, height):
    for side in ("left", "bottom"):
        axes.spines[side].set_position(("outward", 5))
    axes.set_xlabel(frame.label(0, "x") + ("" if frame.to_scale else ", not to scale"))
    name = frame.label(1, "y")
    axes.set_ylabel(name, rotation=0 if name == "$y$" else 90, labelpad=8)
    tidy_ticks(axes.xaxis, width)
    tidy_ticks(axes.yaxis, height)
