"""What figures show of the contact part: its columns, where it binds, its critical points."""

import numpy as np

_TRUTHS = {"exact": "u_h - u", "reference": r"u_h - u_\mathrm{ref}"}  # column -> difference from it
_RESULTANTS = ("resultant", "true_resultant")
NUMBERS = (
    *("component", "s", "u", "obstacle", "flux", "critical", "threshold"),
    *_TRUTHS,
    *_RESULTANTS,
)
"""Columns of contact_line.csv that are numbers and drawn; not every table has all of them."""
_CR_FROM_P1 = r"u_\mathrm{CR} - u_\mathrm{P1}"
_ABSENT = {"threshold": 0.0} | dict.fromkeys([*_TRUTHS, *_RESULTANTS])
_ROUND_OFF = 1e-12  # of u, in lengths of its range
BY_TURNS = 4  # neighbouring critical points from which on they are an interval


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
    values = [row.get(name, _ABSENT[name]) if name in _ABSENT else row[name] for row in rows]
    return np.array([np.nan if value in (None, "") else float(value) for value in values])


def differences(lines):
    """What one line hides under another: u against the truth, or else CR against P1.

    The truth is the exact solution or, where there is none, the reference.

    Parameters
    ----------
    lines : mapping
        What `finest_lines` returns.

    Returns
    -------
    name : str or None
        Of the difference, in mathematics; None where there is nothing to compare with.
    values : dict of str to ndarray
        Element -> the difference at the places of its line, NaN where there is none; unit of u. P1
        is affine between its places, so that its values at those of CR are exact.

    Examples
    --------
    >>> row = dict.fromkeys(NUMBERS, 0.0) | {"n": 4, "component": 1, "u": 1.0}
    >>> rows = [row | {"element": "P1", "s": s, "u": s} for s in (0.0, 1.0)]
    >>> rows.append(row | {"element": "CR", "s": 0.5, "u": 0.75, "exact": None})
    >>> differences(finest_lines(rows[:2], ["P1"]))
    ('u_h - u', {'P1': array([0., 1.])})
    >>> plain = [row | dict.fromkeys(["exact", "reference"]) for row in rows]
    >>> differences(finest_lines(plain, ["P1", "CR"]))[1]
    {'CR': array([0.25])}
    """
    for truth, description in _TRUTHS.items():
        if all(np.isfinite(line[truth]).any() for line in lines.values()):
            return description, {name: line["u"] - line[truth] for name, line in lines.items()}
    if not {"P1", "CR"} <= set(lines) or lines["P1"]["n"] != lines["CR"]["n"]:
        return None, {}
    p1, cr = lines["P1"], lines["CR"]
    found = np.full(cr["s"].size, np.nan)
    for component in np.unique(p1["component"]):
        there, here = p1["component"] == component, cr["component"] == component
        known = np.interp(cr["s"][here], p1["s"][there], p1["u"][there], np.nan, np.nan)
        found[here] = cr["u"][here] - known
    return _CR_FROM_P1, {"CR": found}


def resultants(lines):
    """The whole contact force of each element and, where it is known, the true one.

    Parameters
    ----------
    lines : mapping
        What `finest_lines` returns.

    Returns
    -------
    dict of str to float
        Element, or ``exact`` or ``reference`` -> force, unit of k u; empty for tables without.

    Examples
    --------
    >>> row = dict.fromkeys(NUMBERS, 0.0) | {"element": "P1", "n": 4, "resultant": 0.5}
    >>> lines = finest_lines([row | {"exact": None, "true_resultant": 0.25}], ["P1"])
    >>> resultants(lines)
    {'P1': 0.5, 'reference': 0.25}
    """
    found = {element: float(line["resultant"][0]) for element, line in lines.items()}
    first = next(iter(lines.values()))
    truth = "exact" if np.isfinite(first["exact"]).any() else "reference"
    found[truth] = float(first["true_resultant"][0])
    return {name: force for name, force in found.items() if np.isfinite(force)}


def critical_runs(line):
    """Tell critical points from intervals on which contact and gaps alternate.

    Where u touches the obstacle without pressing on it, the signs of round-off make contact of
    every second point or so; the many critical points there are one interval.

    Parameters
    ----------
    line : mapping of str to ndarray
        As `finest_lines` returns.

    Returns
    -------
    points : ndarray, shape (c,)
        Arc lengths of those that stand alone, or nearly so.
    intervals : ndarray, shape (k, 2)
        First and last arc length of at least `BY_TURNS` that follow one another.

    Examples
    --------
    >>> s = np.arange(12.0)
    >>> critical = np.where((s > 4) & (s < 9) | (s == 1), s + 0.5, np.nan)
    >>> points, intervals = critical_runs({"s": s, "critical": critical})
    >>> points.tolist(), intervals.tolist()
    ([1.5], [[5.5, 8.5]])
    """
    places = line["critical"][~np.isnan(line["critical"])]
    if not places.size:
        return places, np.zeros((0, 2))
    near = 2.5 * np.median(np.diff(line["s"])) if line["s"].size > 1 else 0.0
    runs = np.split(places, np.flatnonzero(np.diff(places) > near) + 1)
    alone = [run for run in runs if run.size < BY_TURNS]
    together = [(run[0], run[-1]) for run in runs if run.size >= BY_TURNS]
    return np.concatenate([places[:0], *alone]), np.reshape(together, (-1, 2))


def touching_intervals(line):
    """Where the exact solution is on the obstacle and an element has no force.

    Such contact is biactive: neither the gap nor the force tells that there is any. Few places in a
    row are no interval: by those a discrete contact zone is shorter than the exact one.

    Parameters
    ----------
    line : mapping of str to ndarray
        As `finest_lines` returns.

    Returns
    -------
    ndarray, shape (k, 2)
        First and last arc length of each interval; none where there is no exact solution.

    Examples
    --------
    >>> s = np.arange(8.0)
    >>> line = {"s": s, "component": np.ones(8), "obstacle": 0 * s, "flux": np.where(s < 2, 1, 0)}
    >>> touching_intervals(line | {"exact": np.where(s < 7, 0.0, 1.0)}).tolist()
    [[2.0, 6.0]]
    """
    gap = np.abs(line["exact"] - line["obstacle"])  # NaN where there is no exact solution
    scale = np.max(np.abs(line["obstacle"]), initial=0.0) + np.nanmax(gap, initial=0.0)
    touching = np.flatnonzero((gap <= _ROUND_OFF * scale) & (line["flux"] == 0.0))
    apart = (np.diff(touching) > 1) | (np.diff(line["component"][touching]) != 0)
    runs = np.split(touching, np.flatnonzero(apart) + 1)
    ends = [line["s"][[run[0], run[-1]]] for run in runs if run.size >= BY_TURNS]
    return np.reshape(ends, (-1, 2))


def critical_heights(line):
    """Return where the critical points of a contact line are, and the obstacle there.

    Those of intervals are left out, see `critical_runs`.

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
    places, _ = critical_runs(line)
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
