"""The routes that are measured: those of the solvers, and multigrid only as far as it pays."""

from signorini.solvers import METHODS

ROUGH = "multigrid-discretisation"
ROUTES = {method: (method, "full") for method in METHODS} | {ROUGH: ("multigrid", "discretisation")}
"""Route -> method and accuracy, as `signorini.solvers.solve` takes them."""


def in_full(series):
    """The series of routes that solve to the last bit, with a proof.

    Parameters
    ----------
    series : dict
        Of `columns.series`.

    Returns
    -------
    dict

    Examples
    --------
    >>> list(in_full({("corner", "P1", "multigrid"): [], ("corner", "P1", ROUGH): []}))
    [('corner', 'P1', 'multigrid')]
    """
    return {key: rows for key, rows in series.items() if key[2] != ROUGH}


def rough_only(series):
    """The series to discretisation accuracy, as `in_full`."""
    return {key: rows for key, rows in series.items() if key[2] == ROUGH}


def best(series):
    """The series of the best route in full, for each scene and element.

    Parameters
    ----------
    series : dict
        Of `columns.series`.

    Returns
    -------
    dict
        That of least time on the finest level whose error is known.

    Examples
    --------
    >>> slow, fast = ([{"n": 8, "total": seconds, "h1": 0.1}] for seconds in (2.0, 1.0))
    >>> list(best({("corner", "P1", "direct"): slow, ("corner", "P1", "fourier"): fast}))
    [('corner', 'P1', 'fourier')]
    """
    chosen = {}
    for key, rows in in_full(series).items():
        known = [row for row in rows if row["h1"]]
        if known:
            rank = -known[-1]["n"], known[-1]["total"]
            chosen.setdefault(key[:2], []).append((rank, key))
    keys = [min(ranked)[1] for ranked in chosen.values()]
    return {key: series[key] for key in keys}
