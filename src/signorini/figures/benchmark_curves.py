"""The benchmark's curves: time and unknowns against error, time and memory against unknowns."""

import matplotlib

from signorini.figures.benchmark_style import (
    SMALL,
    TITLES,
    add_key,
    fit_logarithmic,
    number_decades,
    scenes_of,
    style_of_rough,
    style_of_series,
)
from signorini.figures.style import ELEMENT_STYLES, GREY, MM, TEXT_WIDTH, new_figure
from signorini.report.curves import longest_series, spread

MEGABYTE = 1e6
QUANTITIES = {"total": ("seconds", 1.0), "memory": ("megabytes", MEGABYTE)}  # name and unit
_LEAST = 1e5  # bytes: what is less is round-off of the allocator
_MARGIN = 0.14
_NUMBERS = 4  # at the axis of unknowns
_FEWEST = 1000  # unknowns: what fewer need is that of modules


@matplotlib.rc_context(SMALL)
def draw_error(best, rough):
    """Draw time against error: a row per norm, a column per scene.

    Parameters
    ----------
    best : dict
        (scene, element, method) -> rows of benchmark.csv with numbers, coarsest first: one route
        for each element of a scene.
    rough : dict
        The same of solutions to discretisation accuracy.

    Returns
    -------
    matplotlib.figure.Figure
    """
    scenes = scenes_of(best)
    figure = new_figure(TEXT_WIDTH, 98 * MM)
    panels = _panels_by_norm(figure, scenes, top=0.84, sharex="col")
    for curves, style_of in ((best, _style_of_best), (rough, style_of_rough)):
        for (scene, element, _), rows in curves.items():
            for norm in TITLES:
                shown = [row for row in rows if row[norm]]
                _draw_times(panels[norm, scene], shown, norm, style_of(element))
    for (scene, norm), ends in _ends(best).items():
        _name_ends(panels[norm, scene], ends, norm)
    for scene in scenes:
        panels["l2", scene].set_title(_title(scene, best), fontsize=7)
        panels["h1", scene].set_xlabel("seconds")
    for axes in panels.values():
        fit_logarithmic(axes, _MARGIN)
    add_key(figure, panels["l2", scenes[0]], columns=2)
    return figure


def _style_of_best(element):
    style = {**ELEMENT_STYLES[element], "markersize": 2.5, "linewidth": 0.9}
    return style | {"label": f"{element} by its fastest route", "zorder": 3}


def _title(scene, best):
    """The scene, and by which route each element is drawn."""
    routes = {element: route for name, element, route in best if name == scene}
    if len(set(routes.values())) == 1:
        return f"{scene}\n{next(iter(routes.values()))}"
    return f"{scene}\n" + ", ".join(f"{element} {route}" for element, route in routes.items())


def _draw_times(axes, rows, norm, style):
    times, errors = [row["total"] for row in rows], [row[norm] for row in rows]
    axes.errorbar(times, errors, xerr=spread(rows, "total"), elinewidth=0.4, **style)


def _ends(best):
    """(scene, norm) -> the finest point of each of its curves that ends on another level."""
    ends = {}
    for (scene, _, _), rows in best.items():
        for norm in TITLES:
            known = [row for row in rows if row[norm]]
            if known:
                ends.setdefault((scene, norm), {}).setdefault(known[-1]["n"], known[-1])
    return ends


def _name_ends(axes, ends, norm):
    """Write h below the finest points; where curves end on one level, below the first alone."""
    for n, row in ends.items():
        axes.annotate(
            f"1/{n:g}",
            (row["total"], row[norm]),
            fontsize=6,
            color=GREY,
            xytext=(-2.5, -1.5),
            textcoords="offset points",
            ha="right",
            va="top",
        )


@matplotlib.rc_context(SMALL)
def draw_growth(series):
    """Draw time and memory against unknowns, a row per quantity, a column per scene.

    Parameters
    ----------
    series : dict
        As `best` for `draw_error`, of all routes.

    Returns
    -------
    matplotlib.figure.Figure
    """
    scenes = scenes_of(series)
    figure = new_figure(TEXT_WIDTH, 98 * MM)
    labels = {quantity: name for quantity, (name, _) in QUANTITIES.items()}
    panels = _panels_by(figure, labels, scenes, top=0.85)
    for (scene, element, method), rows in series.items():
        style = style_of_series(series, element, method)
        for quantity, (_, unit) in QUANTITIES.items():
            shown = [row for row in rows if quantity != "memory" or _tells(row)]
            dofs, values = [row["dofs"] for row in shown], [row[quantity] / unit for row in shown]
            panels[quantity, scene].plot(dofs, values, **style)
    for scene in scenes:
        panels["memory", scene].set_xlabel("unknowns")
    for axes in panels.values():
        fit_logarithmic(axes, _MARGIN)
        number_decades(axes.xaxis, _NUMBERS)
    add_key(figure, panels["total", scenes[0]], columns=4)
    return figure


def _tells(row):
    """Whether memory is that of the problem."""
    return row["dofs"] >= _FEWEST and row["memory"] > _LEAST


@matplotlib.rc_context(SMALL)
def draw_dofs(series):
    """Draw unknowns against error: a row per norm, a column per scene.

    Parameters
    ----------
    series : dict
        As for `draw_growth`. The routes of an element share a curve.

    Returns
    -------
    matplotlib.figure.Figure
    """
    scenes = scenes_of(series)
    figure = new_figure(TEXT_WIDTH, 80 * MM)
    panels = _panels_by_norm(figure, scenes)
    for (scene, element, _), rows in longest_series(series).items():
        style = {**ELEMENT_STYLES[element], "label": element, "markersize": 3, "linewidth": 0.8}
        for norm in TITLES:
            shown = [row for row in rows if row[norm]]
            dofs, errors = [row["dofs"] for row in shown], [row[norm] for row in shown]
            panels[norm, scene].plot(dofs, errors, **style)
    for axes in panels.values():
        axes.set(xscale="log", yscale="log")
        number_decades(axes.xaxis, _NUMBERS)
        axes.minorticks_off()
    for scene in scenes:
        panels["h1", scene].set_xlabel("unknowns")
    panels["l2", scenes[0]].legend(loc="lower left")
    return figure


def _panels_by_norm(figure, scenes, top=0.93, sharex="all"):
    """Axes by (norm, scene): a row per norm, a column per scene."""
    return _panels_by(figure, TITLES, scenes, top, sharex)


def _panels_by(figure, titles, scenes, top, sharex="all"):
    """Axes by (row, scene): a row per key of `titles`, a column per scene."""
    place = {
        "left": 0.075,
        "right": 0.995,
        "bottom": 0.11,
        "top": top,
        "wspace": 0.12 if sharex == "all" else 0.18,
        "hspace": 0.12,
    }
    rows = figure.subplots(
        len(titles),
        len(scenes),
        squeeze=False,
        sharex=sharex,
        sharey="row",
        gridspec_kw=place,
    )
    for title, row in zip(titles.values(), rows, strict=True):
        row[0].set_ylabel(title)
    for scene, column in zip(scenes, rows.T, strict=True):
        column[0].set_title(scene, fontsize=7)
    return _by_key(rows, titles, scenes)


def _by_key(rows, row_names, column_names):
    return {
        (row_name, column_name): axes
        for row_name, row in zip(row_names, rows, strict=True)
        for column_name, axes in zip(column_names, row, strict=True)
    }
