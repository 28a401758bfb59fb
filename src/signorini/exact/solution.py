"""What an exact solution is: u, its gradient and its load at any point; the flux follows."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from signorini.formula import Formula


class ExactSolution(ABC):
    """A function u that solves a Signorini problem, equation (2.2) of the paper, with the load
    -Laplace u.

    Subclasses give `value`, `gradient` and `load`. All take coordinates in the user's unit of
    length, broadcast against each other, and return new arrays of the broadcast shape.

    Attributes
    ----------
    obstacle : Formula or None
        Lower bound of u on the contact side, unit of u; None where the data say what it is.
    critical_points : tuple of (float, float)
        Where on the contact side the constraint starts to bind, so far as they are known.
    singular_points : tuple of (float, float)
        Where a derivative of u is unbounded; quadrature is refined towards them.
    constant_load : float or None
        The load's value where it is known to be the same everywhere.
    coefficient : Formula or None
        Diffusion coefficient k; None where it is 1.
    """

    obstacle = None
    coefficient = None
    critical_points = ()
    singular_points = ()
    constant_load = None

    @abstractmethod
    def value(self, x, y):
        """u at points."""

    @abstractmethod
    def gradient(self, x, y):
        """Partial derivatives (du/dx, du/dy) at points, a pair, unit of u per length."""

    def value_and_gradient(self, x, y):
        """(u, du/dx, du/dy) at points; subclasses share work between them."""
        return self.value(x, y), *self.gradient(x, y)

    @abstractmethod
    def load(self, x, y):
        """-Laplace u at points, unit of u per length squared."""

    def flux(self, x, y, nx, ny):
        """du/dnu at points where the outward unit normal is (nx, ny), unit of u per length."""
        ux, uy = self.gradient(x, y)
        return ux * nx + uy * ny + 0.0


@dataclass(frozen=True)
class FormulaSolution(ExactSolution):
    """An exact solution from a formula; gradient and Laplacian are derived from it exactly, by
    forward mode.

    Parameters
    ----------
    u : Formula
    obstacle : Formula, optional
    critical_points, singular_points : tuple of (float, float)

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

    @property
    def constant_load(self):
        """Zero where u mentions no variable, else None: not known."""
        return None if self.u.variables else 0.0

    def value(self, x, y):
        return self.u(x, y)

    def gradient(self, x, y):
        return tuple(self.u.expand(("d/dx", "d/dy"), x, y))

    def value_and_gradient(self, x, y):
        return self.u.value_and_gradient(x, y)

    def load(self, x, y):
        return 0.0 - self.u.laplacian(x, y)


@dataclass(frozen=True)
class Diffused(ExactSolution):
    """An exact solution under a diffusion coefficient k: load -div(k grad u), flux k du/dnu.

    The coefficient may jump across lines, and vary between them.

    Parameters
    ----------
    u : ExactSolution
        Its k du/dnu must not jump where k does; see `balance.check_balance`.
    coefficient : Formula
    """

    u: ExactSolution
    coefficient: Formula

    @property
    def obstacle(self):
        """That of u."""
        return self.u.obstacle

    @property
    def critical_points(self):
        """Those of u."""
        return self.u.critical_points

    @property
    def singular_points(self):
        """Those of u."""
        return self.u.singular_points

    @property
    def constant_load(self):
        """Zero where u has no load, else None: not known."""
        return 0.0 if self.u.constant_load == 0.0 else None

    def value(self, x, y):
        return self.u.value(x, y)

    def gradient(self, x, y):
        return self.u.gradient(x, y)

    def value_and_gradient(self, x, y):
        return self.u.value_and_gradient(x, y)

    def load(self, x, y):
        k, kx, ky = self.coefficient.value_and_gradient(x, y)
        load = k * self.u.load(x, y)
        if not (kx.any() or ky.any()):
            return load
        ux, uy = self.u.gradient(x, y)
        return load - kx * ux - ky * uy

    def flux(self, x, y, nx, ny):
        return self.coefficient(x, y) * self.u.flux(x, y, nx, ny)
