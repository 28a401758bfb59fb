"""A datum that is a function of a program, called like a `Formula`."""

from collections.abc import Callable
from dataclasses import dataclass

from signorini.exceptions import FormulaError
from signorini.wording import cut, takes_two


@dataclass(frozen=True)
class Function:
    """A real function of the point (x, y) that is given as a callable.

    Parameters
    ----------
    function : callable
        From two arrays of one shape, x and y, to an array of that shape, or to a number.
    field : str
        Name of the quantity, for error messages.

    Notes
    -----
    Nothing is known of it but its values: it is integrated by quadrature, never exactly, and is not
    differentiated.

    Examples
    --------
    >>> f = Function(lambda x, y: x * y, "f")
    >>> float(f(2.0, 3.0))
    6.0
    """

    function: Callable
    field: str = "f"

    constant = None  # not known, as of a formula with variables

    @property
    def text(self):
        """What messages call it.

        Examples
        --------
        >>> Function(abs).text
        'abs(x, y)'
        """
        return f"{getattr(self.function, '__name__', type(self.function).__name__)}(x, y)"

    def __call__(self, x, y, *, check=True):
        """Evaluate at points.

        Parameters
        ----------
        x, y : array_like of float
            Unit of length, broadcast against each other.
        check : bool
            Whether a value that is not finite is an error.

        Returns
        -------
        ndarray of float64
            A new array of shape `np.broadcast(x, y).shape`.

        Raises
        ------
        FormulaError
            If the function fails, its values are complex or of another shape, or one is not finite.
        """
        import numpy as np

        shape = np.broadcast_shapes(np.shape(x), np.shape(y))
        # Copies, so that a function that writes into its arguments changes nothing but these.
        values = self._values(*(np.array(np.broadcast_to(part, shape), float) for part in (x, y)))
        if values.dtype.kind not in "biuf":
            raise FormulaError(
                f"{self.field}: {self.text} is of type {values.dtype}; its values must be real"
            )
        if values.shape not in ((), shape):
            raise FormulaError(
                f"{self.field}: {self.text} has shape {values.shape} for x and y of shape {shape}; "
                "return an array of their shape, or a number"
            )
        values = np.array(np.broadcast_to(values, shape), float)
        if check:
            self._check_finite(values, x, y)
        return values

    def _values(self, x, y):
        import numpy as np

        try:
            with np.errstate(all="ignore"):
                values = self.function(x, y)
                array = np.asarray(values)
        except Exception as error:  # a function of a user raises anything
            remedy = "write it with NumPy, np.where for if, or wrap it in np.vectorize"
            if not takes_two(self.function):
                remedy = "write a function of two arrays, lambda x, y: ..."
            raise FormulaError(
                f"{self.field}: {self.text} fails for arrays x and y "
                f"({type(error).__name__}: {cut(str(error))}); {remedy}"
            ) from error
        if values is None:
            raise FormulaError(f"{self.field}: {self.text} returns None; is a return missing?")
        return array

    def _check_finite(self, values, x, y):
        from signorini.formula.taylor import first_non_finite

        bad = first_non_finite(values, x, y)
        if bad:
            value, x_bad, y_bad = bad
            raise FormulaError(
                f"{self.field}: {self.text} is {value!r} at (x, y) = ({x_bad!r}, {y_bad!r}); "
                "every value must be finite"
            )
