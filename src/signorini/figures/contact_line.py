"""The contact part unrolled: u over the obstacle, what lines hide, and the contact force."""

import math

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
from signorini.report.contact_side import (
    critical_heights,
    critical_runs,
    differences,
    finest_lines,
    resultants,
    touching_intervals,
)

MOST_MARKERS = 24  # on a line
UNITS = {  # what is counted in one unit -> the columns that share it
    "s": ("s", "critical"),
    "u": ("u", "obstacle", "exact", "reference"),
    "flux": ("flux", "threshold"),
}
RIGHT = 0.985  # of the panels, which are stacked
LEFT, LETTER = 0.046, 0.0115  # of the panels without tick labels, and for each of their letters
# Height of the figure, and bottom and height of each panel: u, difference, force.
TWO = 0.62, {"u": (0.57, 0.36), "force": (0.2, 0.28)}
THREE = 0.8, {"u": (0.66, 0.285), "difference": (0.45, 0.13), "force": (0.155, 0.217)}
IN_A_ROW = 4  # entries of the legend
SECOND_ROW = 0.17  # inches
THRESHOLD = {"linestyle": (0, (6, 2, 1, 2))}  # apart from the dots of critical points
TOUCHING = "contact without force"  # the exact solution's
FORCE = r"contact force $k\,\mathrm{d}u/\mathrm{d}\nu$"


@matplotlib.rc_context(STYLE)
def draw_contact_line(rows):
    """Draw u with the obstacle, and the contact force, along the contact part.

    Each element is shown at its finest level. Between the two is the difference from the exact
    solution or from the reference, where the rows have one, or of CR from P1, where both are there:
    in the upper panel one line is under the other. Above the contact force are the whole forces.

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
    name, hidden = differences(lines)
    height, places = THREE if hidden else TWO
    figure = new_figure(0.86 * TEXT_WIDTH, height * TEXT_WIDTH)
    panels = {
        panel: figure.add_axes((LEFT, bottom, RIGHT - LEFT, tall))
        for panel, (bottom, tall) in places.items()
    }
    _draw_lines(panels["u"], panels["force"], lines)
    if hidden:
        exponent = _draw_differences(panels["difference"], lines, hidden)
        units["difference"] = units["u"] + exponent
    _draw_critical_points(panels, lines)
    _draw_touching(panels, next(iter(lines.values())))
    _draw_ends(panels.values(), next(iter(lines.values())))
    _name_axes(panels, units, name)
    _name_resultants(panels["force"], resultants(lines))
    _set_limits(panels, lines)
    _place(panels, places)
    _add_legend(figure)
    return figure


def _add_legend(figure):
    """Below all panels; one of two rows makes the figure taller."""
    count = sum(len(axes.get_legend_handles_labels()[1]) for axes in figure.axes)
    if count > IN_A_ROW:
        _lengthen(figure, SECOND_ROW)
    figure.legend(
        loc="lower center",
        ncols=IN_A_ROW if count <= IN_A_ROW else -(-count // 2),
        handlelength=2.6,
        columnspacing=1.3,
        borderaxespad=0.1,
    )


def _lengthen(figure, room):
    """Move all panels up by some inches, in a figure that is taller by as many."""
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + room)
    for axes in figure.axes:
        left, bottom, wide, tall = axes.get_position().bounds
        place = (bottom * height + room) / (height + room), tall * height / (height + room)
        axes.set_position((left, place[0], wide, place[1]))


def _to_unit(lines, columns):
    """Divide columns by the power of ten in which they read best; return its exponent."""
    values = np.concatenate([line[name] for line in lines.values() for name in columns])
    exponent = unit_exponent(values[~np.isnan(values)])
    for line in lines.values():
        for name in columns:
            line[name] = line[name] / 10.0**exponent
    return exponent


def _name_axes(panels, units, name):
    titles = {
        "u": ("$u$", "u"),
        "difference": (f"${name}$", "difference"),
        "force": (FORCE, "flux"),
    }
    for panel, axes in panels.items():
        title, unit = titles[panel]
        axes.set_title(with_unit(title, units[unit]), loc="left", x=-0.045, fontsize=9)
        tidy_ticks(axes.yaxis, 1.2 if panel == "difference" else 2.0)
        tidy_ticks(axes.xaxis, 5.0)
        axes.tick_params(labelbottom=panel == "force")
    along = with_unit("arc length $s$ along the contact part", units["s"])
    panels["force"].set_xlabel(along)


def _name_resultants(axes, forces):
    """The whole forces at the upper right, the largest with five digits."""
    if not forces:
        return
    exponent = unit_exponent(list(forces.values()))
    values = {name: force / 10.0**exponent for name, force in forces.items()}
    largest = max(abs(value) for value in values.values())
    decimals = 4 - math.floor(math.log10(largest)) if largest else 0
    texts = [f"{name} ${value:z.{max(decimals, 0)}f}$" for name, value in values.items()]
    title = with_unit("resultant", exponent)
    axes.set_title(f"{title}: {', '.join(texts)}", loc="right", fontsize=8)


def _set_limits(panels, lines):
    end = max(line["s"].max() for line in lines.values()) or 1.0
    for axes in panels.values():
        axes.set_xlim(-0.01 * end, 1.01 * end)
    if not any(line["flux"].any() for line in lines.values()):
        panels["force"].set_ylim(-0.05, 1)


def _place(panels, places):
    """Leave room at the left for the longest tick label."""
    letters = max(_letters(axes) for axes in panels.values())
    left = LEFT + LETTER * letters
    for panel, (bottom, tall) in places.items():
        panels[panel].set_position((left, bottom, RIGHT - left, tall))


def _letters(axes):
    """Of the longest tick label, without its dollars."""
    low, high = axes.get_ylim()
    ticks = [tick for tick in axes.get_yticks() if low <= tick <= high]
    return max((len(f"{tick:.6g}") for tick in ticks), default=1)


def _by_component(line, name):
    """Abscissae and values of a column, broken by NaN between components."""
    between = np.flatnonzero(np.diff(line["component"])) + 1
    return np.insert(line["s"], between, np.nan), np.insert(line[name], between, np.nan)


def _draw_lines(upper, lower, lines):
    lower.axhline(0, color=FAINT, linewidth=0.5, zorder=1)
    for order, (element, line) in enumerate(lines.items()):
        label = f"{ELEMENT_FACTS[element].label}, {_level(line)}"
        every = -(-len(line["s"]) // MOST_MARKERS)
        style = ELEMENT_STYLES[element] | {
            "markersize": 3.2,
            "markevery": (order * every // 2, every),  # none hides that of another element
            "zorder": 4 - 0.1 * order,
        }
        upper.plot(*_by_component(line, "u"), label=label, **style)
        lower.plot(*_by_component(line, "flux"), **style)
    first = next(iter(lines.values()))
    style = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (4, 3)), "zorder": 2}
    upper.plot(*_by_component(first, "obstacle"), label="obstacle", **style)
    if first["threshold"].any():
        lower.plot(*_by_component(first, "threshold"), label="threshold", **style | THRESHOLD)


def _draw_differences(axes, lines, hidden):
    """Draw differences from zero, the exponent of whose unit is returned."""
    values = np.concatenate(list(hidden.values()))
    exponent = unit_exponent(values[~np.isnan(values)])
    axes.axhline(0, color=FAINT, linewidth=0.5, zorder=1)
    for element, difference in hidden.items():
        line = lines[element] | {"difference": difference / 10.0**exponent}
        style = ELEMENT_STYLES[element] | {"marker": "", "linewidth": 0.8}
        axes.plot(*_by_component(line, "difference"), **style)
    return exponent


def _level(line):
    """What tells the level: n, or the mesh width where that is not 1/n."""
    return f"$n = {line['n']}$" if line.get("h") is None else f"$h = {line['h']:.2g}$"


def _draw_critical_points(panels, lines):
    """A line through all panels in the colour of the element, and a point on the obstacle.

    Where contact and gaps alternate, a band instead.
    """
    point, band = "critical point", "alternating contact"
    for element, line in lines.items():
        colour = ELEMENT_STYLES[element]["color"]
        style = {
            "color": colour,
            "linewidth": 0.5,
            "linestyle": (0, (1, 2)),
            "zorder": 1.5,
        }
        places, heights = critical_heights(line)
        for axes in panels.values():
            for s in places:
                axes.axvline(s, **style)
        for first, last in critical_runs(line)[1]:
            for axes in panels.values():
                label = band if axes is panels["u"] else "_"
                axes.axvspan(
                    first, last, color=FAINT, alpha=0.35, linewidth=0, label=label, zorder=0
                )
            band = "_"
        if places.size:
            marker = CRITICAL | {"markeredgecolor": colour}
            panels["u"].plot(places, heights, "o", label=point, zorder=5, **marker)
            point = "_"  # one entry of the legend is enough


def _draw_touching(panels, line):
    """Bands where the exact solution is on the obstacle without force."""
    label = TOUCHING
    for first, last in touching_intervals(line):
        for axes in panels.values():
            named = label if axes is panels["u"] else "_"
            axes.axvspan(first, last, color=FAINT, alpha=0.35, linewidth=0, label=named, zorder=0)
        label = "_"


def _draw_ends(panels, line):
    """A line through all panels where one component ends and the next starts."""
    for k in np.flatnonzero(np.diff(line["component"])):
        middle = 0.5 * (line["s"][k] + line["s"][k + 1])
        for axes in panels:
            axes.axvline(middle, color=FAINT, linewidth=0.8, zorder=1)
