"""The error of each element against the mesh width, as in Figures 5.2 and 5.3 or fitted to data."""

import math

import matplotlib

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.elements import elements_in
from signorini.figures.rate import draw_triangle, order_of, triangle_below
from signorini.figures.style import ELEMENT_STYLES, STYLE, TEXT_WIDTH, new_figure

ORDERS = {"l2": 2}  # of the theory, and of the paper's slope triangle; of any other norm 1
PAPER_AXES = (0.205, 0.16, 0.775, 0.805)  # the legend is within them
FITTED_AXES = (0.205, 0.16, 0.755, 0.665)  # the legend is above them
DIGIT = 0.06  # room for a digit below a triangle, in lengths of the axis
MARGIN = 0.08  # around the data of a fitted figure, in lengths of their range
MOST_TICKS = 7
SHORT = 6  # letters of a tick label; of longer ones there is room for half as many
TRIANGLE_GAP = 0.12  # between the lowest curve and the triangle, in heights of the axes


@matplotlib.rc_context(STYLE)
def draw_convergence(errors, norm, slopes=None, fitted=False):
    """Draw the errors of every element in `errors` against h, both axes logarithmic.

    Parameters
    ----------
    errors : sequence of mapping
        Rows of ``errors.csv``: ``element``, ``n``, ``h`` and the column `norm`, as text or numbers.
    norm : str
        A column of `errors`; one that is not in `errors.norms.NORMS` goes by its own name.
    slopes : mapping of str to float, optional
        The average slope of each element, named in the legend.
    fitted : bool, optional
        Whether the axes are as long as the data are, with the legend above them and a triangle of
        the rate that the slopes show (`rate.order_of`); else all is as in the paper: whole decades,
        and a triangle of the theory's order.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        If no error in this norm is given, or an element has no style here.

    Examples
    --------
    >>> errors = [
    ...     {"element": "CR", "n": 2, "h": 0.5, "l2": 0.4, "floor": ""},
    ...     {"element": "CR", "n": 4, "h": 0.25, "l2": 0.1, "floor": ""},
    ... ]
    >>> figure = draw_convergence(errors, "l2", {"CR": 2.0})
    >>> figure.axes[0].get_xscale()
    'log'
    """
    points = _points(errors, norm)
    elements = elements_in(points)
    figure = new_figure(0.49 * TEXT_WIDTH, 0.43 * TEXT_WIDTH)
    place = FITTED_AXES if fitted else PAPER_AXES
    axes = figure.add_axes(place, xscale="log", yscale="log")
    for element in elements:
        own = [point for point in points if point["element"] == element]
        h, error = [point["h"] for point in own], [point["error"] for point in own]
        axes.plot(h, error, label=_label(element, slopes), **ELEMENT_STYLES[element])
    label_levels(axes, {point["n"]: point["h"] for point in points})
    if fitted:
        _fit(axes, points, order_of((slopes or {}).values()))
    else:
        _set_limits(axes, points)
        _draw_triangle(axes, _lowest_errors(points), ORDERS.get(norm, 1))
    title = NORMS[norm].axis if norm in NORMS else norm.replace("_", " ")
    axes.set(xlabel="mesh width $h$", ylabel=title)
    options = {"loc": "lower left", "bbox_to_anchor": (0, 1)} if fitted else {"loc": "upper left"}
    axes.legend(handlelength=2.6, borderaxespad=0.2, **options)
    return figure


def _points(errors, norm):
    """The finite errors in a norm, as numbers."""
    if not any(norm in row for row in errors):
        given = [name for name in NORMS if any(name in row for row in errors)]
        raise ValueError(f"no errors in the norm {norm!r}; known: {', '.join(given)}")
    return [
        {
            "element": row["element"],
            "n": int(row["n"]),
            "h": float(row["h"]),
            "error": float(row[norm]),
        }
        for row in errors
        if row.get(norm) not in (None, "") and math.isfinite(float(row[norm]))
    ]


def _label(element, slopes):
    """The name of an element, with its slope if there is one."""
    name, slope = ELEMENT_FACTS[element].label, (slopes or {}).get(element)
    return name if slope in (None, "") else f"{name}, slope {float(slope):.2f}"


def _fit(axes, points, order):
    """Let the axes run over the data and the triangle, which is below all of them."""
    positive = [point for point in points if point["error"] > 0]
    if not positive:
        return
    triangle = triangle_below(_lowest_errors(positive), order) if order else None
    heights = [point["error"] for point in positive]
    if triangle:
        bottom = triangle[1][0]
        heights.append(bottom * (bottom / max(heights)) ** DIGIT)
    axes.set_xlim(*_around([point["h"] for point in positive]))
    axes.set_ylim(*with_two_decades(*_around(heights)))
    if triangle:
        draw_triangle(axes, *triangle, order)


def _around(values):
    """Limits of a logarithmic axis, with some room on both sides."""
    low, high = math.log10(min(values)), math.log10(max(values))
    room = MARGIN * (high - low) or 0.5
    return 10.0 ** (low - room), 10.0 ** (high + room)


def with_two_decades(low, high):
    """Limits that have two powers of ten between them, so that two ticks have numbers.

    Parameters
    ----------
    low, high : float
        Positive.

    Returns
    -------
    low, high : float
        The same, or further apart on the side where less is missing.

    Examples
    --------
    >>> with_two_decades(0.02, 0.5), with_two_decades(0.05, 20.0)
    ((0.02, 1.0), (0.05, 20.0))
    """
    first, last = math.ceil(math.log10(low)), math.floor(math.log10(high))
    if last > first:
        return low, high
    below, above = 10.0 ** (last if last < first else first - 1), 10.0 ** (last + 1)
    if low / below < above / high:
        return with_two_decades(below, high)
    return with_two_decades(low, above)


def _set_limits(axes, points):
    """Let both axes run over whole decades."""
    for set_limits, column in ((axes.set_xlim, "h"), (axes.set_ylim, "error")):
        # An error of exactly zero has no place on a logarithmic axis.
        exponents = [math.log10(point[column]) for point in points if point[column] > 0]
        if exponents:
            low, high = math.floor(min(exponents)), math.ceil(max(exponents))
            set_limits(10.0**low, 10.0 ** max(high, low + 1))


def label_levels(axes, levels):
    """Put a tick at every mesh width, and a label at as many as there is room for.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    levels : dict of int to float
        n -> h; where h is 1/n, the label says so.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> axes = Figure().subplots()
    >>> label_levels(axes, {4: 0.25, 8: 0.125})
    >>> [label.get_text() for label in axes.get_xticklabels()]
    ['1/4', '1/8']
    """
    names = [f"1/{n}" if math.isclose(n * h, 1) else f"{h:.2g}" for n, h in levels.items()]
    longest = max(map(len, names), default=0)
    most = MOST_TICKS if longest <= SHORT else MOST_TICKS // 2
    every = -(-len(levels) // most)
    labels = [name if k % every == 0 else "" for k, name in enumerate(names)]
    axes.set_xticks(list(levels.values()), labels)
    axes.minorticks_off()


def _lowest_errors(points):
    """Mesh width -> the least error there."""
    lowest = {}
    for point in points:
        h = point["h"]
        lowest[h] = min(point["error"], lowest.get(h, math.inf))
    return lowest


def _draw_triangle(axes, lowest, order):
    """Draw the slope `order` over two halvings of h, below the lowest errors.

    ::

                 +
               / | order
             +---+
               1
    """
    widths = sorted(h for h, error in lowest.items() if error > 0)
    if len(widths) < 2:
        return
    first = (len(widths) - 1) // 3
    left, right = widths[first], widths[min(first + 2, len(widths) - 1)]
    low, high = axes.get_ylim()
    bottom = lowest[left] * (low / high) ** TRIANGLE_GAP  # a fixed distance on the page
    top = bottom * (right / left) ** order
    draw_triangle(axes, (left, right), (bottom, top), order)
