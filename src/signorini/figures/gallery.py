"""The contact sheet: the solutions of many scenes on one page, for the screen."""

import math
import textwrap

import matplotlib
from matplotlib.cm import ScalarMappable
from matplotlib.lines import Line2D

from signorini.figures.field import (
    BOUNDARY,
    COLOURS,
    CRITICAL,
    Frame,
    paint,
    plain,
    unit_exponent,
    with_unit,
)
from signorini.figures.style import BLACK, GREY, STYLE, new_figure

COLUMNS = 4
TITLE_LINES, TITLE_LETTERS = 2, 42  # of a scene's title at most, and in each of its lines
NAME_LETTERS = 28  # of a scene's name in full size
THICKNESS = 0.75  # of lines, relative to those of a figure of its own

# Widths and heights in inches.
CELL, BOX, MARGIN = (
    2.4,
    2.0,
    0.15,
)  # of a column, of the square that a domain fits in, around the sheet
HEAD, FOOT, KEY = (
    0.56,
    0.42,
    0.4,
)  # name and title above a domain, range of u below it, key of the sheet


@matplotlib.rc_context(STYLE)
def draw_gallery(fields):
    """Draw solutions side by side, four in a row, each with its own range of colours and to its own
    scale.

    Parameters
    ----------
    fields : sequence of (str, str, mapping)
        Name and title of a scene, plain text, and what `signorini.report.field.field_of` returns.

    Returns
    -------
    matplotlib.figure.Figure
        Wider than a block of text: meant for a screen.

    Raises
    ------
    ValueError
        If there is no scene.
    """
    if not fields:
        raise ValueError("gallery: no scenes; there is nothing to draw")
    scenes = [(name, title, field, Frame(field["p"])) for name, title, field in fields]
    rows = [scenes[k : k + COLUMNS] for k in range(0, len(scenes), COLUMNS)]
    heights = [HEAD + max(frame.fit(BOX)[1] for *_, frame in row) + FOOT for row in rows]
    figure = new_figure(COLUMNS * CELL + 2 * MARGIN, sum(heights) + KEY + 2 * MARGIN)
    top = figure.get_figheight() - MARGIN
    for row, height in zip(rows, heights, strict=True):
        for column, scene in enumerate(row):
            _draw_scene(figure, MARGIN + column * CELL, top, *scene)
        top -= height
    _draw_key(figure)
    return figure


def _draw_scene(figure, left, top, name, title, field, frame):
    """Draw one scene into the cell whose upper left corner is given in inches."""
    width, height = figure.get_size_inches()
    across, up = frame.fit(BOX)
    lines = textwrap.wrap(title, TITLE_LETTERS, max_lines=TITLE_LINES, placeholder=" ...")
    size = 10 * min(1, NAME_LETTERS / max(len(name), 1))
    figure.text(left / width, top / height, name, fontsize=size, va="top", **plain(name))
    about = {"fontsize": 7, "color": GREY, "va": "top", "linespacing": 1.15}
    figure.text(left / width, (top - 0.19) / height, "\n".join(lines), **about, **plain(title))
    bottom = top - HEAD - up
    axes = figure.add_axes(
        (left / width, bottom / height, across / width, up / height), frame_on=False
    )
    paint(axes, field, frame, THICKNESS)
    axes.set(xticks=[], yticks=[])
    figure.text(left / width, (bottom - 0.08) / height, _range(field), fontsize=8, va="top")


def _range(field):
    """The least and the greatest u, to three digits of the larger one."""
    exponent = unit_exponent(field["range"])
    low, high = (float(value) / 10.0**exponent for value in field["range"])
    digits = 2 - math.floor(math.log10(max(abs(low), abs(high)) or 1.0))
    low, high = (round(value, digits) + 0.0 for value in (low, high))
    return with_unit(rf"${low:.4g} \leq u \leq {high:.4g}$", exponent)


def _draw_key(figure):
    """What the lines mean, and which way the colours run, at the foot of the sheet."""
    width, height = figure.get_size_inches()
    lines = [Line2D([], [], label=label, **style) for label, style in BOUNDARY.values()]
    points = [Line2D([], [], marker="o", label="critical point", **CRITICAL)]
    figure.legend(
        handles=lines + points,
        loc="lower left",
        bbox_to_anchor=(MARGIN / width, MARGIN / height),
        ncols=5,
        handlelength=2.2,
        columnspacing=1.4,
        borderpad=0,
        borderaxespad=0,
    )
    middle, start = (MARGIN + 0.03) / height, 1 - (MARGIN + 2.0) / width
    axes = figure.add_axes((start, middle, 1.0 / width, 0.1 / height))
    bar = figure.colorbar(
        ScalarMappable(cmap=COLOURS), cax=axes, orientation="horizontal", ticks=[]
    )
    bar.outline.set(linewidth=0.5, edgecolor=BLACK)
    beside = {"fontsize": 8, "va": "center"}
    figure.text(start - 0.08 / width, middle + 0.05 / height, "least $u$", ha="right", **beside)
    figure.text(start + 1.08 / width, middle + 0.05 / height, "greatest $u$", **beside)
