"""The slope triangle of a convergence plot: of which order, where, and drawn."""

import math
from fractions import Fraction

from signorini.figures.style import GREY

GAP = 1.6  # the least factor between the lowest curve and the triangle
AGREED = 0.3  # how far slopes may be apart to show one rate
LEAST = 0.25  # below it a slope is called none
NEAR = 0.12  # how far their mean may be from a multiple of a half to be called by it


def order_of(slopes):
    """The rate that slopes show: a multiple of a half where they are near one, else their mean.

    Parameters
    ----------
    slopes : iterable of float or str

    Returns
    -------
    float
        With two digits; 0 where they show none: they are apart, or hardly above zero.

    Examples
    --------
    >>> order_of([1.97, 1.99]), order_of([1.42, "1.6"]), order_of([0.82, 0.84])
    (2.0, 1.5, 0.83)
    >>> order_of([1.53, 0.47])
    0.0
    """
    found = [float(slope) for slope in slopes if slope not in (None, "")]
    if not found or max(found) - min(found) > AGREED:
        return 0.0
    mean = math.fsum(found) / len(found)
    half = round(2 * mean) / 2
    order = half if abs(mean - half) <= NEAR else float(f"{mean:.2g}")
    return order if order >= LEAST else 0.0


def triangle_below(lowest, order):
    """Where a triangle of an order is below a curve, over two of its steps at most.

    Parameters
    ----------
    lowest : mapping of float to float
        Mesh width -> the least error there, both positive.
    order : float

    Returns
    -------
    (left, right), (bottom, top) : pairs of float
        Or None where there are fewer than two mesh widths.

    Examples
    --------
    >>> (left, right), (bottom, top) = triangle_below({0.25: 0.1, 0.5: 0.4, 1.0: 1.0}, 2.0)
    >>> left, right, round(top / bottom, 12), bottom < 1.0 / 16
    (0.25, 1.0, 16.0, True)
    """
    widths = sorted(lowest)
    if len(widths) < 2:
        return None
    first = (len(widths) - 1) // 3
    within = widths[first : first + 3]
    left, right = within[0], within[-1]
    bottom = min(lowest[h] * (left / h) ** order for h in within) / GAP
    return (left, right), (bottom, bottom * (right / left) ** order)


def draw_triangle(axes, along, up, order):
    """Draw a triangle with its two numbers.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    along, up : (float, float)
        What `triangle_below` returns.
    order : float

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> axes = Figure().subplots()
    >>> draw_triangle(axes, (0.1, 0.2), (0.01, 0.04), order=2)
    >>> [text.get_text() for text in axes.texts]
    ['$1$', '$2$']
    """
    (left, right), (bottom, top) = along, up
    axes.plot([left, right, right, left], [bottom, bottom, top, bottom], color=GREY, linewidth=0.7)
    style = {"textcoords": "offset points", "fontsize": 8, "color": GREY}
    middle = math.sqrt(left * right)
    axes.annotate("$1$", (middle, bottom), (0, -3), ha="center", va="top", **style)
    place = (right, math.sqrt(bottom * top))
    axes.annotate(f"${name_of(order)}$", place, (3, 0), va="center", **style)


def name_of(order):
    """What the side of a triangle is called.

    Parameters
    ----------
    order : float
        A multiple of a half goes by its fraction.

    Returns
    -------
    str

    Examples
    --------
    >>> name_of(2), name_of(1.5), name_of(0.83)
    ('2', '3/2', '0.83')
    """
    return f"{order:.2g}" if (2 * order) % 1 else str(Fraction(order))
