"""Exact solutions under a diffusion coefficient."""

from dataclasses import dataclass

from signorini.exact.solution import ExactSolution
from signorini.exceptions import SceneError
from signorini.fem.function import Function
from signorini.formula import Formula


@dataclass(frozen=True)
class Diffused(ExactSolution):
    """An exact solution under a diffusion coefficient k: load -div(k grad u), flux k du/dnu.

    The coefficient may jump across lines, and vary between them.

    Parameters
    ----------
    u : ExactSolution
        Its k du/dnu must not jump where k does; see `balance.check_balance`.
    coefficient : Formula

    See Also
    --------
    with_coefficient : Makes one only where the coefficient is not 1.

    Examples
    --------
    >>> from signorini.exact.families import family
    >>> exact = Diffused(family("patch"), Formula("1 + x"))
    >>> float(exact.flux(1.0, 0.0, 0.0, -1.0)), float(exact.load(1.0, 0.5))
    (2.0, 0.0)
    """

    u: ExactSolution
    coefficient: Formula

    @property
    def obstacle(self):
        """That of u."""
        return self.u.obstacle

    @property
    def multiplier(self):
        """That of u."""
        return self.u.multiplier

    @property
    def critical_points(self):
        """Those of u."""
        return self.u.critical_points

    @property
    def singular_points(self):
        """Those of u."""
        return self.u.singular_points

    @property
    def knows_load(self):
        """Whether that of u is known, and the coefficient can be differentiated.

        Examples
        --------
        >>> from signorini.exact.solution import FormulaSolution
        >>> u = FormulaSolution(Formula("x"))
        >>> Diffused(u, Formula("2")).knows_load, Diffused(u, Function(lambda x, y: x)).knows_load
        (True, False)
        """
        return self.u.knows_load and not isinstance(self.coefficient, Function)

    @property
    def constant_load(self):
        """Zero where u has no load, else None: not known.

        Examples
        --------
        >>> from signorini.exact.families import family
        >>> Diffused(family("corner"), Formula("where(y < 0.5, 1, 9)")).constant_load
        0.0
        """
        return 0.0 if self.u.constant_load == 0.0 else None

    def value(self, x, y):
        return self.u.value(x, y)

    def gradient(self, x, y):
        return self.u.gradient(x, y)

    def value_and_gradient(self, x, y):
        return self.u.value_and_gradient(x, y)

    def load(self, x, y):
        """-div(k grad u) = -k Laplace u - grad k . grad u at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ndarray

        Raises
        ------
        SceneError, FormulaError
            Where the load is not known, or not finite.

        Examples
        --------
        -div(x grad x) = -1:

        >>> from signorini.exact.solution import FormulaSolution
        >>> float(Diffused(FormulaSolution(Formula("x")), Formula("x")).load(0.3, 0.7))
        -1.0
        """
        if not self.knows_load:
            raise SceneError(
                "f: missing; the load of functions of a program is not derived, give it"
            )
        k, kx, ky = self.coefficient.value_and_gradient(x, y)
        load = k * self.u.load(x, y)
        # Where k is constant on pieces, which is common, the gradient of u is not needed.
        if not (kx.any() or ky.any()):
            return load
        ux, uy = self.u.gradient(x, y)
        return load - kx * ux - ky * uy

    def flux(self, x, y, nx, ny):
        """k times the flux of u at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.
        nx, ny : array_like of float
            Unit normal, dimensionless.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> from signorini.exact.solution import FormulaSolution
        >>> exact = Diffused(FormulaSolution(Formula("x - y")), Formula("2 + x"))
        >>> float(exact.flux(1.0, 0.0, 0.0, -1.0))
        3.0
        """
        return self.coefficient(x, y) * self.u.flux(x, y, nx, ny)


def with_coefficient(exact, coefficient):
    """An exact solution of -Laplace u = f as one of the problem with a diffusion coefficient.

    Parameters
    ----------
    exact : ExactSolution
    coefficient : Formula, Function or None
        Diffusion coefficient k; None for 1. The load under a `Function` is not known.

    Returns
    -------
    ExactSolution
        With the same u, and the load and flux under k: `exact` itself where k is the constant 1,
        however that is written.

    Raises
    ------
    SceneError
        If the coefficient is no formula but a number for each subdomain of a mesh file.
    FormulaError
        If it is a constant that is not finite.

    Examples
    --------
    >>> from signorini.exact.solution import FormulaSolution
    >>> exact = FormulaSolution(Formula("x**2"))
    >>> with_coefficient(exact, Formula("1.0")) is exact
    True
    >>> float(with_coefficient(exact, Formula("3")).load(0.0, 0.0))
    -6.0
    """
    if coefficient is None:
        return exact
    if not callable(coefficient):
        raise SceneError(
            "data.coefficient: an exact truth needs a formula in x and y, not a section"
        )
    return exact if coefficient.constant == 1.0 else Diffused(exact, coefficient)
