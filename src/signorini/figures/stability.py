"""Figures of the stability suite: heat maps of success, and where round-off ends accuracy."""

import math

import matplotlib

from signorini.errors.norms import NORMS, PARTS_OF_H1
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.heat import draw_heat, name_rows_and_columns
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
from signorini.report.curves import round_off_of_aspects, round_off_of_widths, thinned

SMALL = STYLE | {
    "font.size": 7,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 6.5,
}
LARGE = {"P1": 5.5}  # a ring around the marker of another element at the same place
MARKERS = {element: style["marker"] for element, style in ELEMENT_STYLES.items()}
COLOURS = {element: style["color"] for element, style in ELEMENT_STYLES.items()}
NAMES = {element: facts.label for element, facts in ELEMENT_FACTS.items()}
TITLES = {norm: NORMS[norm].symbol for norm in PARTS_OF_H1}  # of the norms that are drawn
FAMILIES = {"smooth": ("error", "-"), "patch": ("round-off", (0, (4, 2)))}  # label and line
DIGITS = (4, 16)  # shown on the darkest ground, and on white
SOLVED = 1e-10  # stated accuracy, at most, of a solution that is called solved
_DASHED = (0, (4, 2))
_DOTTED = {"linewidth": 0.6, "linestyle": (0, (1, 1.5))}
_THIN = {"linewidth": 0.6, "zorder": 0}
_STATUSES = {  # whether called solved -> how a solution is drawn: told apart in grey by its shape
    True: {"s": 3, "color": BLACK, "linewidths": 0, "label": "solved"},
    False: {"s": 6, "color": ACCENT, "marker": "x", "linewidths": 0.5, "label": "inaccurate"},
}
TITLES_OF_PAIRS = {"u": "$u$"}


@matplotlib.rc_context(SMALL)
def draw_digits(cells):
    """Draw a heat map per element: correct digits of the worst solution.

    Parameters
    ----------
    cells : dict
        (element, family, load) -> (digits, share solved): a row of the map for each family of
        meshes, a column for each kind of load.

    Returns
    -------
    matplotlib.figure.Figure
    """
    elements, families, loads = (list(dict.fromkeys(key[k] for key in cells)) for k in range(3))
    height = 0.14 + 0.04 * len(families)
    figure = new_figure(TEXT_WIDTH, height * TEXT_WIDTH)
    for k, element in enumerate(elements):
        place = (0.13 + 0.45 * k, 0.084 / height, 0.41, 1 - 0.126 / height)
        axes = figure.add_axes(place)
        rows = [[cells[element, family, load] for load in loads] for family in families]
        values = [[digits for digits, _ in row] for row in rows]
        texts = [[_digits_text(*cell) for cell in row] for row in rows]
        draw_heat(axes, values, texts, DIGITS)
        name_rows_and_columns(axes, [""] * len(families) if k else families, loads)
        axes.set_title(NAMES[element], fontsize=8)
    return figure


def _digits_text(digits, share):
    return f"{digits:.1f}" if share == 1 else f"{digits:.1f}\n{100 * share:.0f} %"


@matplotlib.rc_context(SMALL)
def draw_rivals(by_load, by_family, titles):
    """Draw two heat maps: percent solved by each solver.

    Parameters
    ----------
    by_load, by_family : dict
        (solver, load or family of meshes) -> share between 0 and 1.
    titles : dict
        Solver -> its name.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, (0.12 + 0.032 * len(titles)) * TEXT_WIDTH)
    for k, cells in enumerate((by_load, by_family)):
        axes = figure.add_axes((0.245 + 0.375 * k, 0.2, 0.365, 0.75))
        axes.set_title(("percent solved, by load", "by family of meshes")[k], fontsize=8, pad=3)
        columns = list(dict.fromkeys(column for _, column in cells))
        values = [[cells.get((name, column), math.nan) for column in columns] for name in titles]
        texts = [[_percent_text(share) for share in row] for row in values]
        draw_heat(axes, values, texts, (0, 1))
        name_rows_and_columns(axes, [""] * len(titles) if k else titles.values(), columns)
    return figure


def _percent_text(share):
    return "" if math.isnan(share) else f"{math.floor(100 * share)}"


def _two_panels(figure, below=0.0):
    """Two logarithmic axes side by side, a share of the height left free below."""
    for k in (0, 1):
        place = (0.085 + 0.5 * k, 0.14 + below, 0.395, 0.76 - below)
        yield figure.add_axes(place, xscale="log", yscale="log")


@matplotlib.rc_context(SMALL)
def draw_estimates(pairs, span):
    """Draw stated accuracy against true error, a panel for u and one for the contact forces.

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
    for (title, points), axes in zip(pairs.items(), _two_panels(figure), strict=False):
        _draw_span(axes, (1e-18, 1.0), span)
        for solved, style in _STATUSES.items():
            own = [(error, accuracy) for error, accuracy, status in points if status == solved]
            axes.scatter(*thinned(own), **style)
        _draw_solved(axes)
        axes.set(xlabel="true error", title=TITLES_OF_PAIRS.get(title, title))
        axes.title.set_fontsize(8)
    figure.axes[0].set_ylabel("accuracy as stated")
    axes.legend(loc="upper left", markerscale=1.8)
    return figure


def _draw_solved(axes):
    """The stated accuracy below which a solution is called solved."""
    axes.axhline(SOLVED, color=FAINT, **_THIN)
    axes.annotate(
        "solved below",
        (1.0, SOLVED),
        (-2, 2),
        xycoords=axes.get_yaxis_transform(),
        textcoords="offset points",
        fontsize=6.5,
        color=GREY,
        ha="right",
    )


def _draw_span(axes, ends, span):
    """The diagonal of a square of axes, and the lines that miss it by factors, dashed."""
    for factor in (1 / span[0], 1.0, span[1]):
        line = "-" if factor == 1 else _DASHED
        axes.plot(ends, [factor * x for x in ends], color=GREY, linestyle=line, **_THIN)
    axes.set(xlim=ends, ylim=ends)


@matplotlib.rc_context(SMALL)
def draw_floor(errors, lines):
    """Draw errors against h, a panel per norm: truncation falls, round-off rises.

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
    figure = new_figure(TEXT_WIDTH, 0.54 * TEXT_WIDTH)
    levels = sorted({row["n"] for row in errors})
    labelled = levels[::-2]
    for (norm, title), axes in zip(TITLES.items(), _two_panels(figure, 0.17), strict=True):
        for element in COLOURS:
            own = [row for row in errors if row["element"] == element]
            _draw_families(axes, own, element, norm)
            _draw_condition(axes, own, element, lines[element])
        axes.set_xticks([1 / n for n in labelled], [f"1/{n:.0f}" for n in labelled])
        axes.minorticks_off()
        axes.set(xlabel="mesh width $h$", title=title)
        axes.title.set_fontsize(8)
    _name_what_is_drawn(figure)
    return figure


def _name_what_is_drawn(figure):
    """A legend at the foot, with an entry for each label that some panel has."""
    drawn = {}
    for axes in figure.axes:
        handles, labels = axes.get_legend_handles_labels()
        drawn |= dict(zip(labels, handles, strict=True)) | drawn
    figure.legend(drawn.values(), drawn, loc="lower center", ncols=2, handlelength=3)


def _draw_families(axes, rows, element, norm):
    style = {"color": COLOURS[element], "marker": MARKERS[element], "markersize": 3}
    if element in LARGE:
        style |= {"markersize": LARGE[element], "markerfacecolor": "none", "zorder": 3}
    for family, (name, line) in FAMILIES.items():
        shown = [row for row in rows if row["family"] == family and row[norm] > 0]
        if not shown:
            continue
        widths, errors = [1 / row["n"] for row in shown], [row[norm] for row in shown]
        label = f"{NAMES[element]}, {name}"
        axes.plot(widths, errors, linestyle=line, label=label, **style)


def _draw_condition(axes, rows, element, line):
    widths = [1 / row["n"] for row in rows if row["family"] == "patch"]
    bound = round_off_of_widths(widths, *line)
    label = f"{NAMES[element]}, eps times condition"
    axes.plot(widths, bound, color=COLOURS[element], label=label, **_DOTTED)


@matplotlib.rc_context(SMALL)
def draw_stretched(rows):
    """Draw error of the patch test and stated accuracy against the aspect of the cells.

    Beside them, eps times condition.

    Parameters
    ----------
    rows : sequence of dict
        ``element``, ``aspect``, ``error``, ``accuracy`` (None where the solve was refused),
        ``condition``, ``status``.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(0.95 * TEXT_WIDTH, 0.42 * TEXT_WIDTH)
    axes = figure.add_axes((0.1, 0.17, 0.55, 0.79), xscale="log", yscale="log")
    for element in dict.fromkeys(row["element"] for row in rows):
        own = [row for row in rows if row["element"] == element]
        _draw_patch_test(axes, [row for row in own if row["error"]], element)
        bound = round_off_of_aspects(own)
        axes.plot(
            *bound,
            color=COLOURS[element],
            label=f"{NAMES[element]}, eps times condition",
            **_DOTTED,
        )
    _draw_solved(axes)
    axes.set(xlabel="height over width of the cells", ylabel="relative error")
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), handlelength=3)
    return figure


def _draw_patch_test(axes, rows, element):
    """Errors, hollow where the solve was inaccurate, and the accuracies stated, dashed."""
    colour = COLOURS[element]
    aspects = [row["aspect"] for row in rows]
    errors, stated = [row["error"] for row in rows], [row["accuracy"] for row in rows]
    fills = [colour if row["status"] == "solved" else "white" for row in rows]
    axes.plot(aspects, errors, color=colour, label=f"{NAMES[element]}, error")
    axes.scatter(aspects, errors, 9, fills, MARKERS[element], edgecolors=colour, zorder=3)
    axes.plot(
        aspects,
        stated,
        color=colour,
        linewidth=0.7,
        linestyle=_DASHED,
        label=f"{NAMES[element]}, stated accuracy",
    )
