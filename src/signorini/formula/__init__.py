"""Formulas in x and y typed by a user: read without trust, evaluated on arrays, differentiated
exactly.
"""

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
        `< <= > >= == !=`, chains such as 0 < x < 1, `and`, `or`, `not`. They stand in the first
        argument of `where(condition, a, b)`, nowhere else, and are no numbers. A NaN in the branch
        not taken is harmless; where a condition hangs on a NaN, the result is NaN.
    Signed zeros
        As in IEEE 754, up to the result: -2*x*y is -0.0 at (1, 0), and atan2(-2*x*y, -1) there -pi,
        the limit from y > 0. Only of zeros of both signs `min` and `max` take either. A result of
        zero has no sign.
    Derivatives
        At a kink: of the branch taken in `where`; from the right (t >= 0) in `abs` and `pos`; of
        the first of equal arguments in `min` and `max`; zero for `sign`, `step`, `floor`, `ceil`.
        Not finite at r = 0 for `r` and `theta`, nor the second one of pos(x)**1.5 for x < 0: write
        where(x > 0, x**1.5, 0).

    Arithmetic is done as written, in double precision. Constant exponents 0, 1/2, 1, ..., 8, their
    negatives, `r` and `hypot` use products, quotients and square roots only: the same bits on every
    platform.

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
        """Names among "x" and "y" that the text mentions, a frozenset; `r` and `theta` mention
        both.
        """
        return frozenset(step.name for step in self.program) & {"x", "y"}

    @property
    def constant(self):
        """The value as a float if the text mentions no variable, else None; FormulaError if not
        finite.
        """
        return None if self.variables else float(self(0.0, 0.0))

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
        """Exact partial derivatives along x and y, a pair called like the formula itself."""
        return Partial(self, "x"), Partial(self, "y")

    def value_and_gradient(self, x, y, *, check=True):
        """Evaluate (u, du/dx, du/dy) at points; shapes, `check` and errors as in a call.

        Examples
        --------
        >>> [float(part) for part in Formula("x**2*y").value_and_gradient(3.0, 2.0)]
        [18.0, 12.0, 9.0]
        """
        return tuple(self.expand(("value", "d/dx", "d/dy"), x, y, check))

    def laplacian(self, x, y, *, check=True):
        """Evaluate d2u/dx2 + d2u/dy2 at points; shapes, `check` and errors as in a call."""
        return self.expand(("laplacian",), x, y, check)[0]

    def expand(self, wanted, x, y, check=True):
        """Evaluate several of `taylor.QUANTITIES` at once: a list of arrays; `check` and errors as
        in a call.
        """
        # Importing numpy takes 0.1 s, and reading a formula needs none of it.
        from signorini.formula.taylor import expand

        found, finite = expand(self.program, wanted, x, y)
        if check and not finite:
            self._name_non_finite(wanted, x, y)
        return found

    def _name_non_finite(self, wanted, x, y):
        """FormulaError for the first value that is not finite, of the formula or what is derived
        from it on the way.
        """
        from signorini.formula.taylor import expand, first_non_finite

        def first_bad(name):
            return first_non_finite(expand(self.program, (name,), x, y)[0][0], x, y)

        if not any(map(first_bad, ("value", *wanted))):
            return
        for name in dict.fromkeys(
            step for quantity in wanted for step in _ON_THE_WAY.get(quantity, (quantity,))
        ):
            bad = first_bad(name)
            if bad:
                raise FormulaError(
                    f"{self.field}: {name} is {bad[0]!r} at (x, y) = ({bad[1]!r}, {bad[2]!r})"
                    f" in {shorten(self.text)}; leave the point out with where(condition, a, b)"
                )


# What is looked at, in this order, where a quantity is not finite: the first that is not is the one
# to name.
_ON_THE_WAY = {
    "d/dx": ("value", "d/dx"),
    "d/dy": ("value", "d/dy"),
    "laplacian": ("value", "d/dx", "d2/dx2", "d/dy", "d2/dy2", "laplacian"),
}


@dataclasses.dataclass(frozen=True)
class Partial:
    """Partial derivative of a formula along one axis, called like the formula itself."""

    formula: Formula
    axis: str

    def __call__(self, x, y, *, check=True):
        """Evaluate at points; shapes, `check` and errors as for a formula, whose value is checked
        too.
        """
        return self.formula.expand((f"d/d{self.axis}",), x, y, check)[0]
