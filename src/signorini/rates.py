"""Slopes of error against mesh size."""

import math

from signorini.exceptions import SignoriniError


def slopes(h, errors):
    """Slopes of log(error) against log(h).

    Parameters
    ----------
    h : sequence of float
        Mesh sizes, decreasing; at least two.
    errors : sequence of float
        Positive; same length.

    Returns
    -------
    dict
        ``"mean"``: mean of the slopes between successive levels, which for halved h is the slope between the end
        points; ``"fit"``: least-squares line. Dimensionless.

    Raises
    ------
    SignoriniError
        If there are fewer than two levels, or an error is zero (log 0): the solution equals its truth there.
    """
    if len(h) < 2:
        raise SignoriniError(f"rates: a slope needs two levels, found {len(h)}; add one to levels or drop rates")
    for size, value in zip(h, errors, strict=True):
        if not (value > 0.0 and math.isfinite(value)):
            raise SignoriniError(
                f"rates: the error at h = {size:g} is {value:g}, which has no logarithm; drop this level"
            )
    x, y = [math.log(v) for v in h], [math.log(v) for v in errors]
    steps = [(b - a) / (d - c) for a, b, c, d in zip(y, y[1:], x, x[1:], strict=False)]
    mx, my = math.fsum(x) / len(x), math.fsum(y) / len(y)
    fit = math.fsum((a - mx) * (b - my) for a, b in zip(x, y, strict=True)) / math.fsum((a - mx) ** 2 for a in x)
    return {"mean": math.fsum(steps) / len(steps), "fit": fit}
