"""Exact solutions that a program knows: functions with their gradients, formulas, families."""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from signorini.api.arguments import described, read_datum
from signorini.api.types import Datum, Floats
from signorini.exact import (
    FAMILIES,
    ExactSolution,
    FormulaSolution,
    FunctionSolution,
    Gradient,
    read_exact,
)
from signorini.exceptions import FormulaError, SceneError
from signorini.fem.function import Function
from signorini.formula import Formula
from signorini.formula.lexicon import KNOWN
from signorini.wording import nearest

_REMEDY = (
    "give a formula as text, the name of a family, or exact_solution(u, gradient) "
    "of functions of x and y"
)
_STEP = 1e-5  # of a difference, relative to the extent of the mesh
_OFF = 1e-3  # by which a derivative may differ from it, relative to the largest
_POINTS = 100  # at most, at which they are compared
_WORD = re.compile(r"[a-z][a-z-]+")
Points = Sequence[Sequence[float]]


def exact_solution(
    u: str | Callable[..., Any],
    gradient: Any = None,
    critical_points: Points = (),
    singular_points: Points = (),
    multiplier: Datum | None = None,
    **parameters: float | str,
) -> ExactSolution:
    """An exact solution of a Signorini problem.

    Parameters
    ----------
    u : str or callable
        A formula in x and y, which is differentiated exactly; or the name of a family, see
        config/README.md; or a function of the arrays x and y.
    gradient : callable or pair of callables, optional
        Of a function: du/dx and du/dy, by one function of x and y or by two.
    critical_points : sequence of (float, float), optional
        Where the constraint starts to bind on the contact part; the norm of that name needs them.
    singular_points : sequence of (float, float), optional
        Where derivatives are unbounded: quadrature is refined there. By default the critical
        points.
    multiplier : number, formula or function, optional
        k du/dnu less its threshold on the contact part, where that is not zero; not of a family.
    **parameters
        Of a family.

    Returns
    -------
    ExactSolution

    Raises
    ------
    SceneError, FormulaError
        Naming the argument, its value and the remedy.

    Examples
    --------
    >>> punch = exact_solution("punch", half_width=0.5)
    >>> float(punch.flux(0.0, 0.0, 0.0, -1.0))
    0.5
    >>> plane = exact_solution(lambda x, y: x, gradient=lambda x, y: (1.0, 0.0))
    >>> float(plane.value(2.0, 3.0))
    2.0
    """
    critical = _points(critical_points, "critical_points")
    singular = _points(singular_points, "singular_points") or critical
    pressure = None if multiplier is None else read_datum(multiplier, "exact.multiplier")
    if callable(u):
        _refuse(parameters, "parameters", "a function")
        return FunctionSolution(_function(u), _gradient(gradient), critical, singular, pressure)
    if gradient is not None:
        raise SceneError("gradient: not needed, that of a formula or family is derived; drop it")
    if not isinstance(u, str):
        raise SceneError(f"exact: {described(u)} is no exact solution; {_REMEDY}")
    if u in FAMILIES:
        return read_exact({"family": u, "parameters": parameters}, field="exact")
    _refuse(parameters, "parameters", "a formula")
    if _WORD.fullmatch(u) and u not in KNOWN:
        raise SceneError(f"exact: {u!r} is neither a formula nor a family; {nearest(u, FAMILIES)}")
    return FormulaSolution(Formula(u, "exact"), None, critical, singular, pressure)


def read_exact_solution(value: Any) -> ExactSolution:
    """Whatever stands for an exact solution, as one.

    Parameters
    ----------
    value : ExactSolution, str, dict, or pair (u, gradient)
        A dict is the section ``truth`` of a scene.

    Returns
    -------
    ExactSolution

    Raises
    ------
    SceneError, FormulaError
        As `exact_solution`.

    Examples
    --------
    >>> float(read_exact_solution("x**2 - y**2").value(3.0, 2.0))
    5.0
    """
    if isinstance(value, ExactSolution):
        return value
    if isinstance(value, Mapping):
        return read_exact(dict(value), field="exact")
    if isinstance(value, tuple | list) and len(value) == 2:
        return exact_solution(*value)
    return exact_solution(value)


def check_functions(exact: ExactSolution, mesh: Any, f: Any = None) -> None:
    """Hold the gradient that a program gives against differences of u, and f against those of it.

    Parameters
    ----------
    exact : ExactSolution
        Only functions of a program are looked at; all else is derived.
    mesh : Grid or Triangulation
    f : callable, optional
        The load that goes with it.

    Raises
    ------
    SceneError
        If one is off at more than half of some points: kinks and singular points are few.
    """
    if exact.knows_load:
        return
    stride = -(-mesh.number_of_triangles // _POINTS)
    x, y = mesh.p[:, mesh.t[:, ::stride]].mean(axis=1)
    step = _STEP * float(max(np.ptp(axis) for axis in mesh.p))
    slopes = [_difference(exact.value, x, y, step, axis) for axis in range(2)]
    size = float(np.abs(slopes).max())
    for axis, (given, found) in enumerate(zip(exact.gradient(x, y), slopes, strict=True)):
        _compare(f"exact.gradient[{axis}]", given, found, size, (x, y), "u")
    if f is not None:
        fluxes = partial(exact.flux, nx=1.0, ny=0.0), partial(exact.flux, nx=0.0, ny=1.0)
        outflow = [_difference(flux, x, y, step, axis) for axis, flux in enumerate(fluxes)]
        _compare(
            "f",
            f(x, y),
            -(outflow[0] + outflow[1]),
            size + np.abs(outflow).max(),
            (x, y),
            "the flux",
        )


def _difference(
    function: Callable[..., Floats], x: Floats, y: Floats, step: float, axis: int
) -> Floats:
    """The central difference of a function along an axis."""
    dx, dy = (step, 0.0) if axis == 0 else (0.0, step)
    return (function(x + dx, y + dy) - function(x - dx, y - dy)) / (2.0 * step)


def _compare(
    field: str, given: Floats, found: Floats, size: float, points: tuple[Floats, Floats], what: str
) -> None:
    off = np.abs(given - found) > _OFF * size
    if 2 * off.sum() > off.size:
        k = int(np.argmax(off))
        x, y = points
        raise SceneError(
            f"{field}: {given[k]:.4g} at ({x[k]:.4g}, {y[k]:.4g}), where differences of {what} "
            f"give {found[k]:.4g}; correct one of the two"
        )


def _function(u: Callable[..., Any]) -> Function:
    return u if isinstance(u, Function) else Function(u, "exact")


def _gradient(gradient: Any) -> Gradient:
    pair = isinstance(gradient, tuple | list) and len(gradient) == 2
    if callable(gradient) or (pair and all(map(callable, gradient))):
        return Gradient(gradient, "exact.gradient")
    given = "missing" if gradient is None else f"{described(gradient)} is none"
    raise SceneError(
        f"exact.gradient: {given}; beside a function u give one function of x and y that returns "
        "du/dx and du/dy, or a pair of functions"
    )


def _refuse(parameters: Mapping[str, Any], field: str, what: str) -> None:
    if parameters:
        raise SceneError(
            f"{field}: {what} has none, but {', '.join(parameters)} is given; "
            f"only families have: {', '.join(FAMILIES)}"
        )


def _points(points: Points, field: str) -> tuple[tuple[float, float], ...]:
    """Points as pairs of numbers."""
    try:
        pairs = np.asarray(points, dtype=float)
    except (TypeError, ValueError):
        pairs = np.zeros(())
    if pairs.size == 0 and pairs.ndim:
        return ()
    if pairs.ndim != 2 or pairs.shape[1] != 2 or not np.isfinite(pairs).all():
        raise FormulaError(f"{field}: {described(points)} is no list of points; give [(x, y), ...]")
    return tuple((float(x), float(y)) for x, y in pairs)
