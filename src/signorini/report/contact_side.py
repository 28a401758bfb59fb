"""What figures show of the contact part: its columns, where it binds, its critical points."""

import numpy as np

NUMBERS = ("component", "s", "u", "obstacle", "flux", "critical", "threshold")
"""Columns of contact_line.csv that are numbers and drawn; without a threshold it is 0."""


def finest_lines(rows, elements):
    """Return the columns of each element's finest level.

    Parameters
    ----------
    rows : sequence of mapping
        What `signorini.fem.contact_line.contact_rows` returns, of one or more solutions, as text or
        numbers.
    elements : sequence of str

    Returns
    -------
    dict
        Element -> dict of ``n``; ``h``, None where it is 1/n; and, for each of `NUMBERS`, an array
        with NaN for what is missing.

    Raises
    ------
    ValueError
        If there is no row.

    Examples
    --------
    >>> row = dict.fromkeys(NUMBERS, "0.5") | {"element": "P1"}
    >>> lines = finest_lines([row | {"n": "2"}, row | {"n": "4"}], ["P1"])
    >>> lines["P1"]["n"], lines["P1"]["s"]
    (4, array([0.5]))
    """
    if not rows:
        raise ValueError("contact line: no rows; there is nothing to draw without a contact part")
    lines = {}
    for element in elements:
        own = [row for row in rows if row["element"] == element]
        n = max(int(row["n"]) for row in own)
        finest = [row for row in own if int(row["n"]) == n]
        width = finest[0].get("h")
        level = {"n": n, "h": None if width is None else float(width)}
        lines[element] = {name: _column(finest, name) for name in NUMBERS} | level
    return lines


def _column(rows, name):
    values = [row.get(name, 0.0) if name == "threshold" else row[name] for row in rows]
    return np.array([np.nan if value in (None, "") else float(value) for value in values])


def critical_heights(line):
    """Return where the critical points of a contact line are, and the obstacle there.

    Parameters
    ----------
    line : mapping of str to ndarray
        ``critical``, NaN where there is none; ``s`` and ``obstacle``.

    Returns
    -------
    s, obstacle : ndarray, shape (c,)
        In the units of the line.

    Examples
    --------
    >>> ramp = {"s": np.array([0.0, 1.0]), "obstacle": np.array([0.0, 2.0])}
    >>> critical_heights(ramp | {"critical": np.array([np.nan, 0.25])})
    (array([0.25]), array([0.5]))
    """
    places = line["critical"][~np.isnan(line["critical"])]
    return places, np.interp(places, line["s"], line["obstacle"])


def contact_side(surface):
    """Return the contact side of a surface in its parts.

    Parameters
    ----------
    surface : mapping of str to ndarray
        As for `signorini.figures.surface.draw_surface`.

    Returns
    -------
    dict
        ``x``, ``obstacle``, ``free`` and ``binding`` (p,): u off the obstacle, and on it, else NaN;
        ``points`` (c, 3), the critical points on the obstacle.
    """
    x, u = surface["contact_x"], surface["contact_u"]
    obstacle = surface.get("contact_obstacle", np.zeros_like(u))
    binds = u == obstacle  # a solution is on it to the last bit, and never beyond
    points = [(px, py, np.interp(px, x, obstacle)) for px, py in surface["critical_points"]]
    return {
        "x": x,
        "obstacle": obstacle,
        "free": np.where(binds, np.nan, u),
        "binding": np.where(binds, u, np.nan),
        "points": points,
    }
