"""Whether solves keep what is promised, row by row of a frame of `success.measure`."""

import numpy as np

from signorini.studies.stability.proof import FEW, NEEDLESS

RESIDUAL = 1e-9
ERROR = 1e-10  # of u and of the multiplier, up to which a solution may be called solved
UNDERESTIMATE, OVERESTIMATE = 10.0, 1e3  # by which a stated accuracy may miss the error
# An estimate may be a thousand times the error, so from here on "inaccurate" may be due.
INACCURATE_FROM = ERROR / OVERESTIMATE
# An error that double precision makes likely, beyond which no digit is safe, and a solve may be
# refused.
REFUSED_FROM = 1e-2
LIMITS = {
    "residual": RESIDUAL,
    "error": ERROR,
    "underestimate": UNDERESTIMATE,
    "overestimate": OVERESTIMATE,
    "inaccurate_from": INACCURATE_FROM,
    "refused_from": REFUSED_FROM,
    "needless": NEEDLESS,
}
"""By name, for the templates of pages."""


def answered(rows):
    """Whether each is solved; or called less where double precision can do no better.

    Of u and of the contact forces, those alone may be inaccurate that are so in double precision,
    or that undecided contact dofs might move or bear; and the residual may be what rounding to
    doubles makes of the truth's, or what undecided contact dofs make of it.

    Returns
    -------
    pandas.Series of bool
    """
    undecided = rows["undecided"] > 0
    needed = undecided | (_right_so(rows, "") & _right_so(rows, "multiplier_"))
    stated = (rows["accuracy"] + rows["multiplier_accuracy"]).where(undecided, 0.0)
    most = np.fmax(np.fmax(RESIDUAL, FEW * rows["rounded_residual"]), stated)
    inaccurate = needed & (rows["residual"] <= most)
    solved, refused = rows["residual"] <= RESIDUAL, rows["limit"] > REFUSED_FROM
    by_status = inaccurate.mask(rows["status"] == "solved", solved)
    return by_status.mask(rows["status"] == "refused", refused)


def _right_so(rows, which):
    """Whether u or the forces are accurate, or double precision makes it likely that not."""
    return (rows[f"{which}accuracy"] <= ERROR) | (rows[f"{which}limit"] > INACCURATE_FROM)


def accurate(rows):
    """Whether u and multiplier are those of a solution called solved; not without a truth.

    Returns
    -------
    pandas.Series of bool

    Examples
    --------
    >>> import pandas as pd
    >>> rows = pd.DataFrame({"error": [1e-12, 1e-3], "multiplier_error": [1e-12, 1e-12]})
    >>> accurate(rows).tolist()
    [True, False]
    """
    return (rows["error"] <= ERROR) & (rows["multiplier_error"] <= ERROR)


def estimated(rows, which=""):
    """Whether the stated accuracy is at least a tenth, at most a thousand times the error.

    With undecided contact dofs it has no upper bound: it tells what they could do on the other
    side, too.

    Parameters
    ----------
    rows : pandas.DataFrame
    which : {"", "multiplier_"}, optional
        Of u, or of the contact forces.

    Returns
    -------
    pandas.Series of bool

    Examples
    --------
    An error of 1e-12 stated as 1e-11, and as 1e-14, a hundred times too small:

    >>> import pandas as pd
    >>> rows = {"error": 1e-12, "accuracy": [1e-11, 1e-14], "floor": 1e-16, "undecided": 0}
    >>> estimated(pd.DataFrame(rows)).tolist()
    [True, False]
    """
    accuracy, error, floor = (rows[f"{which}{name}"] for name in ("accuracy", "error", "floor"))
    close = (rows["undecided"] > 0) | (accuracy <= OVERESTIMATE * np.fmax(error, floor))
    return (error <= UNDERESTIMATE * accuracy) & close
