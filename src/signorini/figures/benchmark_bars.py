"""Where the benchmark's time goes, and the time of the rivals over ours."""

import matplotlib

from signorini.figures.benchmark_style import SMALL
from signorini.figures.style import ACCENT, ELEMENT_STYLES, FAINT, GREY, MM, TEXT_WIDTH, new_figure
from signorini.report.curves import stacked_shares

STAGES = {"mesh": FAINT, "assembly": GREY, "solve": ACCENT}
BAND = 0.6  # of a rival's row, which its levels share


@matplotlib.rc_context(SMALL)
def draw_stages(series):
    """Draw where time goes on the finest level of each series, as shares of its total.

    Parameters
    ----------
    series : dict
        As for `benchmark_curves.draw_error`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, (12 + 4.2 * len(series)) * MM)
    height = figure.get_figheight() / MM
    axes = figure.add_axes((0.3, 8 / height, 0.57, 1 - 14 / height))
    for k, ((scene, element, method), rows) in enumerate(series.items()):
        finest = rows[-1]
        _draw_bar(axes, k, finest, labelled=k == 0)
        name = f"{scene} {element} {method}, $h = 1/{finest['n']:g}$"
        axes.text(-0.01, k, name, ha="right", va="center")
        axes.text(1.01, k, _seconds(finest["total"]), va="center")
    axes.set(
        xlim=(0, 1),
        ylim=(len(series) - 0.4, -0.6),
        yticks=[],
        xlabel="share of the total time",
    )
    axes.spines["left"].set_visible(False)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return figure


def _draw_bar(axes, y, row, labelled):
    for stage, start, length in stacked_shares(row, STAGES):
        label = stage if labelled else None
        axes.barh(y, length, 0.7, start, color=STAGES[stage], label=label)


def _seconds(value):
    return f"{value:.2g} s" if value >= 0.0995 else f"{1e3 * value:.2g} ms"


@matplotlib.rc_context(SMALL)
def draw_rivals(rivals, titles):
    """Draw the time of the rivals over ours.

    There is a panel per route of ours, and a point per scene, element and level.

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
    levels = sorted({row["n"] for row in drawn})
    figure, panels = _panels(drawn, names)
    for route, axes in panels.items():
        axes.axvline(1.0, color=GREY, linewidth=0.6)
        for row in drawn:
            if row["ours"] == route:
                _draw_ratio(axes, _ordinate(row, names, levels), row)
        axes.set(xscale="log", xlabel="time of the rival / ours")
        axes.set_title(f"against {route}", fontsize=7)
    first = next(iter(panels.values()))
    first.set_yticks(range(len(names)), [titles.get(name, name) for name in names])
    first.set_ylim(len(names) - 0.4, -0.6)
    return figure


def _panels(drawn, names):
    """A figure with a row for each of `names`, and its axes by the route of ours."""
    routes = list(dict.fromkeys(row["ours"] for row in drawn)) or ["ours"]
    figure = new_figure(TEXT_WIDTH, (16 + 6 * len(names)) * MM)
    height = figure.get_figheight() / MM
    place = {
        "left": 0.22,
        "right": 0.99,
        "bottom": 9 / height,
        "top": 1 - 5 / height,
        "wspace": 0.05,
    }
    (row,) = figure.subplots(
        1,
        len(routes),
        squeeze=False,
        sharey=True,
        sharex=True,
        gridspec_kw=place,
    )
    return figure, dict(zip(routes, row, strict=True))


def _ordinate(row, names, levels):
    """In the row of its rival, where the levels share a band, the coarsest on top."""
    place = (levels.index(row["n"]) + 0.5) / len(levels)
    return names.index(row["rival"]) + BAND * place - BAND / 2


def _draw_ratio(axes, y, row):
    colour = ELEMENT_STYLES[row["element"]]["color"]
    axes.plot([row["ratio_min"], row["ratio_max"]], [y, y], color=colour, linewidth=0.4)
    axes.plot(
        row["ratio"],
        y,
        color=colour,
        marker="o",
        markersize=2,
        markerfacecolor="white" if row["status"] == "failed" else colour,
        markeredgewidth=0.4,
    )
