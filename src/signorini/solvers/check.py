"""What is looked at before a problem is solved."""

from typing import NamedTuple

import numpy as np

from signorini.exceptions import SolverError
from signorini.solvers.dot import dot

_CONTRAST = 1e16  # of a coefficient: what double precision can hold side by side


def check_data(problem):
    """Refuse data that are not finite, do not fit each other, or that double precision cannot hold
    together.

    Raises
    ------
    SolverError
        Naming what is wrong.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 2)
    >>> check_data(problem.with_data(b=problem.b * np.nan))
    Traceback (most recent call last):
    signorini.exceptions.SolverError: problem.b: entry 0 is nan; all data must be finite
    """
    _check_arrays(problem)
    for name in ("b", "lower", "fixed_values"):
        values = getattr(problem, name)
        if not np.all(np.isfinite(values)):
            k = int(np.flatnonzero(~np.isfinite(values))[0])
            raise SolverError(f"problem.{name}: entry {k} is {values[k]}; all data must be finite")
    for dofs, values in (("contact", "lower"), ("fixed", "fixed_values")):
        numbers, count = getattr(problem, dofs), getattr(problem, values).size
        if numbers.size != count:
            raise SolverError(
                f"problem.{values}: {count} values for {numbers.size} dofs in problem.{dofs}"
            )
        if numbers.size and not 0 <= numbers.min() <= numbers.max() < problem.b.size:
            raise SolverError(
                f"problem.{dofs}: a dof is not one of the {problem.b.size} that problem.b has"
            )
        if np.any(np.diff(numbers) <= 0):
            raise SolverError(
                f"problem.{dofs}: the dofs do not increase; sort them, each once, with their "
                f"entries of problem.{values}"
            )
    if np.intersect1d(problem.contact, problem.fixed).size:
        raise SolverError(
            "problem.contact: a dof is in problem.fixed, too; leave it out of one of them"
        )
    _check_coefficient(problem.coefficient)


def _check_arrays(problem):
    """Refuse what is no array of real numbers of the right shape."""
    cells = problem.mesh.number_of_triangles
    for name in ("b", "contact", "lower", "fixed", "fixed_values", "coefficient"):
        values = getattr(problem, name)
        if values is None and name == "coefficient":
            continue
        kinds, what = ("iu", "whole") if name in ("contact", "fixed") else ("fiu", "real")
        if not isinstance(values, np.ndarray) or values.ndim != 1 or values.dtype.kind not in kinds:
            raise SolverError(f"problem.{name}: give an array of {what} numbers in one dimension")
        if name == "coefficient" and values.size != cells:
            raise SolverError(
                f"problem.coefficient: {values.size} numbers; give one for each of the {cells} "
                "triangles"
            )


def _check_coefficient(k):
    if k is None:
        return
    if not (np.all(np.isfinite(k)) and np.all(k > 0.0)):
        raise SolverError("data.coefficient: not positive and finite everywhere")
    if k.max() > _CONTRAST * k.min():
        raise SolverError(
            f"data.coefficient: from {k.min():.3g} to {k.max():.3g}, "
            "which double precision cannot hold side by side; "
            f"let it vary by less than {_CONTRAST:g}"
        )


def checked_guess(problem, guess):
    """A guess of the contact set as an array of its own; None where there is none.

    Parameters
    ----------
    problem : Problem
    guess : array_like of bool, shape (nc,), or None
        Which contact dofs are believed to bind.

    Returns
    -------
    ndarray of bool, shape (nc,), or None

    Raises
    ------
    SolverError
        If it is no mask of the contact dofs.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> guess = np.ones(problem.contact.size, dtype=bool)
    >>> checked_guess(problem, guess).size, checked_guess(problem, None) is None
    (9, True)
    """
    if guess is None:
        return None
    guess = np.asarray(guess)
    if guess.shape != problem.contact.shape or guess.dtype != bool:
        raise SolverError(
            f"guess: shape {guess.shape} of {guess.dtype}; give a mask of the contact dofs, shape "
            f"{problem.contact.shape} of bool"
        )
    return guess.copy()


def check_symmetric(A):
    """Check that a matrix is symmetric, by two products.

    For random x and y, x . A y must be y . A x. That tells any matrix that is not symmetric, or not
    finite.

    Raises
    ------
    SolverError
        If it is neither.

    Examples
    --------
    Nothing is said of a symmetric matrix:

    >>> check_symmetric(np.array([[2.0, -1.0], [-1.0, 2.0]]))
    """
    x = np.random.default_rng(0).random(A.shape[0]) - 0.5
    y = x[::-1].copy()
    Ax, Ay = A @ x, A @ y
    if not abs(dot(x, Ay) - dot(y, Ax)) <= 1e-9 * np.sqrt(dot(x, x)) * np.sqrt(dot(Ax, Ax)):
        raise SolverError(
            "problem.A: not symmetric, or not finite; "
            "a Signorini problem is that of a symmetric form"
        )


def check_solvable(problem):
    """Hold the load of each part of the body that no Dirichlet part holds: its sum decides
    (Fichera's condition).

    Raises
    ------
    SolverError
        If a constant may be added to u there, once or without end.

    Examples
    --------
    Nothing keeps a load that pulls from lifting the body off:

    >>> import signorini
    >>> check_solvable(signorini.problem(signorini.rectangle(4), f=1, contact="bottom"))
    Traceback (most recent call last):
    signorini.exceptions.SolverError: unbounded: no dirichlet part and int f + int g = ...
    """
    for part in floating_parts(problem):
        load = problem.b if part is None else problem.b[part]
        contact = (
            problem.contact.size
            if part is None
            else np.isin(problem.contact, part, kind="sort").sum()
        )
        _check_load(load, contact, _place(problem, part), _words(problem))


def floating_parts(problem):
    """The dofs of each part of the body without a fixed one; None for all of a body in one part.

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    list
        Arrays of int, or only None.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> floating_parts(discretize(load_scene("config/scenes/paper.yaml"), "P1", 2))
    []
    """
    if problem.grid is not None or problem.mesh.in_one_part:
        return [] if problem.fixed.size else [None]
    from scipy.sparse.csgraph import connected_components

    count, part = connected_components(problem.A, directed=False)
    held = np.zeros(count, dtype=bool)
    held[part[problem.fixed]] = True
    return [np.flatnonzero(part == k) for k in np.flatnonzero(~held)]


def resting_parts(problem):
    """The contact dofs of each part of the body that nothing but the inequality holds.

    Of each part some dof binds, whatever rounding says: its load presses (Fichera's condition).

    Parameters
    ----------
    problem : Problem

    Returns
    -------
    list of ndarray of int
        Places in ``problem.contact``.

    Examples
    --------
    >>> import signorini
    >>> body = signorini.problem(signorini.rectangle(2), "P1", f=-1, contact="bottom")
    >>> [part.tolist() for part in resting_parts(body)]
    [[0, 1, 2]]
    """
    contact = problem.contact
    parts = floating_parts(problem)
    return [
        np.arange(contact.size)
        if part is None
        else np.flatnonzero(np.isin(contact, part, kind="sort"))
        for part in parts
    ]


def _place(problem, part):
    """Where a part of the body is, for a message; empty for all of it."""
    if part is None:
        return ""
    from signorini.fem.elements import find_element

    x, y = find_element(problem.element).nodes(problem.mesh, part[:1])[:, 0]
    return f" of the part of the body with ({x:.6g}, {y:.6g})"


class _Words(NamedTuple):
    """What the messages of a problem say: the sign of a load that parts, and its integrals."""

    parts: float
    load: str
    effect: str
    mean: str


def _words(problem):
    load = "int f + int g" if problem.contact_load is None else "int f + int g + int contact_flux"
    if problem.upper:
        return _Words(-1.0, load, "< 0 draws u down from", "positive")
    return _Words(1.0, load, "> 0 lifts u off", "negative")


def _check_load(load, contact, place, words):
    total, size = float(load.sum()), float(np.abs(load).sum())
    rounding = 8.0 * np.finfo(float).eps * size
    if not contact and place:
        raise SolverError(
            "singular stiffness matrix: a part of the body is loose, "
            f"the boundary{place} is neither dirichlet nor "
            "contact anywhere; join it to a dirichlet or contact part of the boundary"
        )
    if not contact:
        raise SolverError(
            "boundary: neither dirichlet nor contact anywhere, "
            "u is determined up to a constant at best"
        )
    if abs(total) <= rounding:
        raise SolverError(
            f"nonunique: no dirichlet part{place} and {words.load} = 0, "
            "so a constant may be added to u; "
            "add a dirichlet part to the boundary"
        )
    if words.parts * total > 0.0:
        raise SolverError(
            f"unbounded: no dirichlet part{place} and {words.load} = {total:.3e} {words.effect} "
            "the obstacle without "
            f"end; add a dirichlet part to the boundary, or a load with {words.mean} mean"
        )
