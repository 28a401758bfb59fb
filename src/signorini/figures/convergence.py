"""Figures 5.2 and 5.3: the error of each element against the mesh width."""

import math

import matplotlib

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.elements import elements_in
from signorini.figures.style import ELEMENT_STYLES, GREY, STYLE, TEXT_WIDTH, new_figure

ORDERS = {"l2": 2}  # of the theory, and of the slope triangle; of any other norm 1
MOST_TICKS = 7
SHORT = 6  # letters of a tick label; of longer ones there is room for half as many
TRIANGLE_GAP = 0.12  # between the lowest curve and the triangle, in heights of the axes


@matplotlib.rc_context(STYLE)
def draw_convergence(errors, norm, slopes=None):
    """Draw the errors of every element in `errors` against h, both axes logarithmic.

    Parameters
    ----------
    errors : sequence of mapping
        Rows of ``errors.csv``: ``element``, ``n``, ``h`` and the column `norm`, as text or numbers.
    norm : str
        A column of `errors`; one that is not in `errors.norms.NORMS` goes by its own name.
    slopes : mapping of str to float, optional
        The average slope of each element, named in the legend.

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
    axes = figure.add_axes((0.205, 0.16, 0.775, 0.805), xscale="log", yscale="log")
    for element in elements:
        own = [point for point in points if point["element"] == element]
        h, error = [point["h"] for point in own], [point["error"] for point in own]
        axes.plot(h, error, label=_label(element, slopes), **ELEMENT_STYLES[element])
    _set_limits(axes, points)
    label_levels(axes, {point["n"]: point["h"] for point in points})
    _draw_triangle(axes, _lowest_errors(points), ORDERS.get(norm, 1))
    title = NORMS[norm].axis if norm in NORMS else norm.replace("_", " ")
    axes.set(xlabel="mesh width $h$", ylabel=title)
    axes.legend(loc="upper left", handlelength=2.6, borderaxespad=0.2)
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
    axes.plot([left, right, right, left], [bottom, bottom, top, bottom], color=GREY, linewidth=0.7)
    style = {"textcoords": "offset points", "fontsize": 8, "color": GREY}
    middle = math.sqrt(left * right)
    axes.annotate("$1$", (middle, bottom), (0, -3), ha="center", va="top", **style)
    middle = math.sqrt(bottom * top)
    axes.annotate(f"${order}$", (right, middle), (3, 0), va="center", **style)
