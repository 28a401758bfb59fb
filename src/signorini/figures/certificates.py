"""Guaranteed bounds of the energy error against the mesh width: a band for each element."""

import matplotlib

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.convergence import label_levels, with_two_decades
from signorini.figures.elements import elements_in
from signorini.figures.style import ELEMENT_STYLES, STYLE, TEXT_WIDTH, new_figure


@matplotlib.rc_context(STYLE)
def draw_certificates(rows):
    """Draw the interval in which each energy error lies, as a band over h; both axes logarithmic.

    Parameters
    ----------
    rows : sequence of mapping
        Of certificates.csv: ``element``, ``n``, ``h``, ``lower``, ``upper``, ``error``, as text or
        numbers.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> rows = [
    ...     {"element": "CR", "n": n, "h": 1 / n, "lower": 0.9 / n, "upper": 1 / n, "error": ""}
    ...     for n in (8, 16)
    ... ]
    >>> draw_certificates(rows).axes[0].get_ylabel()
    'energy error, guaranteed'
    """
    figure = new_figure(0.49 * TEXT_WIDTH, 0.43 * TEXT_WIDTH)
    axes = figure.add_axes((0.205, 0.16, 0.775, 0.805), xscale="log", yscale="log")
    for element in elements_in(rows):
        _draw(axes, element, [row for row in rows if row["element"] == element])
    axes.set_ylim(*with_two_decades(*axes.get_ylim()))
    label_levels(axes, {int(row["n"]): float(row["h"]) for row in rows})
    axes.set(xlabel="mesh width $h$", ylabel="energy error, guaranteed")
    axes.legend(loc="upper left", handlelength=2.6, borderaxespad=0.2)
    return figure


def _draw(axes, element, rows):
    """The band of one element, its ends, and the error where it is known."""
    style, h = ELEMENT_STYLES[element], [float(row["h"]) for row in rows]
    upper = [float(row["upper"]) for row in rows]
    lower = [_positive(row, "lower") for row in rows]
    edge = {"color": style["color"], "linestyle": style["linestyle"], "linewidth": 0.9}
    axes.fill_between(h, lower, upper, color=style["color"], alpha=0.18, linewidth=0)
    axes.plot(h, upper, label=ELEMENT_FACTS[element].label, **edge)
    axes.plot(h, lower, **edge)
    known = [(width, _positive(row, "error")) for width, row in zip(h, rows, strict=True)]
    known = [(width, error) for width, error in known if error == error]
    if known:
        axes.plot(*zip(*known, strict=True), **style | {"linestyle": "none"})


def _positive(row, name):
    """A number, NaN where a logarithmic axis has no place for it."""
    text = row.get(name)
    value = float("nan") if text in (None, "") else float(text)
    return value if value > 0.0 else float("nan")
