"""Figures of the stability suite: heat maps of success, and where round-off ends accuracy."""

import math

import matplotlib

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.style import (
    ACCENT,
    BLACK,
    ELEMENT_STYLES,
    FAINT,
    GREY,
    STYLE,
    TEXT_WIDTH,
    new_figure,
)

SMALL = STYLE | {
    "font.size": 7,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 6.5,
}
MARKERS = {element: style["marker"] for element, style in ELEMENT_STYLES.items()}
COLOURS = {element: style["color"] for element, style in ELEMENT_STYLES.items()}
NAMES = {element: facts.label for element, facts in ELEMENT_FACTS.items()}
TITLES = {norm: NORMS[norm].symbol for norm in ("l2", "h1_semi")}  # of the norms that are drawn
EPS = 2.0**-52


@matplotlib.rc_context(SMALL)
def draw_digits(cells):
    """A heat map per element: correct digits of the worst solution, for each family of meshes and
    kind of load.

    Parameters
    ----------
    cells : dict
        (element, family, load) -> (digits, share solved).

    Returns
    -------
    matplotlib.figure.Figure
    """
    elements, families, loads = (list(dict.fromkeys(key[k] for key in cells)) for k in range(3))
    height = 0.14 + 0.04 * len(families)
    figure = new_figure(TEXT_WIDTH, height * TEXT_WIDTH)
    for k, element in enumerate(elements):
        axes = figure.add_axes((0.13 + 0.45 * k, 0.084 / height, 0.41, 1 - 0.126 / height))
        values = [[cells[element, family, load][0] for load in loads] for family in families]
        shares = [[cells[element, family, load][1] for load in loads] for family in families]
        texts = [
            [_digits_text(*cell) for cell in zip(*row, strict=True)]
            for row in zip(values, shares, strict=True)
        ]
        _heat(axes, values, texts, (4, 16))
        axes.set_xticks(range(len(loads)), loads, rotation=40, ha="right", rotation_mode="anchor")
        axes.set_yticks(range(len(families)), families if k == 0 else [""] * len(families))
        axes.set_title(NAMES[element], fontsize=8)
    return figure


@matplotlib.rc_context(SMALL)
def draw_rivals(by_load, by_family, titles):
    """Two heat maps: percent solved by each solver, for each kind of load and for each family of
    meshes.

    Parameters
    ----------
    by_load, by_family : dict
        (solver, load or family) -> share between 0 and 1.
    titles : dict
        Solver -> its name.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, (0.12 + 0.032 * len(titles)) * TEXT_WIDTH)
    for k, cells in enumerate((by_load, by_family)):
        columns = list(dict.fromkeys(column for _, column in cells))
        axes = figure.add_axes((0.245 + 0.375 * k, 0.2, 0.365, 0.76))
        values = [
            [cells.get((solver, column), math.nan) for column in columns] for solver in titles
        ]
        texts = [["" if math.isnan(v) else f"{math.floor(100 * v)}" for v in row] for row in values]
        _heat(axes, values, texts, (0, 1))
        axes.set_xticks(
            range(len(columns)), columns, rotation=40, ha="right", rotation_mode="anchor"
        )
        axes.set_yticks(range(len(titles)), titles.values() if k == 0 else [""] * len(titles))
    return figure


def _digits_text(digits, share):
    return f"{digits:.1f}" if share == 1 else f"{digits:.1f}\n{100 * share:.0f} %"


def _heat(axes, values, texts, limits):
    """A table of numbers on a ground that is the darker the smaller they are."""
    colours = matplotlib.colors.LinearSegmentedColormap.from_list("faint", [ACCENT, "white"])
    axes.imshow(values, cmap=colours, vmin=limits[0], vmax=limits[1], aspect="auto")
    middle = 0.35 * limits[1] + 0.65 * limits[0]
    for i, row in enumerate(texts):
        for j, text in enumerate(row):
            dark = values[i][j] < middle
            axes.text(
                j, i, text, ha="center", va="center", fontsize=6.5, color="white" if dark else BLACK
            )
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(True)


@matplotlib.rc_context(SMALL)
def draw_estimates(pairs, span):
    """Stated accuracy against true error, a panel for u and one for the contact forces.

    Parameters
    ----------
    pairs : dict
        Title of a panel -> sequence of (error, accuracy, whether called solved), both positive.
    span : tuple of float
        By which factors accuracy over error may miss one, down and up.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, 0.46 * TEXT_WIDTH)
    for k, (title, points) in enumerate(pairs.items()):
        axes = figure.add_axes((0.085 + 0.5 * k, 0.14, 0.405, 0.76), xscale="log", yscale="log")
        line = [1e-18, 1.0]
        for factor in (1 / span[0], 1.0, span[1]):
            look = {"linewidth": 0.6, "linestyle": "-" if factor == 1 else (0, (4, 2)), "zorder": 0}
            axes.plot(line, [factor * x for x in line], color=GREY, **look)
        for solved, colour, label in ((True, BLACK, "solved"), (False, ACCENT, "inaccurate")):
            x, y = _thinned([(error, accuracy) for error, accuracy, own in points if own == solved])
            axes.scatter(x, y, 3, colour, linewidths=0, label=label)
        axes.axhline(1e-10, color=FAINT, linewidth=0.6, zorder=0)
        axes.set(
            xlabel="true error",
            ylabel="" if k else "accuracy as stated",
            title=title,
            xlim=line,
            ylim=line,
        )
        axes.title.set_fontsize(8)
    axes.legend(loc="upper left")
    return figure


def _thinned(points):
    """One point for each tenth of a decade either way."""
    cells = {tuple(round(10 * math.log10(value)) for value in point) for point in points}
    return [[10 ** (cell[k] / 10) for cell in sorted(cells)] for k in (0, 1)]


@matplotlib.rc_context(SMALL)
def draw_floor(errors, lines):
    """Errors against h, a panel per norm: truncation falls, round-off rises.

    Parameters
    ----------
    errors : sequence of dict
        Rows with ``family`` (smooth or patch), ``element``, ``n``, ``l2``, ``h1_semi``.
    lines : dict
        Element -> (exponent, factor) of its condition number in n: the line eps times condition.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, 0.46 * TEXT_WIDTH)
    for k, (norm, title) in enumerate(TITLES.items()):
        axes = figure.add_axes((0.085 + 0.5 * k, 0.14, 0.405, 0.76), xscale="log", yscale="log")
        for element in COLOURS:
            style = {"color": COLOURS[element], "marker": MARKERS[element], "markersize": 3}
            for family, look in (("smooth", "-"), ("patch", (0, (4, 2)))):
                own = [
                    r
                    for r in errors
                    if (r["element"], r["family"]) == (element, family) and r[norm] > 0
                ]
                label = f"{NAMES[element]}, {'error' if family == 'smooth' else 'round-off'}"
                axes.plot(
                    [1 / r["n"] for r in own],
                    [r[norm] for r in own],
                    linestyle=look,
                    label=label,
                    **style,
                )
            exponent, factor = lines[element]
            widths = [
                1 / r["n"] for r in errors if (r["element"], r["family"]) == (element, "patch")
            ]
            bound = [EPS * factor * h**-exponent for h in widths]
            label = f"eps times condition, {element}"
            axes.plot(
                widths,
                bound,
                color=COLOURS[element],
                linewidth=0.6,
                linestyle=(0, (1, 1.5)),
                label=label,
            )
        levels = sorted({row["n"] for row in errors})
        axes.set_xticks([1 / n for n in levels[::-2]], [f"1/{n:.0f}" for n in levels[::-2]])
        axes.minorticks_off()
        axes.set(xlabel="mesh width $h$", title=title)
        axes.title.set_fontsize(8)
    axes.legend(loc="center right", bbox_to_anchor=(1.0, 0.64), handlelength=3)
    return figure


@matplotlib.rc_context(SMALL)
def draw_stretched(rows):
    """Error of the patch test, stated accuracy, and eps times condition against the aspect of the
    cells.

    Parameters
    ----------
    rows : sequence of dict
        ``element``, ``aspect``, ``error``, ``accuracy`` (None where the solve was refused),
        ``condition``, ``status``.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(0.62 * TEXT_WIDTH, 0.42 * TEXT_WIDTH)
    axes = figure.add_axes((0.13, 0.15, 0.84, 0.81), xscale="log", yscale="log")
    for element in dict.fromkeys(row["element"] for row in rows):
        own = [row for row in rows if row["element"] == element]
        found = [row for row in own if row["error"]]
        colour, x = COLOURS[element], [row["aspect"] for row in found]
        filled = [colour if row["status"] == "solved" else "white" for row in found]
        y = [row["error"] for row in found]
        axes.plot(x, y, color=colour, label=f"{NAMES[element]}, error")
        axes.scatter(x, y, 9, filled, MARKERS[element], edgecolors=colour, zorder=3)
        stated = [row["accuracy"] for row in found]
        axes.plot(
            x,
            stated,
            color=colour,
            linewidth=0.7,
            linestyle=(0, (4, 2)),
            label="accuracy as stated",
        )
        regular = [row for row in own if 0 < row["condition"] < 1 / EPS]
        bound = [[row["aspect"], EPS * row["condition"]] for row in regular]
        dotted = {"color": colour, "linewidth": 0.6, "linestyle": (0, (1, 1.5))}
        axes.plot(*zip(*bound, strict=True), label="eps times condition", **dotted)
    axes.axhline(1e-10, color=FAINT, linewidth=0.6, zorder=0)
    place = {"xytext": (-2, 2), "textcoords": "offset points", "ha": "right"}
    axes.annotate("solved below", (1.0, 1e-10), fontsize=6.5, color=GREY, **place)
    axes.set(xlabel="height over width of the cells", ylabel="relative error")
    axes.legend(loc="upper right", handlelength=3)
    return figure
