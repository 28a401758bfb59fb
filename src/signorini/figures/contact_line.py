"""The contact part unrolled: u over the obstacle, and below it the density of the contact force."""

import matplotlib
import numpy as np

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.field import CRITICAL, tidy_ticks, unit_exponent, with_unit
from signorini.figures.style import BLACK, ELEMENT_STYLES, FAINT, STYLE, TEXT_WIDTH, new_figure

MOST_MARKERS = 24  # on a line
NUMBERS = ("component", "s", "u", "obstacle", "flux", "critical")
UNITS = {
    "s": ("s", "critical"),
    "u": ("u", "obstacle"),
    "flux": ("flux",),
}  # the columns that share one
LEFT, RIGHT = 0.09, 0.985  # of the panels, which are stacked


@matplotlib.rc_context(STYLE)
def draw_contact_line(rows):
    """Draw u with the obstacle, and the contact force, along the contact part: each element at its
    finest level.

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
    lines = _finest(rows)
    units = {name: _to_unit(lines, columns) for name, columns in UNITS.items()}
    figure = new_figure(0.86 * TEXT_WIDTH, 0.62 * TEXT_WIDTH)
    upper = figure.add_axes((LEFT, 0.57, RIGHT - LEFT, 0.36))
    lower = figure.add_axes((LEFT, 0.2, RIGHT - LEFT, 0.28), sharex=upper)
    _draw_lines(upper, lower, lines)
    _draw_critical_points(upper, lower, lines)
    _draw_ends(upper, lower, next(iter(lines.values())))
    _name_axes(upper, lower, units)
    end = max(line["s"].max() for line in lines.values()) or 1.0
    upper.set_xlim(-0.01 * end, 1.01 * end)
    if not any(line["flux"].any() for line in lines.values()):
        lower.set_ylim(-0.05, 1)
    figure.legend(
        loc="lower center", ncols=4, handlelength=2.6, columnspacing=1.6, borderaxespad=0.1
    )
    return figure


def _finest(rows):
    """The columns of each element's finest level by name, in the order of the rows; a missing
    number is NaN.
    """
    if not rows:
        raise ValueError("contact line: no rows; there is nothing to draw without a contact part")
    lines = {}
    for name in dict.fromkeys(row["element"] for row in rows):
        if name not in ELEMENT_STYLES:
            known = ", ".join(ELEMENT_STYLES)
            raise ValueError(f"no style for the element {name!r}; known: {known}")
        n = max(int(row["n"]) for row in rows if row["element"] == name)
        found = [row for row in rows if row["element"] == name and int(row["n"]) == n]
        columns = {
            key: [np.nan if row[key] in (None, "") else float(row[key]) for row in found]
            for key in NUMBERS
        }
        lines[name] = {key: np.array(column) for key, column in columns.items()} | {"n": n}
    return lines


def _to_unit(lines, columns):
    """Divide the columns of all lines by the power of ten in which they read best; return its
    exponent.
    """
    values = np.concatenate([line[name] for line in lines.values() for name in columns])
    exponent = unit_exponent(values[~np.isnan(values)])
    for line in lines.values():
        line.update({name: line[name] / 10.0**exponent for name in columns})
    return exponent


def _name_axes(upper, lower, units):
    names = {upper: ("$u$", "u"), lower: (r"contact force $k\,\mathrm{d}u/\mathrm{d}\nu$", "flux")}
    for axes, (name, unit) in names.items():
        axes.set_title(with_unit(name, units[unit]), loc="left", x=-0.045, fontsize=9)
        tidy_ticks(axes.yaxis, 2.0)
    upper.tick_params(labelbottom=False)
    tidy_ticks(upper.xaxis, 5.0)
    lower.set_xlabel(with_unit("arc length $s$ along the contact part", units["s"]))


def _by_component(line, name):
    """Abscissae and values of a column, broken by NaN between components."""
    between = np.flatnonzero(np.diff(line["component"])) + 1
    return np.insert(line["s"], between, np.nan), np.insert(line[name], between, np.nan)


def _draw_lines(upper, lower, lines):
    lower.axhline(0, color=FAINT, linewidth=0.5, zorder=1)
    for order, (name, line) in enumerate(lines.items()):
        label, style = ELEMENT_FACTS[name].label, ELEMENT_STYLES[name]
        style = style | {
            "markersize": 3.2,
            "markevery": -(-len(line["s"]) // MOST_MARKERS),
            "zorder": 4 - 0.1 * order,
        }
        upper.plot(*_by_component(line, "u"), label=f"{label}, $n = {line['n']}$", **style)
        lower.plot(*_by_component(line, "flux"), **style)
    style = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (4, 3)), "zorder": 2}
    upper.plot(*_by_component(next(iter(lines.values())), "obstacle"), label="obstacle", **style)


def _draw_critical_points(upper, lower, lines):
    """A line through both panels in the style of the element, and a point on the obstacle."""
    label = "critical point"
    for name, line in lines.items():
        colour = ELEMENT_STYLES[name]["color"]
        style = {"color": colour, "linewidth": 0.5, "linestyle": (0, (1, 2)), "zorder": 1.5}
        marker = CRITICAL | {"markeredgecolor": colour}
        at = line["critical"][~np.isnan(line["critical"])]
        for s in at:
            upper.axvline(s, **style)
            lower.axvline(s, **style)
        if at.size:
            upper.plot(
                at, np.interp(at, line["s"], line["obstacle"]), "o", label=label, zorder=5, **marker
            )
            label = "_"


def _draw_ends(upper, lower, line):
    """A line through both panels where one component ends and the next starts."""
    for k in np.flatnonzero(np.diff(line["component"])):
        for axes in (upper, lower):
            axes.axvline(
                0.5 * (line["s"][k] + line["s"][k + 1]), color=FAINT, linewidth=0.8, zorder=1
            )
