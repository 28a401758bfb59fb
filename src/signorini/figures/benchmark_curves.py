"""The benchmark's curves: time and unknowns against error, time and memory against unknowns."""

import math

import matplotlib

from signorini.figures.benchmark_style import SMALL, TITLES, scenes_of, style_of_series
from signorini.figures.style import ELEMENT_STYLES, GREY, MM, TEXT_WIDTH, new_figure
from signorini.report.curves import longest_series, spread

MEGABYTE = 1e6
QUANTITIES = {"total": ("seconds", 1.0), "memory": ("megabytes", MEGABYTE)}  # name and unit


@matplotlib.rc_context(SMALL)
def draw_error(series):
    """Draw time against error: a row per scene, a column per norm.

    Parameters
    ----------
    series : dict
        (scene, element, method) -> rows of benchmark.csv with numbers, coarsest first.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure, panels = _panels(series, list(TITLES))
    for (scene, element, method), rows in series.items():
        style = style_of_series(series, element, method)
        for norm in TITLES:
            shown = [row for row in rows if row[norm]]
            _draw_times(panels[scene, norm], shown, norm, style)
            _name_levels(panels[scene, norm], shown, norm, above=element == "P1")
    _finish(panels, "seconds", TITLES)
    return figure


def _draw_times(axes, rows, norm, style):
    times, errors = [row["total"] for row in rows], [row[norm] for row in rows]
    axes.errorbar(times, errors, xerr=spread(rows, "total"), elinewidth=0.4, **style)


def _name_levels(axes, rows, norm, above):
    """Write the level beside every point."""
    side, align = (1, "bottom") if above else (-1, "top")
    for row in rows:
        axes.annotate(
            f"{row['n']:g}",
            (row["total"], row[norm]),
            fontsize=4.5,
            color=GREY,
            xytext=(0, side * 2.5),
            textcoords="offset points",
            ha="center",
            va=align,
        )


@matplotlib.rc_context(SMALL)
def draw_growth(series, growth):
    """Draw time and memory against unknowns, a row per scene, with the fitted exponents.

    Parameters
    ----------
    series : dict
        As for `draw_error`.
    growth : sequence of dict
        Rows with ``scene``, ``element``, ``method``, ``quantity`` and ``exponent``.

    Returns
    -------
    matplotlib.figure.Figure
    """
    keys = ("scene", "element", "method", "quantity")
    exponents = {tuple(row[key] for key in keys): row["exponent"] for row in growth}
    figure, panels = _panels(series, list(QUANTITIES))
    for (scene, element, method), rows in series.items():
        style = style_of_series(series, element, method)
        for quantity, (_, unit) in QUANTITIES.items():
            exponent = exponents.get((scene, element, method, quantity))
            label = style["label"] + ("" if exponent is None else f" {exponent:.2f}")
            shown = [row for row in rows if row[quantity] > 0]
            dofs, values = [row["dofs"] for row in shown], [row[quantity] / unit for row in shown]
            panels[scene, quantity].plot(dofs, values, **style | {"label": label})
    labels = {quantity: name for quantity, (name, _) in QUANTITIES.items()}
    _finish(panels, "unknowns", labels, rising=True)
    return figure


@matplotlib.rc_context(SMALL)
def draw_dofs(series):
    """Draw unknowns against error: a row per norm, a column per scene.

    Parameters
    ----------
    series : dict
        As for `draw_error`. The routes of an element share a curve.

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
        axes.minorticks_off()
    panels["l2", scenes[0]].legend(loc="lower left")
    return figure


def _panels_by_norm(figure, scenes):
    """Axes by (norm, scene): a row per norm, a column per scene."""
    place = {
        "left": 0.075,
        "right": 0.995,
        "bottom": 0.11,
        "top": 0.93,
        "wspace": 0.12,
        "hspace": 0.12,
    }
    rows = figure.subplots(
        len(TITLES),
        len(scenes),
        squeeze=False,
        sharex=True,
        sharey="row",
        gridspec_kw=place,
    )
    for title, row in zip(TITLES.values(), rows, strict=True):
        row[0].set_ylabel(title)
    for scene, column in zip(scenes, rows.T, strict=True):
        column[0].set_title(scene, fontsize=7)
        column[-1].set_xlabel("unknowns")
    return _by_key(rows, TITLES, scenes)


def _panels(series, columns):
    """A figure with a row per scene, and its axes by (scene, column)."""
    scenes = scenes_of(series)
    figure = new_figure(TEXT_WIDTH, (9 + 38 * len(scenes)) * MM)
    height = figure.get_figheight() / MM
    place = {
        "left": 0.075,
        "right": 0.995,
        "bottom": 8 / height,
        "top": 1 - 4 / height,
        "wspace": 0.16,
        "hspace": 0.22,
    }
    rows = figure.subplots(
        len(scenes),
        len(columns),
        squeeze=False,
        sharex="col",
        gridspec_kw=place,
    )
    return figure, _by_key(rows, scenes, columns)


def _by_key(rows, row_names, column_names):
    return {
        (row_name, column_name): axes
        for row_name, row in zip(row_names, rows, strict=True)
        for column_name, axes in zip(column_names, row, strict=True)
    }


def _finish(panels, xlabel, ylabels, rising=False):
    """Set scales, titles and legends.

    Where curves rise, every panel has a legend in its upper left corner; else only those of the
    first row have one, in the upper right.
    """
    scenes = list(dict.fromkeys(scene for scene, _ in panels))
    for (scene, key), axes in panels.items():
        axes.set(xscale="log", yscale="log", ylabel=ylabels[key])
        axes.set_title(scene, fontsize=7, pad=2)
        axes.minorticks_off()
        _whole_decades(axes, above=int(rising))  # room for the legend
        if scene == scenes[-1]:
            axes.set_xlabel(xlabel)
        if rising or scene == scenes[0]:
            axes.legend(
                loc="upper left" if rising else "upper right",
                fontsize=5.5,
                handlelength=3,
                labelspacing=0.1,
                borderaxespad=0.1,
            )


def _whole_decades(axes, above=0):
    """Let the ordinates run over whole decades, at least one, and some more above."""
    low = math.floor(math.log10(axes.dataLim.y0))
    high = math.ceil(math.log10(axes.dataLim.y1))
    axes.set_ylim(10.0**low, 10.0 ** (max(high, low + 1) + above))
