"""Which triangles to refine: Doerfler's bulk criterion."""

import numpy as np

from signorini.exceptions import SceneError


def bulk(contributions, theta):
    """Mark a smallest set of triangles that makes a share of the whole.

    Parameters
    ----------
    contributions : ndarray, shape (nt,)
        Of each triangle to the square of a bound, none negative.
    theta : float
        The share, above 0 and at most 1; 1 marks every triangle that contributes.

    Returns
    -------
    ndarray of bool, shape (nt,)

    Raises
    ------
    SceneError
        If theta is out of range.

    Notes
    -----
    W. Doerfler, SIAM J. Numer. Anal. 33 (1996), 1106-1124. The criterion is on squares: with theta
    = 1/2 the marked triangles carry half of the squared bound. Equal contributions are marked
    together, so that the marks do not depend on how triangles are numbered.

    Examples
    --------
    >>> bulk(np.array([1.0, 4.0, 1.0, 2.0]), 0.5)
    array([False,  True, False, False])
    """
    if not 0.0 < theta <= 1.0:
        raise SceneError(f"adapt.theta: {theta!r} is not valid; give a share above 0, at most 1")
    descending = np.sort(contributions)[::-1]
    sums = np.cumsum(descending)
    if not sums.size or not sums[-1] > 0.0:
        return np.zeros(contributions.shape, dtype=bool)
    last = min(int(np.searchsorted(sums, theta * sums[-1])), sums.size - 1)
    least = max(descending[last] * (1.0 - _EQUAL), np.finfo(float).tiny)
    return contributions >= least


_EQUAL = 1e-8  # contributions that differ by less are those of one symmetric pattern
