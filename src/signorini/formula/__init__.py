"""Formulas in x and y given by the user: parsed without eval, evaluated, differentiated exactly."""

import dataclasses

from signorini.exceptions import FormulaError
from signorini.formula.grammar import read
from signorini.formula.lexicon import as_text, shorten

__all__ = ["Formula", "Partial"]


@dataclasses.dataclass(frozen=True)
class Formula:
    """A real function of the point (x, y), read from text; equal and hashed by its text.

    Parameters
    ----------
    text : str, int or float
        The formula: at most 1000 characters and 50 nested levels, on one line.
    field : str
        Name of the quantity, for error messages.

    Raises
    ------
    FormulaError
        If the text is not a formula: one line that names the field, the column and the remedy.

    Notes
    -----
    Variables
        `x`, `y`, `r` = sqrt(x**2 + y**2), `theta` = atan2(y, x) in (-pi, pi]. A coordinate -0.0
        counts as 0.0: the same point has the same value.
    Constants
        Decimal numbers, each a double, `pi` and `e`.
    Operators
        `+ - * / **` with Python's precedence: -x**2 is -(x**2) and 2**3**2 is 2**9.
    Functions
        `sqrt exp log sin cos tan asin acos atan sinh cosh tanh abs sign floor ceil`, `atan2(y, x)`,
        `hypot(x, y)`, `min` and `max` of two or more, `pos(t)` = max(t, 0), `step(t)` = 1 if t >=
        0, else 0.
    Conditions
        `< <= > >= == !=`, chains such as 0 < x < 1, `and`, `or`, `not`. They are not numbers, and
        are allowed only as the first argument of `where(condition, a, b)`. A NaN in the branch not
        taken is harmless. A condition that depends on a NaN makes the result NaN.
    Signed zeros
        As in IEEE 754 inside the formula: -2*x*y is -0.0 at (1, 0), and atan2(-2*x*y, -1) is -pi
        there, the limit from y > 0. Given zeros of both signs, `min` and `max` may return either.
        A final result of zero has no sign.
    Derivatives
        At a kink: of the branch taken in `where`; from the right (t >= 0) in `abs` and `pos`; of
        the first of equal arguments in `min` and `max`; zero for `sign`, `step`, `floor`, `ceil`.
        Those of `r` and `theta` are not finite at r = 0. Nor is the second one of pos(x)**1.5 for
        x < 0: write where(x > 0, x**1.5, 0).

    Arithmetic is done as written, in double precision. Constant exponents 0, 1/2, 1, ..., 8, their
    negatives, `r` and `hypot` use products, quotients and square roots only, so they give the same
    bits on every platform.

    Examples
    --------
    >>> u = Formula("r**(3/2) * cos(3*theta/2)", field="exact")
    >>> float(u(4.0, 0.0))
    8.0
    """

    text: str
    field: str = dataclasses.field(default="f", compare=False)
    program: tuple = dataclasses.field(init=False, repr=False, compare=False)

    def __post_init__(self):
        text = as_text(self.text, self.field)
        object.__setattr__(self, "text", text)
        object.__setattr__(self, "program", read(text, self.field))

    @property
    def variables(self):
        """The coordinates that the value depends on: a frozenset of "x" and "y".

        `r` and `theta` depend on both.

        Examples
        --------
        >>> sorted(Formula("x*sin(2*pi*x)").variables)
        ['x']
        """
        return frozenset(step.name for step in self.program) & {"x", "y"}

    @property
    def constant(self):
        """The value as a float if the text mentions no variable, else None.

        FormulaError if it is not finite.

        Examples
        --------
        >>> Formula("2*pi").constant, Formula("x + 1").constant
        (6.283185307179586, None)
        """
        if self.variables:
            return None
        if len(self.program) == 1:  # a number as it stands, for which numpy need not be imported
            return self.program[0].value
        return float(self(0.0, 0.0))

    def __call__(self, x, y, *, check=True):
        """Evaluate at points.

        Parameters
        ----------
        x, y : array_like of float
            Coordinates (dimensionless), broadcast against each other.
        check : bool
            Whether a value that is not finite is an error.

        Returns
        -------
        ndarray of float64
            A new array of shape `np.broadcast(x, y).shape`, also if the formula is constant.

        Raises
        ------
        FormulaError
            At the first point where the value is NaN (as for sqrt(-1): nothing is complex) or
            infinite.
        """
        return self.expand(("value",), x, y, check)[0]

    def gradient(self):
        """Exact partial derivatives along x and y, a pair of `Partial`.

        Examples
        --------
        >>> dx, dy = Formula("x**2*y").gradient()
        >>> float(dx(3.0, 2.0)), float(dy(3.0, 2.0))
        (12.0, 9.0)
        """
        return Partial(self, "x"), Partial(self, "y")

    def value_and_gradient(self, x, y, *, check=True):
        """Evaluate the value and both partial derivatives, which share their work.

        Parameters
        ----------
        x, y : array_like of float
            Coordinates (dimensionless), broadcast against each other.
        check : bool
            Whether a value or derivative that is not finite is an error.

        Returns
        -------
        u, ux, uy : ndarray of float64
            As from a call.

        Examples
        --------
        >>> [float(part) for part in Formula("x**2*y").value_and_gradient(3.0, 2.0)]
        [18.0, 12.0, 9.0]
        """
        return tuple(self.expand(("value", "d/dx", "d/dy"), x, y, check))

    def laplacian(self, x, y, *, check=True):
        """Evaluate d2u/dx2 + d2u/dy2 at points.

        Parameters
        ----------
        x, y : array_like of float
            Coordinates (dimensionless), broadcast against each other.
        check : bool
            Whether a value or derivative that is not finite is an error.

        Returns
        -------
        ndarray of float64
            As from a call.

        Examples
        --------
        >>> float(Formula("x**2*y").laplacian(3.0, 2.0))
        4.0
        """
        return self.expand(("laplacian",), x, y, check)[0]

    def expand(self, quantities, x, y, check=True):
        """Evaluate several quantities at once, which share their work.

        Parameters
        ----------
        quantities : tuple of str
            Of "value", "d/dx", "d2/dx2", "d/dy", "d2/dy2" and "laplacian".
        x, y : array_like of float
            Coordinates (dimensionless), broadcast against each other.
        check : bool
            Whether a quantity, or the value, that is not finite is an error.

        Returns
        -------
        list of ndarray of float64
            One for each quantity, as from a call.

        Examples
        --------
        >>> [float(part) for part in Formula("sin(x)*y").expand(("d/dx", "laplacian"), 0.0, 2.0)]
        [2.0, 0.0]
        """
        # Importing numpy takes 0.1 s, and reading a formula needs none of it.
        from signorini.formula.taylor import expand

        results, finite = expand(self.program, quantities, x, y)
        if check and not finite:
            self._raise_if_not_finite(quantities, x, y)
        return results

    def _raise_if_not_finite(self, quantities, x, y):
        """Raise for the first quantity that is not finite, or that is on the way to one."""
        if not any(self._first_non_finite(name, x, y) for name in ("value", *quantities)):
            return  # a bound overflowed, no value did
        on_the_way = (step for name in quantities for step in _ON_THE_WAY.get(name, (name,)))
        for name in dict.fromkeys(on_the_way):
            bad = self._first_non_finite(name, x, y)
            if bad:
                value, x_bad, y_bad = bad
                raise FormulaError(
                    f"{self.field}: {name} is {value!r} at (x, y) = ({x_bad!r}, {y_bad!r})"
                    f" in {shorten(self.text)}; leave the point out with where(condition, a, b)"
                )

    def _first_non_finite(self, quantity, x, y):
        """The first value of a quantity that is not finite, with its point; None where all are."""
        from signorini.formula.taylor import expand, first_non_finite

        (values,), _ = expand(self.program, (quantity,), x, y)
        return first_non_finite(values, x, y)


# Where a quantity is not finite, these are examined in this order, and the first that is not finite
# either is named.
_ON_THE_WAY = {
    "d/dx": ("value", "d/dx"),
    "d/dy": ("value", "d/dy"),
    "laplacian": ("value", "d/dx", "d2/dx2", "d/dy", "d2/dy2", "laplacian"),
}


@dataclasses.dataclass(frozen=True)
class Partial:
    """Partial derivative of a formula along one axis, called like the formula itself.

    Parameters
    ----------
    formula : Formula
    axis : {"x", "y"}
    """

    formula: Formula
    axis: str

    def __call__(self, x, y, *, check=True):
        """Evaluate at points; shapes, `check` and errors as in a call of the formula.

        The formula's value is checked too.
        """
        return self.formula.expand((f"d/d{self.axis}",), x, y, check)[0]
