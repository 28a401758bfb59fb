"""Figure 5.1: a solution as a wire surface, with its contact side in front."""

from dataclasses import dataclass

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.ticker import MaxNLocator

from signorini.figures.style import ACCENT, BLACK, FAINT, GREY, STYLE, TEXT_WIDTH, new_figure

ELEVATION, AZIMUTH = np.radians(27), np.radians(-60)  # of the eye, which stands in front of y = y_0
HEIGHT = 0.62  # of the drawn box, whose base has sides of length 1
MARGIN = 0.08  # between the surface and the floor, in heights of the surface
TICK, NAME = 0.015, 0.16  # lengths of a tick and distance of an axis name, in sides of the base
TICK_LABEL = (
    (0.07, "center"),
    (0.035, "left"),
    (0.03, "right"),
)  # distance and alignment on x, y, u

RIGHT = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0])
UP = np.array(
    [-np.cos(AZIMUTH) * np.sin(ELEVATION), -np.sin(AZIMUTH) * np.sin(ELEVATION), np.cos(ELEVATION)]
)


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
        """Return the page coordinates (..., 2) of points, moved by `shift` in units of the base."""
        points = np.stack(np.broadcast_arrays(x, y, z), axis=-1)
        unit = (points - self.low) / (self.high - self.low) * (1, 1, HEIGHT)
        return (unit + shift) @ np.stack([RIGHT, UP], axis=1)

    def lines(self, *paths):
        """Return the images of `paths`, each a list of corners such as "011": 0 is low and 1 is
        high.
        """
        corners = np.stack([self.low, self.high])
        return [
            self.image(*([corners[int(c[k]), k] for c in path] for k in range(3))) for path in paths
        ]


@matplotlib.rc_context(STYLE)
def draw_surface(surface):
    """Draw u over its rectangle with hidden lines removed, the contact side y = y_0 in front.

    Parameters
    ----------
    surface : mapping of str to ndarray
        ``x`` (m,), ``y`` (k,) and ``u`` (k, m), u[j, i] at (x_i, y_j); ``contact_x`` and
        ``contact_u`` (p,) along the contact side; ``critical_points`` (c, 2). An obstacle other
        than zero is given as
        ``contact_obstacle`` (p,); where ``contact_u`` does not exceed it, it binds. All
        dimensionless.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(0.86 * TEXT_WIDTH, 0.57 * TEXT_WIDTH)
    axes = figure.add_axes((0, 0.08, 1, 0.92), aspect="equal", frame_on=False, xticks=[], yticks=[])
    x, y, u = surface["x"], surface["y"], surface["u"]
    height = np.ptp(u) or 1.0  # a solution may be flat
    floor = u.min() - MARGIN * height
    box = Box(np.array([x[0], y[0], floor]), np.array([x[-1], y[-1], u.min() + height]))
    _draw_box(axes, box)
    _draw_wires(axes, box.image(x, y[:, None], u))
    _draw_contact(axes, box, surface)
    axes.autoscale_view()
    axes.margins(0.02)
    figure.legend(loc="lower center", ncols=4, handlelength=2, columnspacing=1.6, borderaxespad=0)
    return figure


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
    """Put ticks, their values and a name along the edge of the box that `place` runs through."""
    low, high, outward = box.low[k], box.high[k], np.array(outward)
    ticks = [t for t in MaxNLocator(5).tick_values(low, high) if low <= t <= high]
    lines = [[box.image(*place(t)), box.image(*place(t), TICK * outward)] for t in ticks]
    axes.add_collection(LineCollection(lines, color=BLACK, linewidth=0.5))
    distance, align = TICK_LABEL[k]
    for t in ticks:
        at = box.image(*place(t), distance * outward)
        axes.text(*at, f"${t:.4g}$", fontsize=8, ha=align, va="center")
    axes.text(*box.image(*place((low + high) / 2), NAME * outward), name, ha="center", va="center")


def _draw_wires(axes, points):
    """Paint the cells from the back to the front: each white face hides what lies behind it."""
    cells = np.stack([points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]], axis=2)
    back_to_front = cells[::-1].reshape(-1, 4, 2)  # y grows away from the eye, x towards it
    wires = PolyCollection(
        back_to_front, facecolor="white", edgecolor=GREY, linewidth=0.3, zorder=3
    )
    axes.add_collection(wires)


def _draw_contact(axes, box, surface):
    x, u, y = surface["contact_x"], surface["contact_u"], surface["y"][0]
    obstacle = surface.get("contact_obstacle", np.zeros_like(u))
    binding = u <= obstacle
    free, bound = np.where(binding, np.nan, u), np.where(binding, u, np.nan)
    styles = {
        "contact side, free": (free, {"color": ACCENT, "linewidth": 2}),
        "contact side, binding": (bound, {"color": BLACK, "linewidth": 2.8}),
        "obstacle": (obstacle, {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (4, 3))}),
    }
    for label, (height, style) in styles.items():
        axes.plot(*box.image(x, y, height).T, label=label, zorder=4, **style)
    marker = {
        "markerfacecolor": "white",
        "markeredgecolor": BLACK,
        "markersize": 5.5,
        "linestyle": "none",
    }
    for k, (px, py) in enumerate(surface["critical_points"]):
        point = box.image(px, py, np.interp(px, x, obstacle))
        axes.plot(*point, "o", zorder=5, label="_" if k else "critical point", **marker)
        axes.annotate(
            f"$x = {px:.3f}$",
            point,
            (-2, -7),
            textcoords="offset points",
            ha="center",
            va="top",
            zorder=4,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},
        )
