"""How near every combination of the unsaid choices comes to the paper's table, and what each would
have concluded.
"""

import math

import matplotlib
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm

from signorini.figures.style import ACCENT, BLACK, GREY, STYLE, TEXT_WIDTH, new_figure
from signorini.report.tables import percent

DIAGONALS = {
    "falling": "falling",
    "rising": "rising",
    "alternating": "alternating\n(falling)",
    "alternating-rising": "alternating\n(rising)",
    "criss-cross": "criss-cross",
}
H1 = {"full": "$H^1$: full norm", "semi": "$H^1$: seminorm"}
STEPS = 33  # of colour
NEAR = LinearSegmentedColormap.from_list(
    "near", ["#1d4f86", ACCENT, "#7ba7d7", "#c9dcf0", "#fbfcfe"], N=STEPS
)
BETTER = LinearSegmentedColormap.from_list(
    "better", ["#1d4f86", "#7ba7d7", "#ffffff", "#cea97b", "#87521c"], N=STEPS
)
FLAT = 0.8  # height of a tile over its width
WIDEST = 4.0  # ratios beyond, or below its inverse, have the darkest colours

# Inches.
LABELS, BELOW, ABOVE, GAP, BAR, CAPTION = 1.08, 0.55, 0.2, 0.1, 0.09, 0.4

_CUTS = {"/": ((0, 1), (0, 1)), "\\": ((0, 1), (1, 0))}
_FIRST = {
    "falling": "\\\\",
    "rising": "//",
    "alternating": "\\/",
    "alternating-rising": "/\\",
}  # of two cells in a row


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
    side = (TEXT_WIDTH - LABELS - 0.2 - GAP * (len(groups) - 1)) / len(groups)
    height = FLAT * side * len(diagonals) / len(loads)
    page = TEXT_WIDTH, CAPTION + BELOW + len(meanings) * (height + GAP) + ABOVE
    figure = new_figure(*page)
    misses = [float(row["largest_miss"]) for row in rows]
    colours = ScalarMappable(LogNorm(min(misses), max(misses)), NEAR)
    for i, (rules, table) in enumerate(groups):
        for j, h1 in enumerate(meanings):
            place = LABELS + i * (side + GAP), page[1] - ABOVE - (j + 1) * height - j * GAP
            axes = _panel(figure, page, place, (side, height), diagonals, named=i == 0)
            _fill_matches(
                axes,
                [[table[diagonal, load, h1] for load in loads] for diagonal in diagonals],
                colours,
            )
            if j == 0:
                axes.set_title(f"norms {rules}", fontsize=8)
            if i == len(groups) - 1:
                aside = {
                    "xytext": (5, 0),
                    "textcoords": "offset points",
                    "rotation": 270,
                    "va": "center",
                    "size": 8,
                }
                axes.annotate(H1[h1], (1, 0.5), xycoords="axes fraction", **aside)
            if j == len(meanings) - 1:
                axes.set_xticks(
                    [k + 0.5 for k in range(len(loads))], loads, rotation=40, ha="right"
                )
    figure.text(
        (LABELS - 0.35) / page[0],
        (CAPTION + 0.3) / page[1],
        "load",
        ha="right",
        va="center",
        fontsize=8,
    )
    total = rows[0]["errors"]
    _bar(
        figure,
        page,
        colours,
        f"errors matched, of {total}; below and by colour, the largest relative miss",
    )
    return figure


def _fill_matches(axes, lines, colours):
    for y, line in enumerate(lines):
        for x, row in enumerate(line):
            miss = float(row["largest_miss"])
            dark = colours.norm(miss) < 0.4
            _tile(axes, x, y, colours.to_rgba(miss), (row["matched"], 8, 0.4), dark)
            _tile(axes, x, y, None, (f"{percent(miss)}%", 5.6, 0.78), dark)


@matplotlib.rc_context(STYLE)
def draw_ratios(rows):
    """Draw the L2 error of CR relative to that of P1 on every level, for each load rule and
    diagonal.

    Parameters
    ----------
    rows : sequence of mapping
        Of ``sensitivity_ratios.csv``, of one norm rule, as text or numbers.

    Returns
    -------
    matplotlib.figure.Figure
    """
    diagonals, loads, levels = (_distinct(rows, name) for name in ("diagonal", "load", "n"))
    columns = min(len(loads), 3)
    lines = -(-len(loads) // columns)
    side = (TEXT_WIDTH - LABELS - GAP * (columns - 1)) / columns
    height, above = 0.21 * len(diagonals), 0.36
    page = TEXT_WIDTH, CAPTION + 0.12 + lines * (height + above)
    figure = new_figure(*page)
    colours = ScalarMappable(LogNorm(1.0 / WIDEST, WIDEST), BETTER)
    found = {(row["load"], row["diagonal"], row["n"]): float(row["l2"]) for row in rows}
    for k, load in enumerate(loads):
        i, j = k % columns, k // columns
        place = LABELS + i * (side + GAP), page[1] - (j + 1) * (height + above)
        axes = _panel(figure, page, place, (side, height), diagonals, named=i == 0)
        for y, diagonal in enumerate(diagonals):
            for x, n in enumerate(levels):
                ratio = found[load, diagonal, n]
                dark = abs(math.log(ratio)) > 0.62 * math.log(WIDEST)
                _tile(axes, x, y, colours.to_rgba(ratio), (f"{ratio:.2f}", 6.5, 0.52), dark)
        axes.set_title(f"load: {load}", fontsize=8, pad=13)
        axes.xaxis.tick_top()
        axes.set_xticks([x + 0.5 for x in range(len(levels))], [f"$N={levels[0]}$", *levels[1:]])
        axes.tick_params(labelsize=7, pad=0)
    _bar(
        figure,
        page,
        colours,
        "$L^2$ error of NCF relative to CF: blue where NCF has the smaller, brown where CF has",
    )
    return figure


def _distinct(rows, name):
    return list(dict.fromkeys(row[name] for row in rows))


def _rules_alike(rows):
    """(Names, table) of the norm rules, those with equal tables under one name."""
    groups = {}
    for rule in _distinct(rows, "rule"):
        table = {
            (row["diagonal"], row["load"], row["h1"]): row for row in rows if row["rule"] == rule
        }
        shown = tuple(
            (key, row["matched"], f"{float(row['largest_miss']):.6e}") for key, row in table.items()
        )
        groups.setdefault(shown, ([], table))[0].append(rule)
    return [(_titles(rules), table) for rules, table in groups.values()]


def _titles(rules):
    return " or ".join("exact" if rule == "exact" else f"by {rule}" for rule in rules)


def _panel(figure, page, place, size, diagonals, named):
    """Axes whose unit squares are tiles, the first diagonal on top; if `named`, with names and
    pictures on the left.
    """
    (left, bottom), (width, height) = place, size
    axes = figure.add_axes((left / page[0], bottom / page[1], width / page[0], height / page[1]))
    axes.set(xlim=(0, 1), ylim=(len(diagonals), 0), xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0, pad=1)
    if named:
        for y, diagonal in enumerate(diagonals):
            pixel = 0.75 * min(height / len(diagonals), 0.24)
            middle = bottom + height - (y + 0.5) * height / len(diagonals)
            _picture(figure, page, (left - pixel - 0.07, middle - pixel / 2), pixel, diagonal)
            x = (left - pixel - 0.13) / page[0]
            figure.text(
                x,
                middle / page[1],
                DIAGONALS.get(diagonal, diagonal),
                ha="right",
                va="center",
                fontsize=7,
            )
    return axes


def _picture(figure, page, place, side, diagonal):
    """Two by two cells, cut as the diagonal says."""
    axes = figure.add_axes((place[0] / page[0], place[1] / page[1], side / page[0], side / page[1]))
    axes.set(xlim=(0, 2), ylim=(0, 2), xticks=[], yticks=[])
    axes.spines[:].set(visible=True, linewidth=0.5)
    for k in (0, 1):
        axes.plot([1, 1], [k, k + 1], [k, k + 1], [1, 1], color=GREY, linewidth=0.4)
        for m in (0, 1):
            cuts = "/\\" if diagonal == "criss-cross" else _FIRST[diagonal][(k + m) % 2]
            for x, y in (_CUTS[cut] for cut in cuts):
                axes.plot([k + a for a in x], [m + b for b in y], color=BLACK, linewidth=0.6)


def _tile(axes, x, y, colour, label, dark):
    """A square filled with a colour, unless it is None, and a label: its text, size, and height in
    the square.
    """
    text, size, height = label
    if colour is not None:
        axes.set_xlim(0, max(axes.get_xlim()[1], x + 1))
        axes.fill(
            [x, x + 1, x + 1, x],
            [y, y, y + 1, y + 1],
            facecolor=colour,
            edgecolor="white",
            linewidth=1,
        )
    axes.text(
        x + 0.5,
        y + height,
        text,
        ha="center",
        va="center",
        fontsize=size,
        color="white" if dark else BLACK,
    )


def _bar(figure, page, colours, label):
    axes = figure.add_axes(
        (LABELS / page[0], (CAPTION - 0.16) / page[1], 1 - LABELS / page[0] - 0.05, BAR / page[1])
    )
    bar = figure.colorbar(colours, cax=axes, orientation="horizontal")
    bar.outline.set_linewidth(0.5)
    low, high = colours.norm.vmin, colours.norm.vmax
    if high / low > 100:
        bar.set_ticks(
            [10.0**k for k in range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1)]
        )
    else:
        ticks = [value for value in (0.25, 0.5, 1, 2, 4) if low <= value <= high]
        bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    bar.ax.minorticks_off()
    bar.ax.tick_params(length=2, width=0.5, pad=1, labelsize=7)
    figure.text(LABELS / page[0], (CAPTION - 0.02) / page[1], label, va="bottom", fontsize=7.5)
