"""The contact sheet: the solutions of many scenes on one page, for the screen."""

import math
import textwrap

import matplotlib
from matplotlib.cm import ScalarMappable
from matplotlib.lines import Line2D

from signorini.figures.field import BOUNDARY, COLOURS, paint, style_of_turns
from signorini.figures.frame import Frame
from signorini.figures.style import BLACK, CRITICAL, GREY, STYLE, add_axes, new_figure
from signorini.figures.units import plain, unit_exponent, with_unit

COLUMNS = 4
TITLE_LINES, TITLE_LETTERS = 2, 42  # of a scene's title at most, and in each of its lines
NAME_LETTERS = 28  # of a scene's name in full size
THICKNESS = 0.75  # of lines, relative to those of a figure of its own

# Widths and heights in inches. A cell of the sheet:
#
#     name           \
#     title           } HEAD
#     title          /
#     +--------+
#     | domain |       within BOX by BOX, at the left
#     +--------+
#     range of u     } FOOT
CELL, BOX = 2.4, 2.0  # of a column, and of the square that a domain fits in
MARGIN, KEY = 0.15, 0.4  # around the sheet, and of its key
HEAD, FOOT = 0.56, 0.42  # name and title above a domain, range of u below it
TITLE_DROP, RANGE_DROP = 0.19, 0.08  # of a title from its name, of a range from its domain
PICTURE, PICTURE_MARGIN = 2.6, 0.06  # of a card
BAR_WIDTH, BAR_HEIGHT, BAR_PLACE = 1.0, 0.1, 2.0  # the last one from the right margin


@matplotlib.rc_context(STYLE)
def draw_gallery(fields):
    """Draw solutions side by side, four in a row.

    Each has its own range of colours and its own scale.

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
    heights = [_height(row) for row in rows]
    figure = new_figure(COLUMNS * CELL + 2 * MARGIN, math.fsum(heights) + KEY + 2 * MARGIN)
    top = figure.get_figheight() - MARGIN
    for row, height in zip(rows, heights, strict=True):
        for column, scene in enumerate(row):
            _draw_scene(figure, MARGIN + column * CELL, top, *scene)
        top -= height
    _draw_key(figure, any(len(field["by_turns"]) for _, _, field in fields))
    return figure


@matplotlib.rc_context(STYLE)
def draw_picture(field):
    """Draw one solution alone, without a word: the picture of a card.

    Parameters
    ----------
    field : mapping
        What `signorini.report.field.field_of` returns.

    Returns
    -------
    matplotlib.figure.Figure
        At most `PICTURE` inches wide and high, besides a small margin.
    """
    frame = Frame(field["p"])
    width, height = frame.fit(PICTURE)
    figure = new_figure(width + 2 * PICTURE_MARGIN, height + 2 * PICTURE_MARGIN)
    axes = add_axes(figure, PICTURE_MARGIN, PICTURE_MARGIN, width, height, frame_on=False)
    paint(axes, field, frame, THICKNESS)
    axes.set(xticks=[], yticks=[])
    return figure


def _height(row):
    """Of a row of scenes, in inches."""
    return HEAD + max(frame.fit(BOX)[1] for *_, frame in row) + FOOT


def _draw_scene(figure, left, top, name, title, field, frame):
    """Draw one scene into the cell whose upper left corner is given in inches."""
    width, height = frame.fit(BOX)
    bottom = top - HEAD - height
    _write_name(figure, left, top, name)
    _write_title(figure, left, top - TITLE_DROP, title)
    axes = add_axes(figure, left, bottom, width, height, frame_on=False)
    paint(axes, field, frame, THICKNESS)
    axes.set(xticks=[], yticks=[])
    _write(figure, left, bottom - RANGE_DROP, _range(field), fontsize=8, va="top")


def _write_name(figure, left, top, name):
    size = 10 * min(1, NAME_LETTERS / max(len(name), 1))
    _write(figure, left, top, name, fontsize=size, va="top", **plain(name))


def _write_title(figure, left, top, title):
    lines = textwrap.wrap(title, TITLE_LETTERS, max_lines=TITLE_LINES, placeholder=" ...")
    style = {"fontsize": 7, "color": GREY, "va": "top", "linespacing": 1.15}
    _write(figure, left, top, "\n".join(lines), **style, **plain(title))


def _write(figure, x, y, text, **options):
    """Put text at a place given in inches."""
    width, height = figure.get_size_inches()
    figure.text(x / width, y / height, text, **options)


def _range(field):
    """The least and the greatest u, to three digits of the larger one."""
    exponent = unit_exponent(field["range"])
    low, high = (float(value) / 10.0**exponent for value in field["range"])
    largest = max(abs(low), abs(high)) or 1.0
    digits = 2 - math.floor(math.log10(largest))
    low, high = (round(value, digits) + 0.0 for value in (low, high))  # no -0
    return with_unit(rf"${low:.4g} \leq u \leq {high:.4g}$", exponent)


def _draw_key(figure, turns):
    """Say what the lines mean, and which way the colours run, at the foot of the sheet."""
    width, height = figure.get_size_inches()
    lines = [Line2D([], [], label=label, **style) for label, style in BOUNDARY.values()]
    point = Line2D([], [], marker="o", label="critical point", **CRITICAL)
    figure.legend(
        handles=[*lines, point, *([Line2D([], [], **style_of_turns())] if turns else [])],
        loc="lower left",
        bbox_to_anchor=(MARGIN / width, MARGIN / height),
        ncols=6,
        handlelength=2.2,
        columnspacing=1.4,
        borderpad=0,
        borderaxespad=0,
    )
    _draw_key_bar(figure)


def _draw_key_bar(figure):
    width, height = figure.get_size_inches()
    bottom = (MARGIN + 0.03) / height
    left = 1 - (MARGIN + BAR_PLACE) / width
    axes = figure.add_axes((left, bottom, BAR_WIDTH / width, BAR_HEIGHT / height))
    bar = figure.colorbar(
        ScalarMappable(cmap=COLOURS),
        cax=axes,
        orientation="horizontal",
        ticks=[],
    )
    bar.outline.set(linewidth=0.5, edgecolor=BLACK)
    beside = {"fontsize": 8, "va": "center"}
    middle = bottom + 0.05 / height
    figure.text(left - 0.08 / width, middle, "least $u$", ha="right", **beside)
    figure.text(left + 1.08 / width, middle, "greatest $u$", **beside)
