"""Performance profiles (E. D. Dolan, J. J. More, Math. Program. 91 (2002) 201-213).

rho_s(tau) is the share of problems that solver s solves in at most tau times the time of the
fastest solver. rho_s(1) is how often it is the fastest; the limit, how much it solves at all.
"""

import numpy as np


def ratios(times):
    """Times over the least of all solvers, problem by problem.

    Parameters
    ----------
    times : dict
        Solver -> sequence of its time of each problem in the same order, positive, in any unit;
        infinite where it failed.

    Returns
    -------
    dict
        Solver -> ndarray of ratios, infinite where it failed.

    Examples
    --------
    >>> {name: found.tolist() for name, found in ratios({"a": [1, 2], "b": [2, np.inf]}).items()}
    {'a': [1.0, 1.0], 'b': [2.0, inf]}
    """
    table = np.array([list(values) for values in times.values()], dtype=float)
    least = table.min(axis=0)
    least[np.isinf(least)] = 1.0  # nobody solved it
    return dict(zip(times, table / least, strict=True))


def profile(found):
    """The steps of a profile.

    Parameters
    ----------
    found : ndarray, shape (problems,)
        Ratios of one solver, of `ratios`.

    Returns
    -------
    tau, rho : ndarray
        rho[k] is the share of ratios that are at most tau[k]; tau increases from 1 on.

    Examples
    --------
    >>> tau, rho = profile(np.array([1.0, 4.0, np.inf, 1.0]))
    >>> tau.tolist(), rho.tolist()
    ([1.0, 4.0], [0.5, 0.75])
    """
    tau = np.unique(np.append(found[np.isfinite(found)], 1.0))
    rho = np.searchsorted(np.sort(found), tau, side="right") / found.size
    return tau, rho
