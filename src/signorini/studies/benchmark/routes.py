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
