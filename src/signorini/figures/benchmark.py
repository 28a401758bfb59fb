"""The benchmark's figures: time and unknowns against error, growth, where time goes, rivals."""

import math

import matplotlib

from signorini.errors.norms import NORMS
from signorini.figures.style import (
    ACCENT,
    ELEMENT_STYLES,
    FAINT,
    GREY,
    STYLE,
    TEXT_WIDTH,
    new_figure,
)

TITLES = {norm: NORMS[norm].axis for norm in ("l2", "h1")}  # of the norms that are drawn
LINES = (
    "-",
    (0, (4, 2)),
    (0, (1, 1.2)),
    (0, (5, 1, 1, 1)),
)  # of the routes, in the order of their appearance
STAGES = {"mesh": FAINT, "assembly": GREY, "solve": ACCENT}
MEGABYTE = 1e6
MM = 1 / 25.4

SMALL = STYLE | {
    "font.size": 7,
    "axes.labelsize": 7,
    "xtick.labelsize": 6,
    "ytick.labelsize": 6,
    "legend.fontsize": 6,
}


@matplotlib.rc_context(SMALL)
def draw_error(series):
    """Time against error: a row per scene, a column per norm.

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
        for norm in TITLES:
            shown = [row for row in rows if row[norm]]
            axes, times = panels[scene, norm], [row["total"] for row in shown]
            low = [row["total"] - row["total_min"] for row in shown]
            high = [row["total_max"] - row["total"] for row in shown]
            style = _style(series, element, method)
            axes.errorbar(
                times, [row[norm] for row in shown], xerr=[low, high], elinewidth=0.4, **style
            )
            for row in shown:
                place = {
                    "xytext": (0, 2.5 if element == "P1" else -2.5),
                    "textcoords": "offset points",
                }
                align = {"ha": "center", "va": "bottom" if element == "P1" else "top"}
                axes.annotate(
                    f"{row['n']:g}",
                    (row["total"], row[norm]),
                    fontsize=4.5,
                    color=GREY,
                    **place,
                    **align,
                )
    _finish(panels, "seconds", TITLES)
    return figure


@matplotlib.rc_context(SMALL)
def draw_growth(series, growth):
    """Time and memory against unknowns, a row per scene, with the fitted exponents.

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
    exponents = {
        tuple(row[key] for key in ("scene", "element", "method", "quantity")): row["exponent"]
        for row in growth
    }
    quantities = {"total": ("seconds", 1.0), "memory": ("megabytes", MEGABYTE)}
    figure, panels = _panels(series, list(quantities))
    for (scene, element, method), rows in series.items():
        for quantity, (_, unit) in quantities.items():
            exponent = exponents.get((scene, element, method, quantity))
            label = f"{element} {method}" + ("" if exponent is None else f" {exponent:.2f}")
            shown = [row for row in rows if row[quantity] > 0]
            values = [row[quantity] / unit for row in shown]
            style = _style(series, element, method) | {"label": label}
            panels[scene, quantity].plot([row["dofs"] for row in shown], values, **style)
    _finish(panels, "unknowns", {key: name for key, (name, _) in quantities.items()}, rising=True)
    return figure


@matplotlib.rc_context(SMALL)
def draw_dofs(series):
    """Unknowns against error: a row per norm, a column per scene; the routes of an element share a
    curve.

    `series` is as for `draw_error`; returns a matplotlib.figure.Figure.
    """
    scenes = list(dict.fromkeys(scene for scene, _, _ in series))
    figure = new_figure(TEXT_WIDTH, 80 * MM)
    grid = {
        "left": 0.075,
        "right": 0.995,
        "bottom": 0.11,
        "top": 0.93,
        "wspace": 0.12,
        "hspace": 0.12,
    }
    all_axes = figure.subplots(
        2, len(scenes), squeeze=False, sharex=True, sharey="row", gridspec_kw=grid
    )
    for (scene, element, _), rows in _longest(series).items():
        for line, norm in zip(all_axes, TITLES, strict=True):
            shown = [row for row in rows if row[norm]]
            style = {**ELEMENT_STYLES[element], "label": element, "markersize": 3, "linewidth": 0.8}
            line[scenes.index(scene)].plot(
                [row["dofs"] for row in shown], [row[norm] for row in shown], **style
            )
    for k, scene in enumerate(scenes):
        all_axes[0, k].set_title(scene, fontsize=7)
        all_axes[1, k].set_xlabel("unknowns")
    for line, title in zip(all_axes, TITLES.values(), strict=True):
        line[0].set_ylabel(title)
    for axes in all_axes.flat:
        axes.set(xscale="log", yscale="log")
        axes.minorticks_off()
    all_axes[0, 0].legend(loc="lower left")
    return figure


@matplotlib.rc_context(SMALL)
def draw_stages(series):
    """Where time goes on the finest level of each series, as shares of its total.

    `series` is as for `draw_error`; returns a matplotlib.figure.Figure.
    """
    figure = new_figure(TEXT_WIDTH, (12 + 4.2 * len(series)) * MM)
    height = figure.get_figheight() / MM
    axes = figure.add_axes((0.3, 8 / height, 0.57, 1 - 14 / height))
    for k, ((scene, element, method), rows) in enumerate(series.items()):
        finest, left = rows[-1], 0.0
        for stage, colour in STAGES.items():
            share = finest[stage] / sum(finest[name] for name in STAGES)
            axes.barh(k, share, 0.7, left, color=colour, label=stage if k == 0 else None)
            left += share
        axes.text(
            -0.01,
            k,
            f"{scene} {element} {method}, $h = 1/{finest['n']:g}$",
            ha="right",
            va="center",
        )
        axes.text(1.01, k, _seconds(finest["total"]), va="center")
    axes.set(
        xlim=(0, 1), ylim=(len(series) - 0.4, -0.6), yticks=[], xlabel="share of the total time"
    )
    axes.spines["left"].set_visible(False)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure


@matplotlib.rc_context(SMALL)
def draw_rivals(rivals, titles):
    """Time of the rivals over ours, a panel per route of ours, a point per scene, element and
    level.

    Parameters
    ----------
    rivals : sequence of dict
        Rows of rivals.csv with numbers; those with a ratio are drawn, hollow where the rival
        failed.
    titles : dict
        Rival -> name.

    Returns
    -------
    matplotlib.figure.Figure
    """
    drawn = [row for row in rivals if row["ratio"] is not None]
    names = list(dict.fromkeys(row["rival"] for row in drawn))
    routes = list(dict.fromkeys(row["ours"] for row in drawn)) or ["ours"]
    figure = new_figure(TEXT_WIDTH, (16 + 6 * len(names)) * MM)
    height = figure.get_figheight() / MM
    grid = {
        "left": 0.22,
        "right": 0.99,
        "bottom": 9 / height,
        "top": 1 - 5 / height,
        "wspace": 0.05,
    }
    all_axes = figure.subplots(
        1, len(routes), squeeze=False, sharey=True, sharex=True, gridspec_kw=grid
    )[0]
    levels = sorted({row["n"] for row in drawn})
    for axes, route in zip(all_axes, routes, strict=True):
        axes.axvline(1.0, color=GREY, linewidth=0.6)
        for row in (row for row in drawn if row["ours"] == route):
            colour = ELEMENT_STYLES[row["element"]]["color"]
            y = names.index(row["rival"]) + 0.6 * (levels.index(row["n"]) + 0.5) / len(levels) - 0.3
            fill = "white" if row["status"] == "failed" else colour
            axes.plot([row["ratio_min"], row["ratio_max"]], [y, y], color=colour, linewidth=0.4)
            axes.plot(
                row["ratio"],
                y,
                color=colour,
                marker="o",
                markersize=2,
                markerfacecolor=fill,
                markeredgewidth=0.4,
            )
        axes.set(xscale="log", xlabel="time of the rival / ours")
        axes.set_title(f"against {route}", fontsize=7)
    all_axes[0].set_yticks(range(len(names)), [titles.get(name, name) for name in names])
    all_axes[0].set_ylim(len(names) - 0.4, -0.6)
    return figure


def _panels(series, columns):
    """A figure with a row per scene, and its axes by (scene, column)."""
    scenes = list(dict.fromkeys(scene for scene, _, _ in series))
    figure = new_figure(TEXT_WIDTH, (9 + 38 * len(scenes)) * MM)
    height = figure.get_figheight() / MM
    grid = {
        "left": 0.075,
        "right": 0.995,
        "bottom": 8 / height,
        "top": 1 - 4 / height,
        "wspace": 0.16,
        "hspace": 0.22,
    }
    all_axes = figure.subplots(
        len(scenes), len(columns), squeeze=False, sharex="col", gridspec_kw=grid
    )
    return figure, {
        (scene, key): axes
        for scene, line in zip(scenes, all_axes, strict=True)
        for key, axes in zip(columns, line, strict=True)
    }


def _finish(panels, xlabel, ylabels, rising=False):
    """Axes, and legends: upper left in every panel where curves rise, else upper right in the first
    row.
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
            place = {"loc": f"upper {'left' if rising else 'right'}", "borderaxespad": 0.1}
            axes.legend(fontsize=5.5, handlelength=3, labelspacing=0.1, **place)


def _whole_decades(axes, above=0):
    """Let the ordinates run over whole decades, at least one, and some more above."""
    low, high = (math.log10(value) for value in (axes.dataLim.y0, axes.dataLim.y1))
    axes.set_ylim(
        10.0 ** math.floor(low), 10.0 ** (max(math.ceil(high), math.floor(low) + 1) + above)
    )


def _style(series, element, method):
    """Colour and marker say which element, the line which route."""
    routes = list(dict.fromkeys(method for _, _, method in series))
    line = LINES[routes.index(method) % len(LINES)]
    return {
        **ELEMENT_STYLES[element],
        "linestyle": line,
        "markersize": 2.5,
        "linewidth": 0.8,
        "label": f"{element} {method}",
    }


def _longest(series):
    """One series per scene and element: the route with the most levels."""
    best = {}
    for (scene, element, method), rows in series.items():
        key = next((key for key in best if key[:2] == (scene, element)), None)
        if key is None or len(rows) > len(best[key]):
            best.pop(key, None)
            best[scene, element, method] = rows
    return best


def _seconds(value):
    return f"{value:.2g} s" if value >= 0.0995 else f"{1e3 * value:.2g} ms"
