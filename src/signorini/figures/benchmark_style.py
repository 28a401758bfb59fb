"""What the benchmark's figures have in common: small type, and a style for each series."""

import math

from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from signorini.errors.norms import NORMS, PAPER_NORMS
from signorini.figures.style import ELEMENT_STYLES, FAINT, GREY, STYLE

SMALL = STYLE | {
    "font.size": 7,
    "axes.labelsize": 7,
    "xtick.labelsize": 6,
    "ytick.labelsize": 6,
    "legend.fontsize": 6,
}
TITLES = {norm: NORMS[norm].axis for norm in PAPER_NORMS}  # of the norms that are drawn
# Of the routes, in the order of their appearance; None is the element's own marker.
LINES = ("-", (0, (4, 2)), (0, (1, 1.2)), (0, (5, 1, 1, 1)))
MARKERS = (None, "D", "^", "v")


def scenes_of(series):
    """Return the scenes of the benchmark's series.

    Parameters
    ----------
    series : mapping
        (scene, element, method) -> rows.

    Returns
    -------
    list of str
        In the order of the keys.

    Examples
    --------
    >>> scenes_of({("paper", "P1", "direct"): [], ("paper", "CR", "direct"): []})
    ['paper']
    """
    return list(dict.fromkeys(scene for scene, _, _ in series))


def style_of_series(series, element, method):
    """Return the options of a curve: its colour tells the element, line and marker the route.

    In grey the markers of P1 are white, those of CR filled.

    Parameters
    ----------
    series : mapping
        All that the figure shows, see `benchmark_curves.draw_error`.
    element, method : str
        Of the curve.

    Returns
    -------
    dict

    Examples
    --------
    >>> series = {("paper", "P1", "fourier"): [], ("paper", "P1", "direct"): []}
    >>> style_of_series(series, "P1", "direct")["linestyle"]
    (0, (4, 2))
    """
    routes = list(dict.fromkeys(route for _, _, route in series))
    place, own = routes.index(method) % len(LINES), ELEMENT_STYLES[element]
    return {
        **own,
        "linestyle": LINES[place],
        "marker": MARKERS[place] or own["marker"],
        "markeredgewidth": 0.6,
        "markersize": 2.8,
        "linewidth": 0.8,
        "label": f"{element} {method}",
    }


_SHORT = 1.4  # decades, below which there may be but one label
_ROUGH = {
    "P1": {"color": GREY, "marker": "v", "markerfacecolor": "white"},
    "CR": {"color": "#79a9de", "marker": "^"},  # a light blue
}


def style_of_rough(element):
    """Return the options of the curve to discretisation accuracy: dotted, and paler.

    Parameters
    ----------
    element : {"P1", "CR"}

    Returns
    -------
    dict

    Examples
    --------
    >>> style_of_rough("P1")["label"]
    'P1 by multigrid to discretisation accuracy'
    """
    label = f"{element} by multigrid to discretisation accuracy"
    style = {"linestyle": (0, (1, 1.2)), "markersize": 2.5, "linewidth": 0.9, "label": label}
    return _ROUGH.get(element, {"color": FAINT}) | style


def fit_logarithmic(axes, margin):
    """Make axes logarithmic and as long as their curves, labelled at decades, or closer if short.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    margin : float
        Beside the curves, as a share of their length.
    """
    if not math.isfinite(axes.dataLim.minposx):
        return  # nothing is drawn
    axes.set(xscale="log", yscale="log")
    axes.margins(margin)
    axes.autoscale_view()
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(NullFormatter())
        low, high = axis.get_view_interval()
        if math.log10(high / low) < _SHORT:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def number_decades(axis, most):
    """Put numbers at decades, evenly, so that there is room for them.

    Parameters
    ----------
    axis : matplotlib.axis.Axis
        Logarithmic, with its limits.
    most : int
        Numbers, at most.

    Examples
    --------
    Five at most of eight decades:

    >>> from matplotlib.figure import Figure
    >>> axes = Figure().subplots()
    >>> _ = axes.set(xscale="log", xlim=(1.0, 1e8))
    >>> number_decades(axes.xaxis, 5)
    >>> axes.get_xticks().tolist()
    [1.0, 100.0, 10000.0, 1000000.0, 100000000.0]
    """
    low, high = (math.log10(limit) for limit in axis.get_view_interval())
    first, last = math.ceil(low), math.floor(high)
    step = max(-(-(last - first + 1) // most), 1)
    axis.set_ticks([10.0**power for power in range(first, last + 1, step)])


def add_key(figure, axes, columns):
    """Put the key of the curves of some axes above all of a figure's.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    axes : matplotlib.axes.Axes
    columns : int
    """
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        loc="upper center",
        bbox_to_anchor=(0.53, 1.0),
        ncols=columns,
        handlelength=3,
        borderaxespad=0.1,
    )
