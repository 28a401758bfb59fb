"""Time to a guaranteed error, beside the time to the true one."""

import matplotlib
from matplotlib.lines import Line2D

from signorini.figures.benchmark_style import SMALL, fit_logarithmic
from signorini.figures.style import ACCENT, BLACK, MM, TEXT_WIDTH, new_figure

_MESHES = {
    "uniform": {"color": BLACK, "marker": "o", "markerfacecolor": "white"},
    "adaptive": {"color": ACCENT, "marker": "s"},
}
_GUARANTEED = {"linestyle": "-", "linewidth": 0.9, "markersize": 3}
_TRUE = {"linestyle": (0, (1, 1.2)), "linewidth": 0.9, "markersize": 1.6}
_SHADE = 0.25  # of the band between the bounds of an error that is not known


@matplotlib.rc_context(SMALL)
def draw_guaranteed(runs):
    """Draw errors against seconds: a row per element, a column per scene.

    Parameters
    ----------
    runs : dict
        Scene -> (element, "uniform" or "adaptive") -> rows of benchmark_guaranteed.csv with
        numbers, coarsest first. Where the error is not known, its bounds are drawn.

    Returns
    -------
    matplotlib.figure.Figure
    """
    elements = list(dict.fromkeys(element for curves in runs.values() for element, _ in curves))
    figure = new_figure(TEXT_WIDTH, 104 * MM)
    rows = figure.subplots(
        len(elements), len(runs), squeeze=False, sharex="col", sharey="col", gridspec_kw=_place()
    )
    for column, (scene, curves) in zip(rows.T, runs.items(), strict=True):
        column[0].set_title(scene, fontsize=7)
        column[-1].set_xlabel("seconds")
        for axes, element in zip(column, elements, strict=True):
            _draw_element(axes, element, curves)
    for row, element in zip(rows, elements, strict=True):
        row[0].set_ylabel(f"energy error of {element}")
    _add_key(figure)
    return figure


def _place():
    margins = {"left": 0.09, "right": 0.99, "bottom": 0.1, "top": 0.85}
    return margins | {"wspace": 0.22, "hspace": 0.1}


def _draw_element(axes, element, curves):
    for meshes, style in _MESHES.items():
        steps = curves[element, meshes]
        _draw_true(axes, steps, style)
        seconds, bounds = (_column(steps, name) for name in ("guaranteed", "upper"))
        axes.plot(seconds, bounds, **style | _GUARANTEED)
    fit_logarithmic(axes, 0.06)


def _draw_true(axes, steps, style):
    """The error itself; a band where it is known to be between two bounds."""
    seconds, errors = (_column(steps, name) for name in ("solved", "error"))
    if None not in errors:
        axes.plot(seconds, errors, **style | _TRUE)
        return
    lower, upper = (_column(steps, name) for name in ("lower", "upper"))
    axes.fill_between(seconds, lower, upper, color=style["color"], alpha=_SHADE, linewidth=0)
    axes.plot(seconds, lower, **style | _TRUE | {"marker": "none"})
    axes.plot(seconds, upper, **style | _TRUE | {"marker": "none"})


def _column(steps, name):
    return [step[name] for step in steps]


def _add_key(figure):
    """Colour and marker tell the meshes, the line whether the error is guaranteed."""
    lines = {}
    for meshes, style in _MESHES.items():
        lines[f"{meshes} meshes, guaranteed"] = style | _GUARANTEED
        lines[f"{meshes} meshes, true"] = style | _TRUE
    figure.legend(
        [Line2D([], [], **style) for style in lines.values()],
        list(lines),
        loc="upper center",
        bbox_to_anchor=(0.54, 1.0),
        ncols=2,
        handlelength=3,
        borderaxespad=0.1,
        title="band: where the true error is, by its own bounds",
        title_fontsize=6,
    )
