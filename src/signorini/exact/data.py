"""The data of a problem, derived from its exact solution."""

from collections.abc import Callable
from dataclasses import dataclass

from signorini.exact.solution import FormulaSolution
from signorini.exceptions import FormulaError
from signorini.fem.data import Data
from signorini.formula import Formula


@dataclass(frozen=True)
class Derived:
    """A datum derived from an exact solution, called like a `Formula`.

    Parameters
    ----------
    field : str
        Its name, for error messages.
    function : callable
        From coordinates, and the outward unit normal where it needs one, to values.
    constant : float or None
        Its value where it is known to be the same everywhere.
    needs_normal : bool
        Whether it is called with the outward unit normal, as ``g(x, y, nx, ny)``: a flux, which
        depends on the side.
    checked : bool
        Whether the function itself raises where a value is not finite, so that no second look is
        needed.
    """

    field: str
    function: Callable
    constant: float | None = None
    needs_normal: bool = False
    checked: bool = False

    def __call__(self, x, y, *normal, check=True):
        """Evaluate at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.
        *normal : array_like of float
            Its components nx and ny, where the datum needs them; dimensionless.
        check : bool
            Whether a value that is not finite is an error.

        Returns
        -------
        ndarray

        Raises
        ------
        FormulaError
            Naming the first value that is not finite, and its point.
        """
        import numpy as np

        from signorini.formula.taylor import first_non_finite

        with np.errstate(all="ignore"):
            values = self.function(x, y, *normal)
        bad = first_non_finite(values, x, y) if check and not self.checked else None
        if bad:
            value, x_bad, y_bad = bad
            raise FormulaError(
                f"{self.field}: value derived from the exact solution is {value!r} at (x, y) = "
                f"({x_bad!r}, {y_bad!r}); change truth, or give the value"
            )
        return values


def derived_data(exact):
    """Data under which `exact` is the solution: its load, its flux, its values, its obstacle.

    Parameters
    ----------
    exact : ExactSolution

    Returns
    -------
    Data
        Of callables with the interface of `Formula`; g also takes the normal (see `Derived`). The
        obstacle is the solution's own, or zero where it has none. The threshold of the flux is
        k du/dnu less the solution's multiplier, or zero where it has none.

    Examples
    --------
    >>> from signorini.exact.families import family
    >>> data = derived_data(family("uniform-load", {"c": 2}))
    >>> float(data.f(0.3, 0.4))
    2.0
    """
    checked = isinstance(exact, FormulaSolution)
    given = {} if exact.coefficient is None else {"coefficient": exact.coefficient}
    return Data(
        f=Derived("data.f", exact.load, exact.constant_load, checked=checked),
        g=Derived("data.g", exact.flux, needs_normal=True),
        dirichlet=Derived("data.dirichlet", exact.value, checked=checked),
        obstacle=exact.obstacle or Formula("0", "data.obstacle"),
        contact_flux=_contact_flux(exact),
        **given,
    )


def _contact_flux(exact):
    """The threshold of the flux under which the solution's multiplier is what binds."""
    if exact.multiplier is None:
        return Formula("0", "data.contact_flux")

    def threshold(x, y, nx, ny):
        return exact.flux(x, y, nx, ny) - exact.multiplier(x, y)

    return Derived("data.contact_flux", threshold, needs_normal=True)
