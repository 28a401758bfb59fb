"""Errors against an exact solution, by quadrature of the difference itself: nothing cancels.

The quadrature is that of `errors.pieces`. Measured on interpolants of the families corner, punch,
smooth and biactive for n = 1 to 256, the quadrature changes the L2 norm by less than 1e-5 of itself
and the H1 seminorm by less than 2e-7 (at n = 64, and less on coarser and finer meshes); for
r**(2/3), singular point named, by less than 3e-5 and 2e-6. On meshes graded to the contact side
with exponents 2 to 10 (n = 4 to 64), the same holds for corner, punch and r**(2/3), and it is 2e-5
and 6e-6 for the two without a singular point, smooth and biactive.
"""

import numpy as np

from signorini.errors.graded import root, scaled_weight
from signorini.errors.norms import GRADIENT
from signorini.errors.pieces import Field, pieces
from signorini.errors.reference import NORMS
from signorini.exceptions import SceneError
from signorini.fem.elements import find_element


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
    >>> from signorini.mesh.grid import Grid
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
            Diffusion coefficient of each triangle, 1 where not given: the weight of the energy
            norm.

        Returns
        -------
        dict
            The value of each of `NORMS`, or None for those that nothing asked for needs, as in
            `ReferenceErrors.of`; and of ``"energy"`` if asked for.

        Raises
        ------
        FormulaError
            Where the exact solution or its gradient is not finite.
        """
        values = find_element(element).vertex_values(mesh, u)
        asked = set(self.norms)
        slopes = mesh.gradients(values) if asked & set(GRADIENT) else None
        weight, exponent = (None, 0) if coefficient is None else scaled_weight(coefficient)
        weight = weight if "energy" in asked else None
        l2, semi, energy = [], [], []
        for piece in pieces(mesh, Field(values, slopes, weight), self.exact.singular_points):
            difference, *gradient = self._differences(piece, bool(asked & {"l2", "h1"}))
            l2 += [piece.squared(part) for part in (difference,) if part is not None]
            semi += [piece.squared(part) for part in gradient]
            if weight is not None:
                energy += [piece.squared_energy(part) for part in gradient]
        squares = {
            "l2": l2,
            "h1_semi": semi,
            "h1": l2 + semi,
            "energy": semi if weight is None else energy,
        }
        known = {norm for norm, needs in _NEEDS.items() if asked & needs}
        found = {
            norm: root(squares[norm]) if norm in known else None
            for norm in dict.fromkeys((*NORMS, *self.norms))
        }
        return found | {
            norm: float(np.ldexp(found[norm], exponent))
            for norm in ("energy",)
            if norm in self.norms
        }

    def _differences(self, piece, with_value):
        """u - u_h, or None, and its derivatives if there are any to compare; one evaluation of u
        serves all.
        """
        u, *slopes = piece.field
        if not slopes:
            return [self.exact.value(piece.x, piece.y) - u if with_value else None]
        if not with_value:
            return [
                None,
                *(
                    a - b
                    for a, b in zip(self.exact.gradient(piece.x, piece.y), slopes, strict=True)
                ),
            ]
        return [
            a - b
            for a, b in zip(
                self.exact.value_and_gradient(piece.x, piece.y), piece.field, strict=True
            )
        ]


# What each norm is computed for.
_NEEDS = {"l2": {"l2", "h1"}, "h1_semi": {"h1_semi", "h1"}, "h1": {"h1"}, "energy": {"energy"}}
