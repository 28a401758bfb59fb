"""What the benchmark's figures have in common: small type, and a style for each series."""

from signorini.errors.norms import NORMS, PAPER_NORMS
from signorini.figures.style import ELEMENT_STYLES, STYLE

SMALL = STYLE | {
    "font.size": 7,
    "axes.labelsize": 7,
    "xtick.labelsize": 6,
    "ytick.labelsize": 6,
    "legend.fontsize": 6,
}
TITLES = {norm: NORMS[norm].axis for norm in PAPER_NORMS}  # of the norms that are drawn
# Of the routes, in the order of their appearance.
LINES = ("-", (0, (4, 2)), (0, (1, 1.2)), (0, (5, 1, 1, 1)))


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
    """Return the options of a curve: colour and marker tell the element, the line the route.

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
    return {
        **ELEMENT_STYLES[element],
        "linestyle": LINES[routes.index(method) % len(LINES)],
        "markersize": 2.5,
        "linewidth": 0.8,
        "label": f"{element} {method}",
    }
