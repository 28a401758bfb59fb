"""How near other options come to the paper's table, and what each would have concluded."""

import math

import matplotlib
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm

from signorini.figures.style import ACCENT, STYLE, TEXT_WIDTH, new_figure
from signorini.figures.tiles import GAP, LABELS, add_panel, draw_tile, write_on_tile
from signorini.report.rounding import percent

H1 = {"full": "$H^1$: full norm", "semi": "$H^1$: seminorm"}
STEPS = 33  # of colour
NEAR = LinearSegmentedColormap.from_list(
    "near", ["#1d4f86", ACCENT, "#7ba7d7", "#c9dcf0", "#fbfcfe"], N=STEPS
)
BETTER = LinearSegmentedColormap.from_list(
    "better", ["#1d4f86", "#7ba7d7", "#ffffff", "#cea97b", "#87521c"], N=STEPS
)
WIDEST = 4.0  # ratios beyond, or below its inverse, have the darkest colours
DARK_MISS = 0.4  # of the scale of misses: below, text is white
DARK_RATIO = 0.62 * math.log(WIDEST)  # logarithm of a ratio: beyond, either way, text is white
RATIO_TICKS = (0.25, 0.5, 1, 2, 4)
FLAT = 0.8  # height of a tile over its width
MOST_COLUMNS = 3  # of panels of ratios

# Inches.
BELOW, ABOVE, RIGHT = 0.55, 0.2, 0.2  # the panels of matches
ROW, TITLE = 0.21, 0.36  # height of a row of ratios, and room above their panel
CAPTION, CAPTION_GAP, BAR = 0.4, 0.12, 0.09  # the scale of colours at the foot, and its bar


@matplotlib.rc_context(STYLE)
def draw_matches(rows):
    """Draw how many errors each combination matches, and by how much it misses the worst.

    Parameters
    ----------
    rows : sequence of mapping
        Of ``sensitivity.csv``, of one slope, as text or numbers. Norm rules that agree in all that
        is shown share a panel.

    Returns
    -------
    matplotlib.figure.Figure
    """
    diagonals, loads, meanings = (_distinct(rows, name) for name in ("diagonal", "load", "h1"))
    groups = _rules_alike(rows)
    width = (TEXT_WIDTH - LABELS - RIGHT - GAP * (len(groups) - 1)) / len(groups)
    height = FLAT * width * len(diagonals) / len(loads)
    figure = new_figure(TEXT_WIDTH, CAPTION + BELOW + len(meanings) * (height + GAP) + ABOVE)
    top = figure.get_figheight() - ABOVE
    colours = _colours_of_misses(rows)
    for i, (rules, table) in enumerate(groups):
        for j, h1 in enumerate(meanings):
            place = LABELS + i * (width + GAP), top - (j + 1) * height - j * GAP, width, height
            axes = add_panel(figure, place, diagonals, named=i == 0)
            lines = [[table[diagonal, load, h1] for load in loads] for diagonal in diagonals]
            _fill_matches(axes, lines, colours)
            if j == 0:
                axes.set_title(f"norms {rules}", fontsize=8)
            if i == len(groups) - 1:
                _write_beside(axes, H1[h1])
        _name_loads(axes, loads)
    _name_loads_axis(figure)
    counted, missed = f"errors matched, of {rows[0]['errors']}", "the largest relative miss"
    _draw_scale(figure, colours, f"{counted}; below, in percent, and by colour, {missed}")
    return figure


def _colours_of_misses(rows):
    misses = [float(row["largest_miss"]) for row in rows]
    return ScalarMappable(LogNorm(min(misses), max(misses)), NEAR)


def _fill_matches(axes, lines, colours):
    for y, line in enumerate(lines):
        for x, row in enumerate(line):
            miss = float(row["largest_miss"])
            dark = colours.norm(miss) < DARK_MISS
            draw_tile(axes, x, y, colours.to_rgba(miss))
            write_on_tile(axes, x + 0.5, y + 0.4, row["matched"], size=8, dark=dark)
            write_on_tile(axes, x + 0.5, y + 0.78, percent(miss), size=6, dark=dark)


def _write_beside(axes, text):
    """Write upwards along the right side of a panel."""
    axes.annotate(
        text,
        (1, 0.5),
        (5, 0),
        xycoords="axes fraction",
        textcoords="offset points",
        rotation=270,
        va="center",
        size=8,
    )


def _name_loads(axes, loads):
    middles = [k + 0.5 for k in range(len(loads))]
    axes.set_xticks(middles, loads, rotation=40, ha="right")


def _name_loads_axis(figure):
    width, height = figure.get_size_inches()
    x, y = (LABELS - 0.35) / width, (CAPTION + 0.3) / height
    figure.text(x, y, "load", ha="right", va="center", fontsize=8)


@matplotlib.rc_context(STYLE)
def draw_ratios(rows):
    """Draw the L2 error of CR relative to that of P1 on every level.

    Parameters
    ----------
    rows : sequence of mapping
        Of ``sensitivity_ratios.csv``, of one norm rule, as text or numbers. There is a panel for
        each load rule, with a row for each diagonal.

    Returns
    -------
    matplotlib.figure.Figure
    """
    diagonals, loads, levels = (_distinct(rows, name) for name in ("diagonal", "load", "n"))
    ratios = {(row["load"], row["diagonal"], row["n"]): float(row["l2"]) for row in rows}
    columns = min(len(loads), MOST_COLUMNS)
    lines = -(-len(loads) // columns)
    width = (TEXT_WIDTH - LABELS - GAP * (columns - 1)) / columns
    height = ROW * len(diagonals)
    figure = new_figure(TEXT_WIDTH, CAPTION + CAPTION_GAP + lines * (height + TITLE))
    top = figure.get_figheight()
    colours = ScalarMappable(LogNorm(1.0 / WIDEST, WIDEST), BETTER)
    for k, load in enumerate(loads):
        i, j = k % columns, k // columns
        place = LABELS + i * (width + GAP), top - (j + 1) * (height + TITLE), width, height
        axes = add_panel(figure, place, diagonals, named=i == 0)
        table = [[ratios[load, diagonal, n] for n in levels] for diagonal in diagonals]
        _fill_ratios(axes, table, colours)
        axes.set_title(f"load: {load}", fontsize=8, pad=13)
        _name_levels(axes, levels)
    meaning = "below 1, blue, NCF has the smaller, above 1, brown, CF"
    _draw_scale(figure, colours, f"$L^2$ error of NCF relative to CF: {meaning}")
    return figure


def _fill_ratios(axes, table, colours):
    for y, line in enumerate(table):
        for x, ratio in enumerate(line):
            dark = abs(math.log(ratio)) > DARK_RATIO
            draw_tile(axes, x, y, colours.to_rgba(ratio))
            write_on_tile(axes, x + 0.5, y + 0.52, f"{ratio:.2f}", size=6.5, dark=dark)


def _name_levels(axes, levels):
    axes.xaxis.tick_top()
    middles = [x + 0.5 for x in range(len(levels))]
    axes.set_xticks(middles, [f"$N={levels[0]}$", *levels[1:]])
    axes.tick_params(labelsize=7, pad=0)


def _distinct(rows, name):
    return list(dict.fromkeys(row[name] for row in rows))


def _rules_alike(rows):
    """(Names, table) of the norm rules, those with equal tables under one name."""
    groups = {}
    for rule in _distinct(rows, "rule"):
        own = [row for row in rows if row["rule"] == rule]
        table = {(row["diagonal"], row["load"], row["h1"]): row for row in own}
        shown = tuple((key, *_as_shown(row)) for key, row in table.items())
        names, _ = groups.setdefault(shown, ([], table))
        names.append(rule)
    return [(_title(names), table) for names, table in groups.values()]


def _as_shown(row):
    return row["matched"], f"{float(row['largest_miss']):.6e}"


def _title(rules):
    return " or ".join("exact" if rule == "exact" else f"by {rule}" for rule in rules)


def _draw_scale(figure, colours, label):
    """Draw the scale of colours at the foot of the figure, its meaning above."""
    width, height = figure.get_size_inches()
    left = LABELS / width
    place = (left, (CAPTION - 0.16) / height, 1 - left - 0.05, BAR / height)
    bar = figure.colorbar(colours, cax=figure.add_axes(place), orientation="horizontal")
    bar.outline.set_linewidth(0.5)
    _put_ticks(bar, colours.norm.vmin, colours.norm.vmax)
    bar.ax.minorticks_off()
    bar.ax.tick_params(length=2, width=0.5, pad=1, labelsize=7)
    figure.text(left, (CAPTION - 0.02) / height, label, va="bottom", fontsize=7.5)


def _put_ticks(bar, low, high):
    """At whole decades where there are several of them, else at simple ratios."""
    if high / low > 100:
        decades = range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1)
        bar.set_ticks([10.0**k for k in decades])
    else:
        ticks = [tick for tick in RATIO_TICKS if low <= tick <= high]
        bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
