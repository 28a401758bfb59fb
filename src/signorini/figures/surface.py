"""Figure 5.1: a solution as a wire surface, with its contact side in front."""

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator

from signorini.figures.style import (
    ACCENT,
    BLACK,
    CRITICAL,
    FAINT,
    GREY,
    STYLE,
    TEXT_WIDTH,
    new_figure,
)
from signorini.report.contact_side import contact_side

# Of the eye, which stands in front of y = y_0.
ELEVATION, AZIMUTH = np.radians(27), np.radians(-60)
HEIGHT = 0.62  # of the drawn box, whose base has sides of length 1
MARGIN = 0.08  # between the surface and the floor, in heights of the surface
DEEPEST = 0.5  # to which the box reaches for an obstacle below the surface, in the same

# In sides of the base.
TICK = 0.015  # length
NAME = 0.16  # distance of an axis name
LETTER, LETTERS = 0.025, 4  # for each letter of a value of u beyond so many, further away
APART = 0.3  # between two critical points whose values have room
TICK_LABEL = ((0.07, "center"), (0.035, "left"), (0.03, "right"))  # distance, alignment: x, y, u

# The directions of the page in the space of the box: the projection is orthographic.
RIGHT = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0])
UP = np.array(
    [
        -np.cos(AZIMUTH) * np.sin(ELEVATION),
        -np.sin(AZIMUTH) * np.sin(ELEVATION),
        np.cos(ELEVATION),
    ]
)

CONTACT = {
    "free": ("contact side, free", {"color": ACCENT, "linewidth": 2}),
    "binding": ("contact side, binding", {"color": BLACK, "linewidth": 2.8}),
    "obstacle": ("obstacle", {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (4, 3))}),
}


@dataclass(frozen=True)
class Box:
    """The box around a surface and its orthographic image on the page.

    Parameters
    ----------
    low, high : ndarray, shape (3,)
        Opposite corners.
    """

    low: np.ndarray
    high: np.ndarray

    def image(self, x, y, z, shift=(0, 0, 0)):
        """Return the place of points on the page.

        Parameters
        ----------
        x, y, z : array_like
            Coordinates, of shapes that broadcast.
        shift : sequence of float, optional
            Moves all points, in sides of the base.

        Returns
        -------
        ndarray, shape (..., 2)
            In sides of the base.
        """
        points = np.stack(np.broadcast_arrays(x, y, z), axis=-1)
        unit = (points - self.low) / (self.high - self.low) * (1, 1, HEIGHT)
        return (unit + shift) @ np.stack([RIGHT, UP], axis=1)

    def lines(self, *paths):
        """Return the images of lines through corners.

        Parameters
        ----------
        *paths : list of str
            Corners such as "011", a digit for each of x, y and u: 0 is low and 1 is high.

        Returns
        -------
        list of ndarray, shape (k, 2)
        """
        return [self._line(path) for path in paths]

    def _line(self, path):
        ends = np.stack([self.low, self.high])
        x, y, z = ([ends[int(corner[k]), k] for corner in path] for k in range(3))
        return self.image(x, y, z)


@matplotlib.rc_context(STYLE)
def draw_surface(surface):
    """Draw u over its rectangle with hidden lines removed, the contact side y = y_0 in front.

    Parameters
    ----------
    surface : mapping of str to ndarray
        ``x`` (m,), ``y`` (k,) and ``u`` (k, m), u[j, i] at (x_i, y_j); ``contact_x`` and
        ``contact_u`` (p,) along the contact side; ``critical_points`` (c, 2). An obstacle other
        than zero is given as ``contact_obstacle`` (p,); where ``contact_u`` does not exceed it, it
        binds. All dimensionless.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(0.86 * TEXT_WIDTH, 0.57 * TEXT_WIDTH)
    axes = figure.add_axes((0, 0.08, 1, 0.92), aspect="equal", frame_on=False, xticks=[], yticks=[])
    box = _box_around(surface)
    _draw_box(axes, box)
    _draw_wires(axes, box.image(surface["x"], surface["y"][:, None], surface["u"]))
    side = contact_side(surface)
    _draw_contact(axes, box, side, surface["y"][0])
    _draw_critical_points(axes, box, side["points"])
    axes.autoscale_view()
    axes.margins(0.02)
    figure.legend(loc="lower center", ncols=4, handlelength=2, columnspacing=1.6, borderaxespad=0)
    return figure


def _box_around(surface):
    x, y, u = surface["x"], surface["y"], surface["u"]
    height = np.ptp(u) or 1.0  # a solution may be flat
    obstacle = np.min(surface.get("contact_obstacle", u.min()))
    lowest = max(min(u.min(), obstacle), u.min() - DEEPEST * height)
    floor = lowest - MARGIN * height
    return Box(np.array([x[0], y[0], floor]), np.array([x[-1], y[-1], u.min() + height]))


def _draw_box(axes, box):
    hidden = box.lines(["000", "010", "110"], ["010", "011"], ["001", "011", "111"], ["110", "111"])
    axes.add_collection(LineCollection(hidden, color=FAINT, linewidth=0.5))
    front = box.lines(["001", "000", "100", "110"])
    axes.add_collection(LineCollection(front, color=BLACK, linewidth=0.5))
    (x0, y0, z0), (x1, _, _) = box.low, box.high
    _draw_axis(axes, box, 0, "$x$", lambda t: (t, y0, z0), (0, -1, 0))
    _draw_axis(axes, box, 1, "$y$", lambda t: (x1, t, z0), (1, 0, 0))
    _draw_axis(axes, box, 2, "$u$", lambda t: (x0, y0, t), (-1, 0, 0))


def _draw_axis(axes, box, k, name, place, outward):
    """Put ticks, their values and a name along an edge of the box.

    `place` maps a coordinate to its point of the edge; `outward` points away from the box.
    """
    low, high, outward = box.low[k], box.high[k], np.array(outward)
    ticks = [t for t in MaxNLocator(5).tick_values(low, high) if low <= t <= high]
    lines = [[box.image(*place(t)), box.image(*place(t), TICK * outward)] for t in ticks]
    axes.add_collection(LineCollection(lines, color=BLACK, linewidth=0.5))
    distance, align = TICK_LABEL[k]
    for t in ticks:
        x, y = box.image(*place(t), distance * outward)
        axes.text(x, y, f"${t:.4g}$", fontsize=8, ha=align, va="center")
    longest = max((len(f"{t:.4g}") for t in ticks), default=0) if k == 2 else 0
    away = NAME + LETTER * max(longest - LETTERS, 0)
    x, y = box.image(*place((low + high) / 2), away * outward)
    axes.text(x, y, name, ha="center", va="center")


def _draw_wires(axes, points):
    """Paint the cells from the back to the front: each white face hides what lies behind it.

    `points` has the shape (rows, columns, 2): y grows away from the eye, and x towards it.
    """
    lower, upper = points[:-1], points[1:]
    corners = [lower[:, :-1], lower[:, 1:], upper[:, 1:], upper[:, :-1]]
    cells = np.stack(corners, axis=2)
    back_to_front = cells[::-1].reshape(-1, 4, 2)
    wires = PolyCollection(
        back_to_front,
        facecolor="white",
        edgecolor=GREY,
        linewidth=0.3,
        zorder=3,
    )
    axes.add_collection(wires)


def _draw_contact(axes, box, side, y):
    for part, (label, style) in CONTACT.items():
        line = box.image(side["x"], y, side[part])
        axes.plot(*line.T, label=label, zorder=4, **style)


def _draw_critical_points(axes, box, points):
    places = [box.image(*point) for point in points]
    for k, place in enumerate(places):
        label = "_" if k else "critical point"  # one entry of the legend is enough
        axes.plot(*place, "o", zorder=5, label=label, **CRITICAL)
    if not _have_room(places):
        return
    for (x, _, _), place in zip(points, places, strict=True):
        axes.annotate(
            f"$x = {x:.3f}$",
            place,
            (-2, -7),
            textcoords="offset points",
            ha="center",
            va="top",
            zorder=4,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},
        )


def _have_room(places):
    """Whether the values of critical points can stand below them: of one, or of two apart."""
    return len(places) == 1 or (len(places) == 2 and np.linalg.norm(places[1] - places[0]) >= APART)
