"""Figures 5.2 and 5.3: the error of each element against the mesh width."""

import math

import matplotlib

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.style import ELEMENT_STYLES, GREY, STYLE, TEXT_WIDTH, new_figure

ORDERS = {"l2": 2}  # of the theory, and of the slope triangle; of any other norm 1
MOST_TICKS = 7


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
    """
    if not any(norm in row for row in errors):
        given = [name for name in NORMS if any(name in row for row in errors)]
        raise ValueError(f"no errors in the norm {norm!r}; known: {', '.join(given)}")
    errors = [
        row for row in errors if row.get(norm) not in (None, "") and math.isfinite(float(row[norm]))
    ]
    names = dict.fromkeys(row["element"] for row in errors)
    for name in names:
        if name not in ELEMENT_STYLES:
            known = ", ".join(ELEMENT_STYLES)
            raise ValueError(f"no style for the element {name!r}; known: {known}")
    figure = new_figure(0.49 * TEXT_WIDTH, 0.43 * TEXT_WIDTH)
    axes = figure.add_axes((0.205, 0.16, 0.775, 0.805), xscale="log", yscale="log")
    for name in names:
        label, style = ELEMENT_FACTS[name].label, ELEMENT_STYLES[name]
        if slopes and slopes.get(name) not in (None, ""):
            label += f", slope {float(slopes[name]):.2f}"
        rows = [row for row in errors if row["element"] == name]
        axes.plot(
            [float(r["h"]) for r in rows], [float(r[norm]) for r in rows], label=label, **style
        )
    _set_limits(axes, [float(row["h"]) for row in errors], [float(row[norm]) for row in errors])
    _label_levels(axes, {int(row["n"]): float(row["h"]) for row in errors})
    _draw_triangle(axes, _lowest(errors, norm), ORDERS.get(norm, 1))
    title = NORMS[norm].axis if norm in NORMS else norm.replace("_", " ")
    axes.set(xlabel="mesh width $h$", ylabel=title)
    axes.legend(loc="upper left", handlelength=2.6, borderaxespad=0.2)
    return figure


def slopes_of(rates, norm, kind):
    """Element -> its slope of one kind in one norm, from rows of ``rates.csv``; none where errors
    are at round-off.
    """
    wanted = (norm, kind, "0")
    return {
        row["element"]: row["slope"]
        for row in rates
        if (row["norm"], row["kind"], row["floor"]) == wanted
    }


def _set_limits(axes, widths, errors):
    """Let both axes run over whole decades; an error of exactly zero has no place on them."""
    for set_limit, values in ((axes.set_xlim, widths), (axes.set_ylim, errors)):
        exponents = [math.log10(v) for v in values if v > 0]
        if exponents:
            low, high = math.floor(min(exponents)), math.ceil(max(exponents))
            set_limit(10.0**low, 10.0 ** max(high, low + 1))


def _label_levels(axes, levels):
    """Put a tick at every mesh width, and its value, where it can be as 1/n, at as many as there is
    room for.
    """
    names = [f"1/{n}" if math.isclose(n * h, 1) else f"{h:.2g}" for n, h in levels.items()]
    step = -(
        -len(levels) // (MOST_TICKS if max(map(len, names), default=0) <= 6 else MOST_TICKS // 2)
    )
    labels = [name if k % step == 0 else "" for k, name in enumerate(names)]
    axes.set_xticks(list(levels.values()), labels)
    axes.minorticks_off()


def _lowest(errors, norm):
    lowest = {}
    for row in errors:
        h, error = float(row["h"]), float(row[norm])
        lowest[h] = min(error, lowest.get(h, math.inf))
    return lowest


def _draw_triangle(axes, lowest, order):
    """Draw the slope `order` over two halvings of h, below `lowest`: the least error at each h."""
    widths = sorted(h for h, error in lowest.items() if error > 0)
    if len(widths) < 2:
        return
    first = (len(widths) - 1) // 3
    left, right = widths[first], widths[min(first + 2, len(widths) - 1)]
    low, high = axes.get_ylim()
    bottom = lowest[left] * (low / high) ** 0.12  # a fixed distance on the page
    top = bottom * (right / left) ** order
    axes.plot([left, right, right, left], [bottom, bottom, top, bottom], color=GREY, linewidth=0.7)
    offset = {"textcoords": "offset points", "fontsize": 8, "color": GREY}
    axes.annotate(
        "$1$", (math.sqrt(left * right), bottom), (0, -3), ha="center", va="top", **offset
    )
    axes.annotate(f"${order}$", (right, math.sqrt(bottom * top)), (3, 0), va="center", **offset)
