"""The solution that tells a program what it wants to know."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from signorini.api.saving import saved
from signorini.api.types import Floats
from signorini.exceptions import SceneError
from signorini.solvers import Solution as SolverSolution

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame


@dataclass(frozen=True, eq=False, repr=False)
class Solution(SolverSolution):
    """What was found, its proof, and what it tells.

    Made by `solve`. Its fields, frozen, are those of `signorini.solvers.Solution`: ``u``, the
    degrees of freedom; ``multiplier``, ``active`` and ``undecided`` at the contact dofs;
    ``residual``, ``accuracy``, ``multiplier_accuracy`` and ``status``, the proof; ``iterations``,
    ``method`` and ``reason``; ``constant`` and ``deviation``; and the ``problem``.
    """

    def __repr__(self) -> str:
        return (
            f"<Solution: {self.status} by {self.method}: {self.u.size} dofs, "
            f"{self.active.sum()} of {self.active.size} contact dofs bind>"
        )

    @property
    def points(self) -> Floats:
        """Where the degrees of freedom are, shape (2, ndof), unit of length.

        Vertices for P1, midpoints of facets for CR.
        """
        element, mesh = self.problem.finite_element, self.problem.mesh
        return element.nodes(mesh, np.arange(self.u.size))

    @property
    def contact_points(self) -> Floats:
        """Where the contact dofs are, shape (2, nc), unit of length."""
        return self.problem.contact_points

    @property
    def resultant(self) -> float:
        """The whole contact force, the integral of k du/dnu over the contact part, unit of k u.

        It is the sum of `force`, so that it balances the other forces exactly: tested with v = 1
        near the contact part, not integrated from a gradient.

        Examples
        --------
        Nothing else holds the body: the obstacle carries all of the load -1.

        >>> import signorini
        >>> problem = signorini.problem(signorini.rectangle(8), f=-1, contact=["bottom", "top"])
        >>> round(signorini.solve(problem).resultant, 12)
        1.0
        """
        return float(self.force.sum())

    @property
    def critical_points(self) -> Floats:
        """Where the constraint starts to bind, shape (2, k), unit of length.

        Midway between neighbouring contact dofs of which one binds: known to half a mesh width.

        Examples
        --------
        >>> import signorini
        >>> sides = {"dirichlet": {"top": 0}, "contact": "bottom"}
        >>> problem = signorini.problem(signorini.rectangle(64), f="sin(2*pi*x)", **sides)
        >>> signorini.solve(problem).critical_points
        array([[0.6875],
               [0.    ]])
        """
        from signorini.fem.contact_line import critical_points

        problem = self.problem
        return critical_points(problem.mesh, problem.element, problem.contact, self.active)

    @property
    def gradient(self) -> Floats:
        """Gradient of u on each triangle, shape (2, nt), unit of u per length.

        Examples
        --------
        >>> import signorini
        >>> ends = {"top": 3, "bottom": 0}
        >>> problem = signorini.problem(signorini.rectangle(1), f=0, dirichlet=ends)
        >>> signorini.solve(problem).gradient.round(12) + 0.0
        array([[0., 0.],
               [3., 3.]])
        """
        mesh = self.problem.mesh
        return mesh.gradients(self.problem.finite_element.vertex_values(mesh, self.u))

    def at(self, points: Any) -> Floats:
        """u at points.

        Parameters
        ----------
        points : array_like, shape (2, ...)
            In the domain, unit of length: one point (x, y), x above y for several, or what
            `numpy.meshgrid` returns.

        Returns
        -------
        float or ndarray, shape (...)
            Where a CR function jumps, between triangles, the value in one of them.

        Raises
        ------
        MeshError
            If the points are no finite numbers of that shape, or one lies outside the domain.

        Examples
        --------
        u = y between 0 below and 1 above:

        >>> import signorini
        >>> ends = {"top": 1, "bottom": 0}
        >>> problem = signorini.problem(signorini.rectangle(4), f=0, dirichlet=ends)
        >>> signorini.solve(problem).at([[0.3, 0.3], [0.25, 0.9]]).round(12)
        array([0.25, 0.9 ])
        >>> float(signorini.solve(problem).at((0.3, 0.25)).round(12))
        0.25
        """
        from signorini.fem.evaluate import evaluate

        return evaluate(self.problem.mesh, self.problem.element, self.u, points)

    def errors(self, exact: Any, norms: Sequence[str] | None = None) -> dict[str, Any]:
        """Norms of the error.

        Parameters
        ----------
        exact : ExactSolution, str, dict, pair (u, gradient), or a finer Solution
            An exact solution, see `exact_solution`; or a solution on a mesh that was refined from
            this one's.
        norms : sequence of str, optional
            Of l2, h1_semi, h1 and energy; and with an exact solution, on the contact part, of
            trace_l2, multiplier_l2 and critical_points. By default all that apply; critical_points
            where the exact solution names some; multiplier_l2 unless the coefficient is a number
            for each subdomain.

        Returns
        -------
        dict
            Norm -> error, None for those of l2, h1_semi and h1 that are not asked for; and
            ``floor``, the names of those that are round-off alone. As in errors.csv.

        Raises
        ------
        SceneError, FormulaError, MeshError
            If the exact solution is none, or has a value that is not finite, a norm is unknown, or
            the other solution's mesh is no refinement of this one's, or it solves another problem.

        Notes
        -----
        Against an exact solution the difference itself is integrated, by a quadrature that is
        refined at singular points; against a finer solution all is exact. One that is not at least
        four times as fine is warned of, as it has an error of its own.

        Examples
        --------
        >>> import signorini
        >>> exact = "x**2 - y**2"
        >>> sides = {"dirichlet": ["bottom", "right", "top", "left"]}
        >>> problem = signorini.problem(signorini.rectangle(8), "P1", exact=exact, **sides)
        >>> round(signorini.solve(problem).errors(exact)["l2"], 4)
        0.0016
        """
        from signorini.api.measures import measure_of, warn_of_reference

        found = measure_of(exact, self, norms)(self)
        warn_of_reference(exact, [self.problem], stacklevel=2)
        return found

    def contact_line(self) -> "DataFrame":
        """What happens along the contact part: a row for each contact dof, in order.

        Returns
        -------
        pandas.DataFrame
            The columns of contact_line.csv: arc length ``s``, ``x``, ``y``, ``u``, ``obstacle``,
            ``flux``, ``binding``, and so on.
        """
        from signorini.api.frame import as_frame

        return as_frame(self._contact_rows())

    def _contact_rows(self) -> list[dict[str, Any]]:
        from signorini.api.measures import as_stored
        from signorini.fem.contact_line import contact_rows

        return contact_rows(self.problem.mesh, as_stored(self))

    def plot(self, path: str | Path | None = None, title: str = "") -> "Figure":
        """Draw u, the conditions on the boundary, and where the constraint binds.

        Parameters
        ----------
        path : str or Path, optional
            Where to write the figure, .pdf or .png.
        title : str, optional
            Plain text.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from signorini.api.measures import as_stored
        from signorini.figures.field import draw_field
        from signorini.report.field import field_of

        return saved(draw_field(field_of(self.problem.mesh, as_stored(self)), title), path)

    def plot_contact(self, path: str | Path | None = None) -> "Figure":
        """Draw u over the obstacle, and below it the contact force, along the contact part.

        Parameters
        ----------
        path : str or Path, optional
            Where to write the figure, .pdf or .png.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        SceneError
            If there is no contact part.
        """
        from signorini.figures.contact_line import draw_contact_line

        rows = self._contact_rows()
        if not rows:
            raise SceneError(
                "contact: the problem has no contact part to draw; name one in contact"
            )
        return saved(draw_contact_line(rows), path)

    def to_vtu(self, path: str | Path) -> None:
        """Write u, its gradient, the coefficient, the boundary and the contact for ParaView.

        Parameters
        ----------
        path : str or Path
            Ending in .vtu; meshio must be installed.

        Raises
        ------
        SceneError
            If the path ends otherwise.
        StorageError
            If the file cannot be written.
        """
        if Path(path).suffix != ".vtu":
            raise SceneError(f"path: {Path(path).name!r} is no VTU file; end it in .vtu")
        from signorini.api.measures import as_stored
        from signorini.report.vtu import write_vtu

        given, mesh = self.problem.coefficient, self.problem.mesh
        coefficient = np.ones(mesh.number_of_triangles) if given is None else given
        write_vtu(path, mesh, as_stored(self), {"coefficient": coefficient})

    def to_skfem(self) -> tuple[Any, Floats]:
        """The solution as scikit-fem has it.

        Returns
        -------
        basis : skfem.Basis
            Of `ElementTriP1` or `ElementTriCR`, its mesh's boundaries named by what holds there,
            and by the names of parts.
        u : ndarray, shape (ndof,)
            Its degrees of freedom.

        Examples
        --------
        >>> import signorini
        >>> mesh = signorini.rectangle(4)
        >>> problem = signorini.problem(mesh, f=0, dirichlet={"top": "x"}, contact="bottom")
        >>> basis, u = signorini.solve(problem).to_skfem()
        >>> basis.mesh.boundaries.keys() >= {"contact", "dirichlet", "neumann"}
        True
        """
        import skfem

        element = self.problem.finite_element.skfem()
        return skfem.Basis(self.problem.mesh.skfem, element), self.u
