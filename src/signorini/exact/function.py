"""Exact solutions that are functions of a program."""

from dataclasses import dataclass
from functools import wraps

from signorini.exact.solution import ExactSolution
from signorini.exceptions import SceneError
from signorini.fem.function import Function
from signorini.formula import Formula


@dataclass(frozen=True)
class FunctionSolution(ExactSolution):
    """An exact solution from callables of x and y: u and its gradient.

    Parameters
    ----------
    u : Function
    slopes : Function or pair of Function
        du/dx and du/dy: two functions, or one that returns both.
    critical_points, singular_points : tuple of (float, float)
    multiplier : Formula or Function, optional
        As of a `FormulaSolution`.

    Notes
    -----
    Its load is not known, since nothing is differentiated: f must be given beside it.

    Examples
    --------
    >>> u = Function(lambda x, y: x * y, "exact")
    >>> exact = FunctionSolution(u, Gradient(lambda x, y: (y, x), "exact.gradient"))
    >>> float(exact.flux(3.0, 2.0, 0.0, -1.0))
    -3.0
    """

    u: Function
    slopes: "Gradient"
    critical_points: tuple[tuple[float, float], ...] = ()
    singular_points: tuple[tuple[float, float], ...] = ()
    multiplier: Formula | Function | None = None

    knows_load = False

    def value(self, x, y):
        return self.u(x, y)

    def gradient(self, x, y):
        return self.slopes(x, y)

    def load(self, x, y):
        """Not known.

        Raises
        ------
        SceneError
            In any case.

        Examples
        --------
        >>> u = Function(lambda x, y: x * y, "exact")
        >>> FunctionSolution(u, Gradient(lambda x, y: (y, x))).load(1.0, 2.0)
        Traceback (most recent call last):
        signorini.exceptions.SceneError: f: missing; the load of functions of a program is ...
        """
        raise SceneError("f: missing; the load of functions of a program is not derived, give it")


@dataclass(frozen=True)
class Gradient:
    """The gradient of a function of a program.

    Parameters
    ----------
    functions : callable or pair of callables
        From two arrays x and y to a pair of arrays, or one for each.
    field : str
        Name of the quantity, for error messages.
    """

    functions: object
    field: str = "gradient"

    def __call__(self, x, y):
        """Evaluate at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length.

        Returns
        -------
        ux, uy : ndarray

        Raises
        ------
        FormulaError
            As of a `Function`, of which it names the component; or if there are not two.
        """
        if callable(self.functions):
            return self._both(x, y)
        along_x, along_y = self.functions
        ux = Function(along_x, f"{self.field}[0]")(x, y)
        return ux, Function(along_y, f"{self.field}[1]")(x, y)

    def _both(self, x, y):
        """Both components of one function, which is called once."""
        pair = []

        @wraps(self.functions)  # messages are of the program's own
        def first(x, y):
            values = self.functions(x, y)
            if values is None:
                return None
            pair[:] = values
            ux, _ = pair
            return ux

        def second(x, y):
            return pair[1]

        ux = Function(first, f"{self.field}[0]")(x, y)
        return ux, Function(second, f"{self.field}[1]")(x, y)
