"""Constraints from above, by mirrors: where u <= alpha, -u >= -alpha.

A solver knows bounds from below alone. `solvers.solve` mirrors a problem whose constraint is from
above, and its solution; nothing else does. Only signs change, so that nothing is rounded.
"""


def mirrored(problem):
    """The problem for -u: all data change their signs, and the constraint its side.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    Problem

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> problem = signorini.discretize(scene, "P1", 2)
    >>> mirrored(problem).upper, float(mirrored(problem).b[0] + problem.b[0])
    (True, 0.0)
    """
    load = None if problem.contact_load is None else negated(problem.contact_load)
    return problem.with_data(
        b=negated(problem.b),
        lower=negated(problem.lower),
        fixed_values=negated(problem.fixed_values),
        contact_load=load,
        upper=not problem.upper,
    )


def negated(values):
    """The values with opposite signs; a zero has none.

    Parameters
    ----------
    values : ndarray

    Returns
    -------
    ndarray

    Examples
    --------
    >>> import numpy as np
    >>> negated(np.array([0.0, -0.0, 2.5]))
    array([ 0. ,  0. , -2.5])
    """
    return 0.0 - values
