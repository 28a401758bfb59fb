"""The contact part unrolled: u over the obstacle, and below it the density of the contact force."""

import matplotlib
import numpy as np

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.elements import elements_in
from signorini.figures.style import (
    BLACK,
    CRITICAL,
    ELEMENT_STYLES,
    FAINT,
    STYLE,
    TEXT_WIDTH,
    new_figure,
)
from signorini.figures.units import tidy_ticks, unit_exponent, with_unit
from signorini.report.contact_side import critical_heights, finest_lines

MOST_MARKERS = 24  # on a line
UNITS = {  # what is counted in one unit -> the columns that share it
    "s": ("s", "critical"),
    "u": ("u", "obstacle"),
    "flux": ("flux", "threshold"),
}
LEFT, RIGHT = 0.09, 0.985  # of the panels, which are stacked
THRESHOLD = {"linestyle": (0, (1, 1.5))}
FORCE = r"contact force $k\,\mathrm{d}u/\mathrm{d}\nu$"


@matplotlib.rc_context(STYLE)
def draw_contact_line(rows):
    """Draw u with the obstacle, and the contact force, along the contact part.

    Each element is shown at its finest level.

    Parameters
    ----------
    rows : sequence of mapping
        What `signorini.fem.contact_line.contact_rows` returns, of one or more solutions, as text or
        numbers.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    ValueError
        If there is no row, or no style for an element.
    """
    lines = finest_lines(rows, elements_in(rows))
    units = {name: _to_unit(lines, columns) for name, columns in UNITS.items()}
    figure = new_figure(0.86 * TEXT_WIDTH, 0.62 * TEXT_WIDTH)
    upper = figure.add_axes((LEFT, 0.57, RIGHT - LEFT, 0.36))
    lower = figure.add_axes((LEFT, 0.2, RIGHT - LEFT, 0.28), sharex=upper)
    _draw_lines(upper, lower, lines)
    _draw_critical_points(upper, lower, lines)
    _draw_ends(upper, lower, next(iter(lines.values())))
    _name_axes(upper, lower, units)
    _set_limits(upper, lower, lines)
    figure.legend(
        loc="lower center",
        ncols=4,
        handlelength=2.6,
        columnspacing=1.6,
        borderaxespad=0.1,
    )
    return figure


def _to_unit(lines, columns):
    """Divide columns by the power of ten in which they read best; return its exponent."""
    values = np.concatenate([line[name] for line in lines.values() for name in columns])
    exponent = unit_exponent(values[~np.isnan(values)])
    for line in lines.values():
        for name in columns:
            line[name] = line[name] / 10.0**exponent
    return exponent


def _name_axes(upper, lower, units):
    names = {upper: ("$u$", "u"), lower: (FORCE, "flux")}
    for axes, (name, unit) in names.items():
        axes.set_title(with_unit(name, units[unit]), loc="left", x=-0.045, fontsize=9)
        tidy_ticks(axes.yaxis, 2.0)
    upper.tick_params(labelbottom=False)
    tidy_ticks(upper.xaxis, 5.0)
    lower.set_xlabel(with_unit("arc length $s$ along the contact part", units["s"]))


def _set_limits(upper, lower, lines):
    end = max(line["s"].max() for line in lines.values()) or 1.0
    upper.set_xlim(-0.01 * end, 1.01 * end)
    if not any(line["flux"].any() for line in lines.values()):
        lower.set_ylim(-0.05, 1)


def _by_component(line, name):
    """Abscissae and values of a column, broken by NaN between components."""
    between = np.flatnonzero(np.diff(line["component"])) + 1
    return np.insert(line["s"], between, np.nan), np.insert(line[name], between, np.nan)


def _draw_lines(upper, lower, lines):
    lower.axhline(0, color=FAINT, linewidth=0.5, zorder=1)
    for order, (element, line) in enumerate(lines.items()):
        label = f"{ELEMENT_FACTS[element].label}, {_level(line)}"
        style = ELEMENT_STYLES[element] | {
            "markersize": 3.2,
            "markevery": -(-len(line["s"]) // MOST_MARKERS),
            "zorder": 4 - 0.1 * order,
        }
        upper.plot(*_by_component(line, "u"), label=label, **style)
        lower.plot(*_by_component(line, "flux"), **style)
    first = next(iter(lines.values()))
    style = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (4, 3)), "zorder": 2}
    upper.plot(*_by_component(first, "obstacle"), label="obstacle", **style)
    if first["threshold"].any():
        lower.plot(*_by_component(first, "threshold"), label="threshold", **style | THRESHOLD)


def _level(line):
    """What tells the level: n, or the mesh width where that is not 1/n."""
    return f"$n = {line['n']}$" if line.get("h") is None else f"$h = {line['h']:.2g}$"


def _draw_critical_points(upper, lower, lines):
    """A line through both panels in the colour of the element, and a point on the obstacle."""
    label = "critical point"
    for element, line in lines.items():
        colour = ELEMENT_STYLES[element]["color"]
        style = {
            "color": colour,
            "linewidth": 0.5,
            "linestyle": (0, (1, 2)),
            "zorder": 1.5,
        }
        places, heights = critical_heights(line)
        for s in places:
            upper.axvline(s, **style)
            lower.axvline(s, **style)
        if places.size:
            marker = CRITICAL | {"markeredgecolor": colour}
            upper.plot(places, heights, "o", label=label, zorder=5, **marker)
            label = "_"  # one entry of the legend is enough


def _draw_ends(upper, lower, line):
    """A line through both panels where one component ends and the next starts."""
    for k in np.flatnonzero(np.diff(line["component"])):
        middle = 0.5 * (line["s"][k] + line["s"][k + 1])
        for axes in (upper, lower):
            axes.axvline(middle, color=FAINT, linewidth=0.8, zorder=1)
