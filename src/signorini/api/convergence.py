"""Errors over levels, as tables: those of errors.csv and rates.csv."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import pairwise
from numbers import Real
from typing import TYPE_CHECKING, Any

from signorini.api.arguments import described
from signorini.api.frame import as_frame
from signorini.api.measures import as_stored, measure_of, warn_of_reference
from signorini.api.scene_study import scene_rows
from signorini.api.solve import solve
from signorini.errors.measure import error_row
from signorini.exceptions import SceneError, SignoriniError
from signorini.fem.problem import Problem
from signorini.scene.scene import Scene
from signorini.wording import shown

if TYPE_CHECKING:
    from pandas import DataFrame


def convergence(
    scene: Scene | Callable[[int], Problem | Iterable[Problem]],
    levels: Sequence[int] | None = None,
    truth: Any = None,
    norms: Sequence[str] | None = None,
) -> "DataFrame":
    """Errors over levels.

    Parameters
    ----------
    scene : Scene or callable
        A scene, which has its own levels, elements, truth and norms. Or a function from a level n
        to a `Problem`, or to several, such as one for each element.
    levels : sequence of int, optional
        With a function: increasing, whole numbers.
    truth : optional
        With a function: what `Solution.errors` takes, an exact solution or a finer one, at least
        four times as fine as the finest level, or there is a warning.
    norms : sequence of str, optional
        See `Solution.errors`; by default those of the scene.

    Returns
    -------
    pandas.DataFrame
        The columns of errors.csv: element, n, h, dofs, the norms, floor, and what the solver says.
        The rows of an element come together, by increasing level.

    Raises
    ------
    SignoriniError
        Of the scene, the problems or the solver; or if levels or truth are missing.

    Examples
    --------
    >>> import signorini
    >>> def problem(n):
    ...     mesh = signorini.rectangle(n)
    ...     return signorini.problem(mesh, "P1", exact="smooth", dirichlet=SIDES, contact="bottom")
    >>> SIDES = ["right", "top", "left"]
    >>> frame = signorini.convergence(problem, [4, 8, 16], "smooth")
    >>> frame["l2"].is_monotonic_decreasing
    True
    """
    if isinstance(scene, Scene):
        _refuse(levels=levels, truth=truth)
        return as_frame(scene_rows(scene, norms))
    if not callable(scene):
        raise SceneError(
            f"scene: {described(scene)} is neither a Scene nor a function from a level n to a "
            "Problem; load one by signorini.load_scene"
        )
    if levels is None or truth is None:
        missing = "levels" if levels is None else "truth"
        raise SceneError(f"{missing}: missing; beside a function of n give levels and truth")
    return as_frame(_rows(scene, _read_levels(levels), truth, norms))


def _read_levels(levels: Any) -> list[int]:
    """Levels as whole numbers, each once, coarsest first."""
    given = list(levels) if isinstance(levels, Iterable) else []
    if not given:
        raise SceneError(f"levels: {described(levels)} has no level; give a list, as [8, 16, 32]")
    for n in given:
        is_number = isinstance(n, Real) and not isinstance(n, bool)
        if not is_number or not float(n).is_integer():
            raise SceneError(
                f"levels: {described(n)} is no whole number; give a list, as [8, 16, 32]"
            )
    whole = [int(n) for n in given]
    if any(b <= a for a, b in pairwise(whole)):
        raise SceneError(
            f"levels: {shown(whole)} is not increasing; list each level once, coarsest first"
        )
    return whole


def _refuse(**given: Any) -> None:
    for field, value in given.items():
        if value is not None:
            raise SceneError(
                f"{field}: {described(value)} is not needed, the scene has it; drop it"
            )


def _rows(
    problem_of_level: Callable[[int], Problem | Iterable[Problem]],
    levels: Sequence[int],
    truth: Any,
    norms: Sequence[str] | None,
) -> list[dict[str, Any]]:
    """The rows of a program's problems; one measure serves all, as a reference is read once."""
    rows: list[dict[str, Any]] = []
    problems: list[Problem] = []
    measure: Callable[..., dict[str, Any]] | None = None
    for n in levels:
        for problem in _several(problem_of_level(n)):
            solution = solve(_of_level(problem, n))
            measure = measure or measure_of(truth, solution, norms)
            problems.append(solution.problem)
            rows.append(error_row(as_stored(solution), lambda _, s=solution, m=measure: m(s)))
    if problems:
        warn_of_reference(truth, problems, stacklevel=3)
    first = {entry["element"]: k for k, entry in reversed(list(enumerate(rows)))}
    return sorted(rows, key=lambda entry: first[entry["element"]])


def _several(problems: Any) -> Iterable[Any]:
    """What a function of a program returned, one problem or several, as several."""
    alone = isinstance(problems, Problem) or not isinstance(problems, Iterable)
    return [problems] if alone else problems


def _of_level(problem: Any, n: int) -> Problem:
    """The problem, its level named as the program names it."""
    if not isinstance(problem, Problem):
        raise SceneError(
            f"problem_of_level: {described(problem)} for n = {n} is no Problem; return that of "
            "signorini.problem(...), or a list of them"
        )
    return replace(problem, n=n)


def rates(errors: "DataFrame") -> "DataFrame":
    """Slopes of the errors against the mesh width.

    Parameters
    ----------
    errors : pandas.DataFrame
        Of `convergence`, or read from errors.csv; two levels at least.

    Returns
    -------
    pandas.DataFrame
        The columns of rates.csv: element, norm, kind (mean of the slopes between levels, or
        least-squares fit), slope, and floor, which is "0", or says why the slope means nothing.

    Raises
    ------
    SignoriniError
        If there are fewer than two levels, a column is missing, an element has one h twice, or an
        h or an error is no number.

    Examples
    --------
    >>> import pandas as pd
    >>> levels = {"element": "P1", "h": [0.5, 0.25], "l2": [4.0, 1.0], "floor": ""}
    >>> rates(pd.DataFrame(levels)).query("kind == 'fit'")["slope"].item()
    2.0
    """
    from signorini.errors.rates import rate_rows

    return as_frame(rate_rows(error_rows(errors)))


def error_rows(errors: "DataFrame") -> list[dict[str, Any]]:
    """The rows of a table of errors, None where it is empty.

    Parameters
    ----------
    errors : pandas.DataFrame

    Returns
    -------
    list of dict

    Raises
    ------
    SignoriniError
        If it is no such table, or has no row.

    Examples
    --------
    >>> import pandas as pd
    >>> error_rows(pd.DataFrame({"element": ["P1"], "h": [0.5], "l2": [None], "floor": [None]}))
    [{'element': 'P1', 'h': 0.5, 'l2': None, 'floor': ''}]
    """
    columns = list(getattr(errors, "columns", ()))
    for column in ("element", "h", "floor"):
        if column not in columns:
            raise SignoriniError(
                f"errors: no column {column!r} in {described(errors)}; "
                "give the table of signorini.convergence"
            )
    if not len(errors):
        raise SignoriniError("errors: the table has no row; a slope needs two levels")
    known = errors.astype(object).where(errors.notna(), None)
    known["floor"] = known["floor"].fillna("")  # of a file in which it is empty
    rows: list[dict[str, Any]] = known.to_dict("records")
    return rows
