"""A discrete Signorini problem: what a solver sees.

Minimise u'Au/2 - b'u such that u >= lower on the contact dofs and u is given on the fixed ones.
Where the constraint is from above, u <= lower; -u then solves the mirrored problem.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from signorini.exceptions import MeshError
from signorini.fem.data import Data
from signorini.fem.elements import find_element
from signorini.fem.residual import contact_fluxes_of
from signorini.fem.stencil import apply_stiffness, contact_fluxes, diagonal
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation


@dataclass(frozen=True, eq=False, repr=False)
class Problem:
    """A discrete Signorini problem; equation (2.6) of the paper, or its conforming counterpart.

    Parameters
    ----------
    element : {"P1", "CR"}
    mesh : Grid or Triangulation
    b : ndarray, shape (ndof,)
        Load, that of a threshold on the contact part included.
    contact : ndarray of int, shape (nc,)
        Degrees of freedom under the constraint, increasing.
    lower : ndarray, shape (nc,)
        The obstacle at them, unit of u: a bound from below, or from above where `upper`.
    fixed : ndarray of int, shape (nd,)
        Degrees of freedom on the Dirichlet part, increasing.
    fixed_values : ndarray, shape (nd,)
        Their values, unit of u.
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each triangle; None where it is 1 throughout.
    data : Data, optional
        What it was discretised from.
    n : int, optional
        Its level.
    h : float, optional
        Mesh width of the level, unit of length.
    contact_load : ndarray, shape (ndof,), optional
        What a threshold s of k du/dnu on the contact part gives to `b`; None where it is 0.
    upper : bool
        Whether the constraint is u <= `lower`.

    Raises
    ------
    SceneError, MeshError
        If element or mesh is of no such kind.
    """

    element: str
    mesh: Grid | Triangulation
    b: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    fixed: np.ndarray
    fixed_values: np.ndarray
    coefficient: np.ndarray | None = None
    data: Data | None = None
    n: int | None = None
    h: float | None = None
    contact_load: np.ndarray | None = None
    upper: bool = False

    def __post_init__(self):
        find_element(self.element)
        if not isinstance(self.mesh, Grid | Triangulation):
            raise MeshError(
                f"mesh: a {type(self.mesh).__name__} has no labelled boundary; "
                "let signorini.problem(mesh, ...) make the problem, it takes most meshes"
            )

    def __repr__(self):
        level = "" if self.n is None else f", n = {self.n}"
        return (
            f"<Problem: {self.element}{level}: {self.b.size} dofs, {self.contact.size} in contact>"
        )

    @property
    def finite_element(self):
        """The `Element` itself."""
        return find_element(self.element)

    @cached_property
    def A(self):
        """Stiffness matrix, scipy.sparse CSR (ndof, ndof), unit of the coefficient.

        It is assembled when first asked for.
        """
        from signorini.fem.stiffness import assemble_stiffness

        return assemble_stiffness(self.mesh, self.finite_element, self.coefficient)

    @cached_property
    def free(self):
        """Degrees of freedom that are not fixed, increasing.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> problem.free.size + problem.fixed.size == problem.b.size
        True
        """
        mask = np.ones(self.b.size, dtype=bool)
        mask[self.fixed] = False
        return np.flatnonzero(mask)

    @cached_property
    def grid(self):
        """The mesh where a stencil is the whole matrix, else None.

        That is a uniform `Grid` with coefficient 1.
        """
        return self.mesh if isinstance(self.mesh, Grid) and self.coefficient is None else None

    def apply(self, u):
        """A @ u, without the matrix where a stencil is the whole of it (see `grid`).

        Examples
        --------
        A constant meets no force:

        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> bool(np.abs(problem.apply(np.ones(problem.b.size))).max() < 1e-14)
        True
        """
        if self.grid is not None:
            return apply_stiffness(self.grid, self.finite_element, u)
        return self.A @ u

    def diagonal(self):
        """The diagonal of A, (ndof,), without the matrix where a stencil is the whole of it."""
        if self.grid is not None:
            return diagonal(self.grid, self.finite_element)
        return self.A.diagonal()

    @property
    def contact_points(self):
        """Where the contact dofs are, shape (2, nc), unit of length.

        Vertices for P1, midpoints of facets for CR.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "CR", 4)
        >>> problem.contact_points
        array([[0.125, 0.375, 0.625, 0.875],
               [0.   , 0.   , 0.   , 0.   ]])
        """
        return self.finite_element.nodes(self.mesh, self.contact)

    def contact_fluxes(self, u):
        """What flows into the contact dofs when the dofs are `u`.

        Each is summed from differences of u, so that no entry of A hides it, however large.

        Parameters
        ----------
        u : ndarray, shape (ndof,)

        Returns
        -------
        force, fluxes, sizes : ndarray, shape (nc,)
            (A u) at the contact dofs, the sum of the sizes of its differences, and (|A| |u|) there,
            what rounding of u is relative to; unit of the load.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> force, fluxes, sizes = problem.contact_fluxes(problem.mesh.p[1])
        >>> bool(np.all(np.abs(force) <= fluxes)), bool(np.all(fluxes <= sizes))
        (True, True)
        """
        if not self.contact.size:
            return np.zeros((3, 0))
        if self.grid is not None:
            return contact_fluxes(self.grid, self.finite_element, u, self.contact)
        return contact_fluxes_of(self.A[self.contact], self.contact, u)

    @cached_property
    def contact_lengths(self):
        """The length of contact part that each contact dof stands for, (nc,), unit of length.

        For CR that of its facet, for P1 half of each contact facet that meets there.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 4)
        >>> problem.contact_lengths
        array([0.125, 0.25 , 0.25 , 0.25 , 0.125])
        """
        return self.finite_element.boundary_lengths(self.mesh, "contact")[self.contact]

    def with_data(self, **data):
        """The same problem with other data; its matrix is kept if it is there already.

        Parameters
        ----------
        **data
            Any of the fields on which A does not depend, such as ``b`` and ``lower``.

        Returns
        -------
        Problem

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> double = problem.with_data(b=2.0 * problem.b)
        >>> bool(np.all(double.b == 2.0 * problem.b)), double.mesh is problem.mesh
        (True, True)
        """
        changed = replace(self, **data)
        if "A" in vars(self):
            vars(changed)["A"] = self.A  # where `cached_property` looks it up
        return changed

    @property
    def threshold(self):
        """The threshold's force on each contact dof, (nc,), unit of k u; None where it is 0.

        The contact force, an integral of k du/dnu, is this and the multiplier.
        """
        return None if self.contact_load is None else self.contact_load[self.contact]

    def scaled(self, exponent):
        """The problem whose data, and so whose solution, are 2**exponent times these.

        A power of two rounds nothing, but where the result is subnormal or overflows.

        Parameters
        ----------
        exponent : int

        Returns
        -------
        Problem
            This one where the exponent is 0.

        Examples
        --------
        >>> import signorini
        >>> scene = signorini.load_scene("config/scenes/paper.yaml")
        >>> problem = signorini.discretize(scene, "P1", 2)
        >>> float(problem.scaled(3).b[0] / problem.b[0])
        8.0
        """
        if not exponent:
            return self
        return self.with_data(
            b=np.ldexp(self.b, exponent),
            lower=np.ldexp(self.lower, exponent),
            fixed_values=np.ldexp(self.fixed_values, exponent),
            contact_load=_scaled(self.contact_load, exponent),
        )

    def shifted(self, constant):
        """The problem whose solution is less by a constant, unit of u.

        Every row of A sums to zero, so the load stays as it is.

        Parameters
        ----------
        constant : float

        Returns
        -------
        Problem
            This one where the constant is 0.

        Examples
        --------
        >>> from signorini import discretize, load_scene
        >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
        >>> float(problem.lower[0] - problem.shifted(1.0).lower[0])
        1.0
        """
        if not constant:
            return self
        return self.with_data(
            lower=self.lower - constant, fixed_values=self.fixed_values - constant
        )


def _scaled(values, exponent):
    return None if values is None else np.ldexp(values, exponent)
