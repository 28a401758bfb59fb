"""Arguments of a program as the library's own data, each checked before any work."""

from collections.abc import Iterable, Mapping
from numbers import Complex, Real
from typing import Any

from signorini.api.types import Datum, Names, PartwiseDatum
from signorini.exceptions import FormulaError, SceneError
from signorini.fem.by_part import ByPart
from signorini.fem.data import BySubdomain
from signorini.fem.function import Function
from signorini.formula import Formula
from signorini.mesh.boundary import offered
from signorini.wording import cut, nearest

_VALUES = {"contact": "obstacle", "neumann": "g"}  # where the values of a condition are given
_DATUM = "give a number, a formula in x and y as text, or a function of x and y"


def read_datum(value: Datum, field: str) -> Formula | Function:
    """A datum from a number, the text of a formula, or a function of x and y.

    Parameters
    ----------
    value : float, str or callable
    field : str
        Name of the argument, for messages.

    Returns
    -------
    Formula or Function

    Raises
    ------
    FormulaError
        If it is none of these.

    Examples
    --------
    >>> data = read_datum("x*y", "f"), read_datum(lambda x, y: x * y, "f")
    >>> [float(datum(2.0, 3.0)) for datum in data]
    [6.0, 6.0]
    >>> read_datum(3j, "f")
    Traceback (most recent call last):
    signorini.exceptions.FormulaError: f: 3j is not real; give a number, a formula in x ...
    """
    if isinstance(value, Formula | Function):
        return value
    if isinstance(value, str):
        return Formula(value, field)
    if isinstance(value, Real) and not isinstance(value, bool):
        return Formula(_number(value), field)
    if isinstance(value, Complex) and not isinstance(value, Real):
        raise FormulaError(f"{field}: {value} is not real; {_DATUM}")
    if not callable(value):
        raise FormulaError(f"{field}: {described(value)} is no datum; {_DATUM}")
    return Function(value, field)


def _number(value: Real) -> Any:
    """A number of NumPy, or of another package, as Python's own."""
    return value if isinstance(value, int | float) else float(value)


def read_partwise(value: PartwiseDatum, field: str) -> Formula | Function | ByPart:
    """A datum for all parts of the boundary, or one for each that is named.

    Parameters
    ----------
    value : float, str, callable or dict
    field : str

    Returns
    -------
    Formula, Function or ByPart

    Raises
    ------
    FormulaError
        As `read_datum`.

    Examples
    --------
    >>> datum = read_partwise({"left": 0, "right": "y"}, "g")
    >>> sorted(datum.parts), float(datum.parts["right"](1.0, 0.5))
    (['left', 'right'], 0.5)
    """
    if not isinstance(value, Mapping):
        return read_datum(value, field)
    parts = {str(name): read_datum(own, f"{field}.{name}") for name, own in value.items()}
    return ByPart(parts, field)


def read_coefficient(value: PartwiseDatum) -> Formula | Function | BySubdomain:
    """A diffusion coefficient: a datum, or a number for each subdomain.

    Raises
    ------
    FormulaError, SceneError
        If it is none of these, or a number is out of range.

    Examples
    --------
    >>> read_coefficient({"steel": 50, "copper": 400}).numbers
    {'steel': 50.0, 'copper': 400.0}
    """
    if not isinstance(value, Mapping):
        return read_datum(value, "coefficient")
    for name, number in value.items():
        if not isinstance(number, Real) or isinstance(number, bool):
            raise SceneError(
                f"coefficient.{name}: {described(number)} is no number; "
                "give each subdomain a number, or all a function of x and y"
            )
    numbers = {str(name): float(number) for name, number in value.items()}  # type: ignore[arg-type]
    return BySubdomain(numbers, "coefficient")


def read_names(value: Names | None, field: str, known: Iterable[str]) -> tuple[str, ...]:
    """Names of parts of the boundary.

    Parameters
    ----------
    value : str, sequence of str, or None
    field : str
        Name of the argument, for messages.
    known : iterable of str
        The parts that there are.

    Returns
    -------
    tuple of str

    Raises
    ------
    SceneError
        If it names a part that is not there.

    Examples
    --------
    >>> read_names("top", "contact", ["bottom", "top"])
    ('top',)
    >>> read_names(["lid"], "contact", ["bottom", "top"])
    Traceback (most recent call last):
    signorini.exceptions.SceneError: contact: the boundary has no part 'lid'; known: ...
    """
    known = list(known)
    if isinstance(value, Mapping):
        raise SceneError(
            f"{field}: {described(value)} has values, which it does not take; "
            f"give names here, and the values in {_VALUES[field]}"
        )
    names = (value,) if isinstance(value, str) else () if value is None else value
    if not isinstance(names, Iterable) or not all(isinstance(name, str) for name in names):
        raise SceneError(
            f"{field}: {described(value)} names no part of the boundary; "
            f"give a name or a list of names, of {', '.join(offered(known)) or 'none'}"
        )
    for name in names:
        if name not in known:
            raise SceneError(
                f"{field}: the boundary has no part {name[:60]!r}; {nearest(name, offered(known))}"
            )
    return tuple(names)


def described(value: object) -> str:
    """What a wrong argument is, for a message: shape and type of an array, columns of a table.

    Of anything else it is the value and its type.

    Examples
    --------
    >>> import numpy as np
    >>> described(np.zeros((2, 3))), described(2.5)
    ('an array of shape (2, 3) and type float64', '2.5 (float)')
    """
    if hasattr(value, "shape") and hasattr(value, "dtype"):
        return f"an array of shape {value.shape} and type {value.dtype}"
    if hasattr(value, "columns"):
        return f"a table with the columns {cut(', '.join(map(str, value.columns)), 40)}"
    text = " ".join(repr(value).split())
    return f"{cut(text, 40)} ({type(value).__name__})"
