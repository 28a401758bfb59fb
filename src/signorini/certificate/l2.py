"""A bound of the error in L2, by the inequality of Friedrichs.

It is of first order where P1 and CR themselves are of second: for the variational inequality no
duality argument gives a guaranteed bound of second order.
"""

import numpy as np

from signorini.certificate.pieces import NEXT


def l2_bound(enclosure, corners):
    """|u - u_h| <= |v' + w' - u_h| + C |grad(v' + w' - u)|.

    Parameters
    ----------
    enclosure : Enclosure
    corners : ndarray, shape (3, nt)
        u_h at the corners of each triangle.

    Returns
    -------
    float or None
        None without a Dirichlet part: a constant may be anything then.
    """
    if not enclosure.equilibrium.dirichlet.facets.size:
        return None
    square = 0.0
    rest = np.sqrt(enclosure.admissible.rest_values)
    for piece in enclosure.topology.pieces():
        values = enclosure.potential.corners[:, piece.cells] - corners[:, piece.cells]
        bubbles = 4.0 * enclosure.potential.bubbles[piece.t2f]
        own = np.sqrt(piece.area * mean_square(values, bubbles)) + rest[piece.cells]
        square += float(np.sum(own**2))
    return float(np.sqrt(square) + enclosure.friedrichs * enclosure.error_of_potential)


def mean_square(V, Q):
    """That of sum V_i lambda_i + sum Q_i lambda_i lambda_(i+1), as in `fields`.

    Parameters
    ----------
    V, Q : ndarray, shape (3, m)

    Returns
    -------
    ndarray, shape (m,)
        Unit of V squared.

    Examples
    --------
    That of a barycentric coordinate is 1/6, and of a product of two it is 1/90:

    >>> one, nothing = np.array([[1.0], [0.0], [0.0]]), np.zeros((3, 1))
    >>> [1.0 / float(mean_square(*pair)[0]) for pair in ((one, nothing), (nothing, one))]
    [6.0, 90.0]
    """
    total, all_q = V.sum(axis=0), Q.sum(axis=0)
    square = (total**2 + (V**2).sum(axis=0)) / 12.0
    square += (Q * (total + V + V[NEXT])).sum(axis=0) / 30.0
    return square + ((Q**2).sum(axis=0) + all_q**2) / 180.0
