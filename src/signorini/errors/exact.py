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
from signorini.errors.norms import ALWAYS_NAMED, GRADIENT, check_in_domain
from signorini.errors.pieces import Field, pieces
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
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> ExactErrors(family("patch"), ["l2"]).of(grid, "P1", 1.0 - grid.p[1])["l2"] < 1e-15
    True
    """

    def __init__(self, exact, norms=ALWAYS_NAMED):
        check_in_domain(norms)
        self.exact = exact
        self.norms = tuple(norms)

    def of(self, mesh, element, u, coefficient=None):
        """Norms of the error of a discrete solution.

        Parameters
        ----------
        mesh : Grid or Triangulation
        element : {"P1", "CR"} or Element
        u : ndarray, shape (ndof,)
        coefficient : ndarray, shape (nt,), optional
            Diffusion coefficient of each triangle, 1 where not given: the weight of the energy
            norm.

        Returns
        -------
        dict
            The value of each of `norms.ALWAYS_NAMED`, or None for those that no norm asked for
            needs, as in `ReferenceErrors.of`; and of ``"energy"`` if asked for.

        Raises
        ------
        FormulaError
            Where the exact solution or its gradient is not finite.

        Examples
        --------
        >>> from signorini.exact import family
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> errors = ExactErrors(family("patch"), ["l2"]).of(grid, "P1", 2.0 - grid.p[1])
        >>> round(errors["l2"], 12)
        1.0
        """
        values = find_element(element).vertex_values(mesh, u)
        wanted = set(self.norms)
        slopes = mesh.gradients(values) if wanted & set(GRADIENT) else None
        weight, exponent = None, 0
        if "energy" in wanted and coefficient is not None:
            weight, exponent = scaled_weight(coefficient)
        squares = self._squares(mesh, Field(values, slopes, weight))
        needed = {norm for norm, users in _NEEDED_FOR.items() if wanted & users}
        norms = {
            norm: root(squares[norm]) if norm in needed else None
            for norm in dict.fromkeys((*ALWAYS_NAMED, *self.norms))
        }
        if "energy" in wanted:
            norms["energy"] = float(np.ldexp(norms["energy"], exponent))
        return norms

    def _squares(self, mesh, field):
        """The squares over all pieces that add up to each norm, as `graded.square` gives them."""
        with_value = not {"l2", "h1"}.isdisjoint(self.norms)
        l2, semi, energy = [], [], []
        for piece in pieces(mesh, field, self.exact.singular_points):
            difference, *gradient = self._differences(piece, with_value)
            if difference is not None:
                l2.append(piece.squared(difference))
            semi += [piece.squared(slope) for slope in gradient]
            if field.weight is not None:
                energy += [piece.squared_energy(slope) for slope in gradient]
        if field.weight is None:
            energy = semi
        return {"l2": l2, "h1_semi": semi, "h1": l2 + semi, "energy": energy}

    def _differences(self, piece, with_value):
        """u - u_h, or None, and its derivatives if there are any to compare.

        One evaluation of u serves all.
        """
        u, *slopes = piece.field
        place = piece.x, piece.y
        if not slopes:
            return [self.exact.value(*place) - u if with_value else None]
        if not with_value:
            exact = self.exact.gradient(*place)
            return [None, *(a - b for a, b in zip(exact, slopes, strict=True))]
        exact = self.exact.value_and_gradient(*place)
        return [a - b for a, b in zip(exact, piece.field, strict=True)]


# The norms that each is computed for.
_NEEDED_FOR = {
    "l2": {"l2", "h1"},
    "h1_semi": {"h1_semi", "h1"},
    "h1": {"h1"},
    "energy": {"energy"},
}
