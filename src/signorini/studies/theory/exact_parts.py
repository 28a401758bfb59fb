"""What the theory asks of an exact solution: means over edges, contact terms, Sobolev norms.

Quadrature is graded towards singular points, as that of the errors (`errors.graded`).
"""

import math
from dataclasses import dataclass

import numpy as np

from signorini.errors.graded import graded
from signorini.errors.pieces import Field, pieces
from signorini.fem.quadrature import interval_rule

_DEGREE = 15  # of the rule on an edge, or on a part of one near a singular point
_STEP = 1e-4  # of differences, in units of length or of the distance to a singular point


def edge_integrals(function, ends, singular_points):
    """Integrals of functions over segments.

    Parameters
    ----------
    function : callable
        From coordinates x, y, shape (m, q), the fractions s (m, q) of the way along the segment and
        the segments' numbers (m,) to values of shape (m, q).
    ends : ndarray, shape (2, 2, m)
        Axis, end, segment; unit of length.
    singular_points : sequence of (float, float)

    Returns
    -------
    ndarray, shape (m,)

    Examples
    --------
    The integral of x over the segment from (0, 0) to (2, 0):

    >>> ends = np.array([[[0.0], [2.0]], [[0.0], [0.0]]])
    >>> edge_integrals(lambda x, y, s, which: x, ends, ()).round(12)
    array([2.])
    """
    s, weights = interval_rule(_DEGREE)
    rule = np.stack([1.0 - s, s]), weights
    length = np.hypot(*(ends[:, 1] - ends[:, 0]))
    integrals = np.zeros(length.size)
    for which, points, shares, part_weights in graded(ends, singular_points, rule):
        x, y = (sum(axis[i, which, None] * points[i] for i in range(2)) for axis in ends)
        along = np.broadcast_to(points[1], x.shape)
        values = function(x, y, along, which)
        totals = shares * (values * part_weights).sum(axis=1)
        integrals += np.bincount(which, totals, minlength=length.size)
    return length * integrals


def interpolate(exact, mesh):
    """The Crouzeix-Raviart interpolant of an exact solution, by its means over edges.

    Parameters
    ----------
    exact : ExactSolution
    mesh : Grid or Triangulation

    Returns
    -------
    ndarray, shape (number_of_facets,)
        Values of Pi u at the midpoints; unit of u.

    Examples
    --------
    An affine function is its own interpolant, so that means are the values at midpoints:

    >>> from signorini.exact import family
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
    >>> middles = grid.p[:, grid.facets].mean(axis=1)
    >>> bool(np.allclose(interpolate(family("patch"), grid), 1.0 - middles[1]))
    True
    """
    ends = np.asarray(mesh.p)[:, np.asarray(mesh.facets)]
    length = np.hypot(*(ends[:, 1] - ends[:, 0]))
    integrals = edge_integrals(
        lambda x, y, s, which: exact.value(x, y), ends, exact.singular_points
    )
    return integrals / length


@dataclass(frozen=True)
class SobolevNorms:
    """Norms of an exact solution on a domain.

    Attributes
    ----------
    l2, h1_semi, h2_semi : float
        Of u, its gradient and its second derivatives.
    boundary_lipschitz : float
        The greatest slope of u along the boundary, at quadrature points.
    """

    l2: float
    h1_semi: float
    h2_semi: float
    boundary_lipschitz: float

    @property
    def h2(self):
        """The full norm of order two."""
        return float(np.sqrt(self.l2**2 + self.h1_semi**2 + self.h2_semi**2))


def sobolev_norms(exact, mesh):
    """Norms of an exact solution, by quadrature on a mesh.

    Parameters
    ----------
    exact : ExactSolution
    mesh : Grid or Triangulation

    Returns
    -------
    SobolevNorms

    Examples
    --------
    Of u = 1 - y on the unit square:

    >>> from signorini.exact import family
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> norms = sobolev_norms(family("patch"), grid)
    >>> round(norms.l2**2, 9), round(norms.h1_semi, 9)
    (0.333333333, 1.0)
    """
    squares = np.zeros(3)
    zero = Field(np.zeros((3, mesh.number_of_triangles)))
    for piece in pieces(mesh, zero, exact.singular_points):
        x, y = np.broadcast_arrays(piece.x, piece.y)
        u, ux, uy = exact.value_and_gradient(x, y)
        uxx, uxy, uyy = second_derivatives(exact, x, y)
        parts = (u,), (ux, uy), (uxx, uxy, uxy, uyy)
        for k, values in enumerate(parts):
            squares[k] += math.fsum(_plain(piece.squared(value)) for value in values)
    return SobolevNorms(*np.sqrt(squares).tolist(), _boundary_slope(exact, mesh))


def _plain(square):
    """A sum of squares as `errors.graded.square` gives it, as one number."""
    mantissa, exponent = square
    return float(np.ldexp(mantissa, 2 * exponent))


def second_derivatives(exact, x, y):
    """Second derivatives by central differences of the exact gradient, of fourth order.

    Parameters
    ----------
    exact : ExactSolution
    x, y : ndarray
        Unit of length.

    Returns
    -------
    uxx, uxy, uyy : ndarray

    Examples
    --------
    Of x**2 y + y**3 at (1, 2), from its gradient:

    >>> from signorini.exact.solution import FormulaSolution
    >>> from signorini.formula import Formula
    >>> exact = FormulaSolution(Formula("x**2*y + y**3"))
    >>> second = second_derivatives(exact, np.ones(1), np.full(1, 2.0))
    >>> [round(float(part[0]), 6) for part in second]
    [4.0, 2.0, 12.0]
    """
    step = np.ones(np.shape(x))
    for a, b in exact.singular_points:
        step = np.minimum(step, np.hypot(x - a, y - b))
    step = _STEP * step
    # The body lies above its contact side; differences along y stay on one side of it.
    along_x = _derivative(lambda t: exact.gradient(x + t * step, y), step, (-2, -1, 1, 2))
    along_y = _derivative(lambda t: exact.gradient(x, y + t * step)[1:], step, (0, 1, 2, 3, 4))
    return along_x[0], along_x[1], along_y[0]


# Weights of differences at so many steps, of fourth order.
_WEIGHTS = {
    (-2, -1, 1, 2): (1 / 12, -2 / 3, 2 / 3, -1 / 12),
    (0, 1, 2, 3, 4): (-25 / 12, 4, -3, 4 / 3, -1 / 4),
}


def _derivative(function, step, places):
    values = [function(place) for place in places]
    weights = _WEIGHTS[places]
    total = [
        sum(w * value[k] for w, value in zip(weights, values, strict=True))
        for k in range(len(values[0]))
    ]
    return [part / step for part in total]


def _boundary_slope(exact, mesh):
    """The greatest derivative of u along the boundary."""
    from signorini.mesh.boundary import LABELS
    from signorini.mesh.boundary_trace import find_boundary_trace

    s, _ = interval_rule(_DEGREE)
    steepest = 0.0
    for label in LABELS:
        trace = find_boundary_trace(mesh, label)
        if not trace.length.size:
            continue
        ux, uy = exact.gradient(*trace.points(s))
        nx, ny = trace.normal[:, :, None]
        steepest = max(steepest, float(np.abs(ux * ny - uy * nx).max()))
    return steepest
