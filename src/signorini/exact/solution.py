"""What an exact solution is: u, its gradient and its load at any point; the flux follows."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from signorini.fem.function import Function
from signorini.formula import Formula


class ExactSolution(ABC):
    """A function u that solves a Signorini problem, equation (2.2) of the paper, with its own load.

    Subclasses give `value`, `gradient` and `load`. All methods take coordinates in the user's unit
    of length, broadcast against each other, and return new arrays of the broadcast shape.

    Attributes
    ----------
    obstacle : Formula or None
        Lower bound of u on the contact side, unit of u; None where the data say what it is.
    multiplier : Formula or None
        k du/dnu less its threshold on the contact side, unit of k u per length; None where the data
        say what the threshold is.
    critical_points : tuple of (float, float)
        Where on the contact side the constraint starts to bind, so far as they are known.
    singular_points : tuple of (float, float)
        Where a derivative of u is unbounded; quadrature is refined towards them.
    constant_load : float or None
        The load's value where it is known to be the same everywhere.
    knows_load : bool
        Whether `load` can be called: it needs second derivatives.
    coefficient : Formula or None
        Diffusion coefficient k; None where it is 1.
    """

    obstacle = None
    multiplier = None
    coefficient = None
    critical_points = ()
    singular_points = ()
    constant_load = None
    knows_load = True

    @abstractmethod
    def value(self, x, y):
        """u at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> from signorini.exact.families import family
        >>> float(family("patch").value(0.5, 0.25))
        0.75
        """

    @abstractmethod
    def gradient(self, x, y):
        """Partial derivatives of u at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ux, uy : ndarray
            du/dx and du/dy, unit of u per length.

        Examples
        --------
        >>> from signorini.exact.families import family
        >>> ux, uy = family("patch").gradient(0.5, 0.25)
        >>> float(ux), float(uy)
        (0.0, -1.0)
        """

    def value_and_gradient(self, x, y):
        """u and its partial derivatives at points; subclasses share work between them.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        u, ux, uy : ndarray

        Examples
        --------
        >>> from signorini.exact.families import family
        >>> u, ux, uy = family("patch").value_and_gradient(0.5, 0.25)
        >>> float(u), float(ux), float(uy)
        (0.75, 0.0, -1.0)
        """
        return self.value(x, y), *self.gradient(x, y)

    @abstractmethod
    def load(self, x, y):
        """-div(k grad u) at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray
            Unit of k u per length squared.

        Examples
        --------
        >>> from signorini.exact.families import family
        >>> float(family("uniform-load", {"c": 2}).load(0.5, 0.25))
        2.0
        """

    def flux(self, x, y, nx, ny):
        """k du/dnu, the flux through a line, at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.
        nx, ny : array_like of float
            Unit normal of the line, outward on the boundary; dimensionless.

        Returns
        -------
        ndarray
            Unit of k u per length.

        Examples
        --------
        >>> from signorini.exact.families import family
        >>> float(family("patch").flux(0.5, 0.0, 0.0, -1.0))
        1.0
        """
        ux, uy = self.gradient(x, y)
        return ux * nx + uy * ny + 0.0


@dataclass(frozen=True)
class FormulaSolution(ExactSolution):
    """An exact solution from a formula; its gradient and Laplacian are derived exactly.

    Parameters
    ----------
    u : Formula
    obstacle : Formula, optional
    critical_points, singular_points : tuple of (float, float)
    multiplier : Formula, optional

    Raises
    ------
    FormulaError
        From each method, at the first point where its result is not finite.

    Examples
    --------
    >>> exact = FormulaSolution(Formula("x**2*y", "truth.u"))
    >>> float(exact.load(3.0, 2.0)), float(exact.flux(3.0, 2.0, 0.0, -1.0))
    (-4.0, -9.0)
    """

    u: Formula
    obstacle: Formula | None = None
    critical_points: tuple[tuple[float, float], ...] = ()
    singular_points: tuple[tuple[float, float], ...] = ()
    multiplier: Formula | Function | None = None

    @property
    def constant_load(self):
        """Zero where u mentions no variable, else None: not known.

        Examples
        --------
        >>> FormulaSolution(Formula("1", "truth.u")).constant_load
        0.0
        """
        return None if self.u.variables else 0.0

    def value(self, x, y):
        """The formula at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> exact = FormulaSolution(Formula("x**2*y", "truth.u"))
        >>> float(exact.value(3.0, 2.0))
        18.0
        """
        return self.u(x, y)

    def gradient(self, x, y):
        """Partial derivatives of the formula at points, by forward mode.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ux, uy : ndarray

        Examples
        --------
        >>> exact = FormulaSolution(Formula("x**2*y", "truth.u"))
        >>> ux, uy = exact.gradient(3.0, 2.0)
        >>> float(ux), float(uy)
        (12.0, 9.0)
        """
        return tuple(self.u.expand(("d/dx", "d/dy"), x, y))

    def value_and_gradient(self, x, y):
        """The formula and its partial derivatives at points, in one evaluation.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        u, ux, uy : ndarray

        Examples
        --------
        >>> exact = FormulaSolution(Formula("x**2*y", "truth.u"))
        >>> [float(part) for part in exact.value_and_gradient(3.0, 2.0)]
        [18.0, 12.0, 9.0]
        """
        return self.u.value_and_gradient(x, y)

    def load(self, x, y):
        """Minus the Laplacian of the formula at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> exact = FormulaSolution(Formula("x**2*y", "truth.u"))
        >>> float(exact.load(3.0, 2.0))
        -4.0
        """
        return 0.0 - self.u.laplacian(x, y)
