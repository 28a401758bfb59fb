"""A solution over any domain: filled contours of u, the parts of the boundary, and where the
constraint binds.
"""

import math
from string import ascii_letters, digits

import matplotlib
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from signorini.figures.style import ACCENT, BLACK, STYLE, TEXT_WIDTH, new_figure

# From paper to brown in steps of about equal length in CIELAB, lightness falling all the way: it
# also reads in grey, and black and ACCENT stand out on all of it.
COLOURS = LinearSegmentedColormap.from_list(
    "sand", ["#fdf5ed", "#efdcc6", "#e0c3a0", "#cea97b", "#ba8d58", "#a26f37", "#87521c"]
)
BANDS = 9  # of colour, at most
STEPS = [1, 2, 2.5, 5, 10]  # between levels and between ticks, times a power of ten
FLAT = 1e-9  # a range of u this small against u is drawn as a constant
MOST_STRETCHED = (
    8  # longer side of a drawn domain over the shorter; a longer domain is not drawn to scale
)
OFFSET = (
    1e3  # a domain this many of its own sizes from the origin is labelled relative to its corner
)
LEAST_EXPONENT = -306  # of a unit, so that it is a normal number

# Widths and heights in inches.
WIDTH, BOX = 0.8 * TEXT_WIDTH, 2.9  # of the figure; side of the square in which a domain must fit
LEFT, BOTTOM, TOP, LEGEND = 0.62, 0.46, 0.25, 0.38  # margins; LEGEND below, a title above
TITLE, BAR, LEAST_BAR = 0.24, 0.1, 1.0

BOUNDARY = {
    "dirichlet": ("Dirichlet", {"color": BLACK, "linewidth": 0.8}),
    "neumann": ("Neumann", {"color": BLACK, "linewidth": 0.8, "linestyle": (0, (4, 3))}),
    "contact": ("contact", {"color": ACCENT, "linewidth": 2}),
    "binding": ("contact, binding", {"color": BLACK, "linewidth": 2.8}),
}
CRITICAL = {
    "markerfacecolor": "white",
    "markeredgecolor": BLACK,
    "markersize": 5.5,
    "linestyle": "none",
}

_AS_THEY_ARE = {
    *ascii_letters,
    *digits,
    *" !#%&'()*+,-./:;=?@[]",
}  # the characters that cmr10 has under their own code


@matplotlib.rc_context(STYLE)
def draw_field(field, title=""):
    """Draw u as filled contours, for CR on every triangle by itself, over a domain of any shape and
    size.

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
    head = TOP + (TITLE if title else 0)
    page = WIDTH, LEGEND + BOTTOM + bar + head
    figure = new_figure(*page)
    bottom, left = LEGEND + BOTTOM, LEFT + (BOX - width) / 2
    axes = figure.add_axes(_relative(page, left, bottom + (bar - height) / 2, width, height))
    contours, exponent = paint(axes, field, frame)
    axes.set_xlabel(frame.label(0, "x") + ("" if frame.to_scale else ", not to scale"))
    name = frame.label(1, "y")
    axes.set_ylabel(name, rotation=0 if name == "$y$" else 90)
    tidy_ticks(axes.xaxis, width)
    tidy_ticks(axes.yaxis, height)
    colours = figure.add_axes(_relative(page, left + width + 0.25, bottom, BAR, bar))
    _draw_bar(figure, colours, contours, with_unit("$u$", exponent))
    figure.legend(
        loc="lower center", ncols=3, handlelength=2.4, columnspacing=1.6, borderaxespad=0.2
    )
    if title:
        figure.text(0.5, 1 - TOP / page[1], title, ha="center", va="bottom", **plain(title))
    return figure


def _relative(page, left, bottom, width, height):
    return left / page[0], bottom / page[1], width / page[0], height / page[1]


def _draw_bar(figure, axes, contours, label):
    bar = figure.colorbar(contours, cax=axes)
    axes.set_title(label, fontsize=9, pad=6)
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(length=2, width=0.5)
    levels = contours.levels
    every = -(-len(levels) // 7)
    ticks = levels[np.argmin(np.abs(levels)) % every :: every]  # 0 is one of them, if it is a level
    if len(levels) == 2:  # of a constant
        ticks = [levels.mean()]
    bar.set_ticks(ticks, labels=[f"${tick:.4g}$" for tick in ticks])
    bar.ax.minorticks_off()


class Frame:
    """How a domain's coordinates become numbers of readable size on the page.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.
    """

    def __init__(self, p):
        low, high = p.min(axis=1), p.max(axis=1)
        far = np.maximum(np.abs(low), np.abs(high)) > OFFSET * (high - low).max()
        self.offset = np.where(far, low, 0.0)
        exponents = [
            unit_exponent([low[k] - self.offset[k], high[k] - self.offset[k]]) for k in range(2)
        ]
        width, height = high - low
        ratio = min(max(width / height, 1 / MOST_STRETCHED), MOST_STRETCHED)
        self.to_scale = ratio == width / height
        self.exponents = [max(exponents)] * 2 if self.to_scale else exponents
        self.shape = min(ratio, 1.0), min(1 / ratio, 1.0)  # width and height, the longer one 1
        self.low, self.high = (self.place(corner[:, None])[:, 0] for corner in (low, high))

    def place(self, points):
        """Coordinates (2, k) as numbers of the axes."""
        return (points - self.offset[:, None]) / [[10.0**exponent] for exponent in self.exponents]

    def fit(self, side):
        """Width and height on the page, in inches, within a square of `side`."""
        return self.shape[0] * side, self.shape[1] * side

    def label(self, axis, name):
        """Name of an axis: what its tick labels count."""
        offset = self.offset[axis]
        text = (
            f"${name} {'-' if offset > 0 else '+'} {abs(offset):.10g}$" if offset else f"${name}$"
        )
        return with_unit(text, self.exponents[axis])


def unit_exponent(values):
    """The exponent, a multiple of 3, of the power of ten in which `values` read best; 0 from 0.01
    to 10000.
    """
    largest = np.max(np.abs(values), initial=0.0)
    if largest == 0 or 1e-2 <= largest < 1e4:
        return 0
    return max(3 * math.floor(math.log10(largest) / 3), LEAST_EXPONENT)


def with_unit(name, exponent):
    """A label for numbers that count units of ``10**exponent``."""
    return f"{name}  [$10^{{{exponent}}}$]" if exponent else name


def tidy_ticks(axis, length):
    """Put ticks on an axis, `length` inches long, with numbers as short as they can be."""
    axis.set_major_locator(MaxNLocator(min(max(round(1.75 * length), 1), 8), steps=STEPS))
    axis.set_major_formatter(lambda tick, _: f"${tick:.6g}$")


def plain(text):
    """Options that set a user's `text` as it was typed, in a font that has its characters."""
    return {"parse_math": False} | (
        {} if _AS_THEY_ARE.issuperset(text) else {"family": "STIXGeneral"}
    )


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
    values, levels = (
        field["values"] / 10.0**exponent,
        _levels(*(field["range"] / 10.0**exponent).tolist()),
    )
    x, y = frame.place(field["p"])[:, field["t"].ravel()]
    corners = np.arange(values.size).reshape(3, -1).T  # of each triangle by itself
    heights = np.clip(
        values.ravel(), levels[0], np.nextafter(levels[-1], -np.inf)
    )  # the last band is open above
    contours = axes.tricontourf(
        x, y, corners, heights, levels, cmap=COLOURS, antialiased=False, zorder=1
    )
    contours.set_rasterized(True)  # the many triangles would show their seams, and weigh
    if len(levels) > 2:
        style = {"colors": BLACK, "linewidths": 0.3 * thickness, "linestyles": "solid", "zorder": 2}
        axes.tricontour(x, y, corners, heights, levels[1:-1], **style)
    _draw_boundary(axes, field, frame, thickness)
    axes.set(xlim=(frame.low[0], frame.high[0]), ylim=(frame.low[1], frame.high[1]))
    for side in ("left", "bottom"):
        axes.spines[side].set_position(("outward", 5))
    return contours, exponent


def _levels(low, high):
    """Round numbers from `low` to `high`, which a tenth of a band may exceed."""
    if high - low <= FLAT * max(abs(low), abs(high)):
        margin = 0.5 * max(abs(low), 1.0)
        return np.array([low - margin, low + margin])
    levels = MaxNLocator(BANDS, steps=STEPS).tick_values(low, high)
    slack = 0.9 * (levels[1] - levels[0])
    inner = levels[(levels > low - slack) & (levels < high + slack)]
    return inner if len(inner) > 1 else levels


def _draw_boundary(axes, field, frame, thickness):
    p = field["p"]
    pieces = {
        label: p[:, field[f"edges_{label}"]].transpose(2, 1, 0)
        for label in ("dirichlet", "neumann", "contact")
    }
    for order, (name, found) in enumerate((pieces | {"binding": field["binding"]}).items()):
        label, style = BOUNDARY[name]
        if len(found):
            style = style | {"linewidth": thickness * style["linewidth"]}
            joint = {"solid_joinstyle": "round", "solid_capstyle": "butt", "clip_on": False}
            axes.plot(
                *frame.place(_polyline(found).T), label=label, zorder=3 + order, **style, **joint
            )
    marker = CRITICAL | {"markersize": thickness * CRITICAL["markersize"], "clip_on": False}
    if len(field["critical_points"]):
        axes.plot(
            *frame.place(field["critical_points"].T),
            "o",
            label="critical point",
            zorder=7,
            **marker,
        )


def _polyline(pieces):
    """Points (k, 2) of a line through `pieces` (m, 2, 2), broken by NaN where one does not start at
    the last's end.
    """
    broken = np.flatnonzero(np.any(pieces[1:, 0] != pieces[:-1, 1], axis=1)) + 1
    lines = [np.append(run[:, 0], run[-1:, 1], axis=0) for run in np.split(pieces, broken)]
    gap = np.full((1, 2), np.nan)
    return np.concatenate([part for line in lines for part in (line, gap)][:-1])
