"""Curves, bars and marks that the figures of the studies show, computed from their rows."""

import math

EPS = 2.0**-52  # of double precision


def longest_series(series):
    """Return one series per scene and element: that of the route with the most levels.

    Parameters
    ----------
    series : mapping
        (scene, element, method) -> rows.

    Returns
    -------
    dict
        The same for the routes chosen, the first of several that are equally long.

    Examples
    --------
    >>> rows = [{"n": 2}, {"n": 4}]
    >>> longest_series({("paper", "P1", "direct"): rows[:1], ("paper", "P1", "fourier"): rows})
    {('paper', 'P1', 'fourier'): [{'n': 2}, {'n': 4}]}
    """
    chosen = {}
    for (scene, element, method), rows in series.items():
        known = next((key for key in chosen if key[:2] == (scene, element)), None)
        if known is None or len(rows) > len(chosen[known]):
            chosen.pop(known, None)
            chosen[scene, element, method] = rows
    return chosen


def spread(rows, quantity):
    """Return how far the least and the largest of repeated measurements lie from the median.

    Parameters
    ----------
    rows : sequence of mapping
        With the columns `quantity`, and the same with ``_min`` and ``_max`` behind.
    quantity : str

    Returns
    -------
    low, high : list of float
        Not negative, in the unit of the rows.

    Examples
    --------
    >>> spread([{"total": 2.0, "total_min": 1.5, "total_max": 4.0}], "total")
    ([0.5], [2.0])
    """
    low = [row[quantity] - row[f"{quantity}_min"] for row in rows]
    high = [row[f"{quantity}_max"] - row[quantity] for row in rows]
    return low, high


def stacked_shares(row, names):
    """Return what each column is of the sum of all, as a bar of length 1 in pieces.

    Parameters
    ----------
    row : mapping of str to float
    names : sequence of str
        Columns.

    Returns
    -------
    list of (str, float, float)
        Name, start and length of each piece, dimensionless.

    Examples
    --------
    >>> stacked_shares({"mesh": 1.0, "solve": 3.0}, ("mesh", "solve"))
    [('mesh', 0.0, 0.25), ('solve', 0.25, 0.75)]
    """
    total = math.fsum(row[name] for name in names)
    pieces, start = [], 0.0
    for name in names:
        length = row[name] / total
        pieces.append((name, start, length))
        start += length
    return pieces


def thinned(points):
    """Return one point for each tenth of a decade either way.

    Parameters
    ----------
    points : sequence of (float, float)
        Positive.

    Returns
    -------
    x, y : list of float

    Examples
    --------
    >>> thinned([(1.0, 1.01), (1.01, 1.0), (10.0, 1.0)])
    [[1.0, 10.0], [1.0, 1.0]]
    """
    cells = {tuple(round(10 * math.log10(value)) for value in point) for point in points}
    return [[10 ** (cell[k] / 10) for cell in sorted(cells)] for k in (0, 1)]


def round_off_of_widths(widths, exponent, factor):
    """Return round-off as far as a condition number explains it: eps times condition.

    Parameters
    ----------
    widths : sequence of float
        Mesh widths h, in units of the domain's side.
    exponent, factor : float
        The condition number is `factor` times h to the power of minus `exponent`.

    Returns
    -------
    list of float
        Relative, dimensionless.

    Examples
    --------
    >>> round_off_of_widths([0.5, 0.25], 2.0, 1.0) == [2.0**-50, 2.0**-48]
    True
    """
    return [EPS * factor * h**-exponent for h in widths]


def round_off_of_aspects(rows):
    """Return eps times condition against the aspect of the cells.

    Parameters
    ----------
    rows : sequence of mapping
        With ``aspect`` and ``condition``. A condition that eps cannot resolve is left out.

    Returns
    -------
    aspect, bound : sequence of float
        Dimensionless.

    Examples
    --------
    >>> round_off_of_aspects([{"aspect": 0.5, "condition": 2.0**12}])
    [(0.5,), (9.094947017729282e-13,)]
    """
    regular = [row for row in rows if 0 < row["condition"] < 1 / EPS]
    return list(zip(*([row["aspect"], EPS * row["condition"]] for row in regular), strict=True))
