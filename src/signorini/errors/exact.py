"""Errors against an exact solution, by quadrature of the difference itself: nothing cancels.

Every triangle gets Radon's rule of degree 5, with seven points; near the solution's singular points it is cut into
parts as in `errors.graded`, and so is every triangle of a coarse mesh. Measured on interpolants of the families
corner, punch, smooth and biactive for n = 1 to 256, the quadrature changes the L2 norm by less than 1e-5 of itself and
the H1 seminorm by less than 2e-7 (at n = 64, and less on coarser and finer meshes); for r**(2/3), singular point
named, by less than 3e-5 and 2e-6.
"""

import numpy as np

from signorini.elements import element as find_element
from signorini.errors.graded import graded, root, scaled_weight, square, times_to_cut
from signorini.errors.reference import NORMS
from signorini.exceptions import SceneError
from signorini.norms import GRADIENT

_ROOT = np.sqrt(15.0)
# Radon (1948): the centroid and two orbits of three points (1 - 2s, s, s), exact for polynomials up to degree 5.
_ORBITS = [s + (1.0 - 3.0 * s) * np.eye(3) for s in ((6.0 - _ROOT) / 21.0, (6.0 + _ROOT) / 21.0)]
RADON = (
    np.concatenate([np.full((3, 1), 1 / 3), *_ORBITS], axis=1),
    np.repeat([9 / 40, (155.0 - _ROOT) / 1200.0, (155.0 + _ROOT) / 1200.0], [1, 3, 3]),
)

_FEWEST_TRIANGLES = 2**13  # fewer are cut until there are as many
_CHUNK = 2**15  # quadrature points at once


class ExactErrors:
    """Norms of u - u_h for an exact solution u.

    Parameters
    ----------
    exact : ExactSolution
    norms : sequence of str
        Of ``"l2"``, ``"h1_semi"``, ``"h1"`` and ``"energy"``; what is not named is not computed.

    Raises
    ------
    SceneError
        If a norm is unknown.

    Examples
    --------
    >>> from signorini.exact import family
    >>> from signorini.mesh import Grid
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", ("contact", "neumann", "dirichlet", "neumann"))
    >>> ExactErrors(family("patch"), ["l2"]).of(grid, "P1", 1.0 - grid.p[1])["l2"] < 1e-15
    True
    """

    def __init__(self, exact, norms=NORMS):
        unknown = [norm for norm in norms if norm not in _NEEDS]
        if unknown:
            raise SceneError(f"norms: unknown norm {unknown[0]!r}; known: {', '.join(_NEEDS)}")
        self.exact = exact
        self.norms = tuple(norms)

    def of(self, mesh, element, u, coefficient=None):
        """Norms of the error of a discrete solution.

        Parameters
        ----------
        mesh : Grid or Triangulation
        element : {"P1", "CR"}
        u : ndarray, shape (ndof,)
        coefficient : ndarray, shape (nt,), optional
            Diffusion coefficient of each triangle, 1 where not given: the weight of the energy norm.

        Returns
        -------
        dict
            The value of each of `NORMS`, or None for those that nothing asked for needs, as in `ReferenceErrors.of`;
            and of ``"energy"`` if asked for.

        Raises
        ------
        FormulaError
            Where the exact solution or its gradient is not finite.
        """
        values = find_element(element).vertex_values(mesh, u)
        asked = set(self.norms)
        slopes = mesh.gradients(values) if asked & set(GRADIENT) else None
        weight, exponent = (None, 0) if coefficient is None else scaled_weight(coefficient)
        l2, semi, energy = [], [], []
        for triangles, area, x, y, points, weights in self._parts(mesh):
            if asked & {"l2", "h1"}:
                l2.append(square(self.exact.value(x, y) - _at(points, values[:, triangles]), area, weights))
            if slopes is not None:
                for along, mean in zip(self.exact.gradient(x, y), slopes[:, triangles], strict=True):
                    semi.append(square(along - mean[:, None], area, weights))
                    if weight is not None and "energy" in asked:
                        energy.append(square(along - mean[:, None], area * weight[triangles], weights))
        squares = {"l2": l2, "h1_semi": semi, "h1": l2 + semi, "energy": energy or semi}
        known = {norm for norm, needs in _NEEDS.items() if asked & needs}
        found = {norm: root(squares[norm]) if norm in known else None for norm in dict.fromkeys((*NORMS, *self.norms))}
        return found | {norm: float(np.ldexp(found[norm], exponent)) for norm in ("energy",) if norm in self.norms}

    def _parts(self, mesh):
        """Yield (triangles, their areas, x, y, barycentric points, weights), a chunk of quadrature points at once."""
        p, t, area = mesh.p, mesh.t, np.broadcast_to(mesh.area, mesh.number_of_triangles)
        times = times_to_cut(area.size, _FEWEST_TRIANGLES, corners=3)
        step = max(1, _CHUNK // (RADON[1].size * 4**times))
        for start in range(0, area.size, step):
            corners = p[:, t[:, start : start + step]]
            for found, points, weights in graded(corners, self.exact.singular_points, RADON, times):
                yield start + found, area[start + found], *_at(points, corners[:, :, found]), points, weights


# What each norm is computed for.
_NEEDS = {"l2": {"l2", "h1"}, "h1_semi": {"h1_semi", "h1"}, "h1": {"h1"}, "energy": {"energy"}}


def _at(points, values):
    """An affine function, or several, by corner values (..., 3, m), at barycentric points (3, m or 1, q)."""
    return sum(values[..., i, :, None] * points[i] for i in range(3))
