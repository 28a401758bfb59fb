"""The round-off in the norms of an error: below it, an error says nothing of the discretisation."""

import numpy as np

from signorini.exact.sides import find_side

# On the contact patch test, where all errors are round-off, none exceeds its floor without this factor more than 1.6
# times (n = 2 to 128, both elements, both routes).
_FACTOR = 8.0


def norm_floors(mesh, size, accuracy, norms, coefficient=None):
    """The size of each norm of an error that is round-off alone.

    An error of every degree of freedom, independent of the others, has in l2 the norm of a constant; in a gradient it
    is divided by the width of its triangle, in the multiplier by the length of its facet.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    size : float
        Largest degree of freedom, unit of u.
    accuracy : float
        Relative accuracy of the solution and its truth, the worse of the two; dimensionless.
    norms : sequence of str
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each triangle, 1 where not given.

    Returns
    -------
    dict of str to float
        For each of the norms but the distance of critical points, in its unit.
    """
    k = np.ones(mesh.number_of_triangles) if coefficient is None else coefficient
    rounding = _FACTOR * max(float(np.finfo(float).eps), accuracy) * size
    return {norm: rounding * float(np.sqrt(_SQUARES[norm](mesh, k))) for norm in norms if norm in _SQUARES}


def _area(mesh, k):
    return np.sum(np.broadcast_to(mesh.area, k.size))


# The square of each norm of an error of size one in every degree of freedom.
_SQUARES = {
    "l2": _area,
    "h1_semi": lambda mesh, k: k.size,
    "h1": lambda mesh, k: _area(mesh, k) + k.size,
    "energy": lambda mesh, k: np.sum(k),
    "trace_l2": lambda mesh, k: np.sum(find_side(mesh, "contact").length),
    "multiplier_l2": lambda mesh, k: np.max(k) ** 2 * np.sum(1.0 / find_side(mesh, "contact").length),
}
