"""A sweep: quantities over the values of a key, a panel for each."""

import matplotlib
from matplotlib.ticker import NullFormatter

from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.figures.style import ELEMENT_STYLES, STYLE, TEXT_WIDTH, add_axes, new_figure

_MOST_NAMED = 8  # lines that a legend can tell apart
_LEFT, _BOTTOM, _GAP, _HEIGHT = 0.62, 0.48, 0.75, 1.8  # inches
_ABOVE = 0.2  # of the axes, for a power of ten, inches
_SIZES = {"P1": 5.0, "CR": 2.8}  # of markers: a ring is seen around another at the same place
_MOST_MARKED = 40  # points of a line that have markers
_VARIANTS = ((), (1, 1), (5, 2), (3, 1, 1, 1))  # dashes, in turn


@matplotlib.rc_context(STYLE)
def draw_sweep(curves):
    """Draw the curves of a sweep, two panels beside each other.

    Parameters
    ----------
    curves : mapping
        See `sweeps.curves.sweep_curves`.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> series = [{"element": "CR", "variant": "", "x": [0.0, 1.0], "y": [1.0, 2.0]}]
    >>> panel = {"label": "force", "log": False, "series": series}
    >>> figure = draw_sweep({"label": "data.f", "log": False, "ticks": None, "panels": [panel]})
    >>> figure.axes[0].get_xlabel()
    'data.f'
    """
    panels = curves["panels"]
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    height = rows * (_HEIGHT + _BOTTOM) + _named_height(panels[0])
    figure = new_figure(TEXT_WIDTH, height)
    width = TEXT_WIDTH / columns - _GAP
    for k, panel in enumerate(panels):
        row, column = divmod(k, columns)
        left = _LEFT + column * TEXT_WIDTH / columns
        top = height - _named_height(panels[0]) - row * (_HEIGHT + _BOTTOM)
        axes = add_axes(figure, left, top - _HEIGHT, width, _HEIGHT - _ABOVE)
        _draw_panel(axes, panel, curves)
    _add_names(figure, panels[0])
    return figure


def _draw_panel(axes, panel, curves):
    for series in panel["series"]:
        axes.plot(series["x"], series["y"], **_style(series, panel), label=_name(series))
    axes.set(xlabel=_plain(curves["label"]), ylabel=_label(panel))
    axes.set_xscale("log" if curves["log"] else "linear")
    if panel["log"]:
        axes.set_yscale("log")
        axes.yaxis.set_minor_formatter(NullFormatter())
    else:
        axes.ticklabel_format(axis="y", style="sci", scilimits=(-3, 4), useMathText=True)
    if curves["ticks"] is not None:
        axes.set_xticks(range(len(curves["ticks"])), map(_plain, curves["ticks"]))


def _label(panel):
    """What a panel shows; labels of norms are formulas already."""
    return panel["label"] if "$" in panel["label"] else _plain(panel["label"])


def _style(series, panel):
    """Colour and marker by element, dashes by variant."""
    style = dict(ELEMENT_STYLES[series["element"]])
    variants = list(dict.fromkeys(other["variant"] for other in panel["series"]))
    if len(variants) > 1:
        style["linestyle"] = (0, _VARIANTS[variants.index(series["variant"]) % len(_VARIANTS)])
    every = -(-len(series["x"]) // _MOST_MARKED)
    return style | {"markevery": every, "markersize": _SIZES.get(series["element"], 3.5)}


def _name(series):
    label = ELEMENT_FACTS[series["element"]].label
    return f"{label}, {_plain(series['variant'])}" if series["variant"] else label


def _plain(text):
    """A text that Matplotlib sets as it stands; its font has no underscore."""
    return str(text).replace("$", r"\$").replace("_", r"$\_$")


def _named_height(panel):
    """The height of the legend above the panels, inches."""
    count = len(panel["series"])
    return 0.08 + 0.2 * -(-count // 2) if count <= _MOST_NAMED else 0.08


def _add_names(figure, panel):
    if len(panel["series"]) > _MOST_NAMED:
        return
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=2, borderaxespad=0.1)
