"""Table 5.1 computed in other ways that are equally right."""

from dataclasses import replace
from functools import partial

import numpy as np

from signorini.errors.rates import slopes
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import SignoriniError
from signorini.fem.problem import discretize, discretize_on
from signorini.generated.numbering import renumber
from signorini.solvers import METHODS, solve
from signorini.solvers.attempts import GENERAL, attempt
from signorini.wording import nearest


def table(statement, scene, solved):
    """The numbers of the table.

    Parameters
    ----------
    statement : ProblemStatement
    scene : dict
        ``elements``, ``levels``, ``norms``, and ``truth`` with ``element`` and ``n``.
    solved : callable
        From a `Problem` to u.

    Returns
    -------
    list of dict
        ``element``, ``n`` (0 for the mean slope), ``norm``, ``value``.
    """
    problem = discretize(statement, scene["truth"]["element"], scene["truth"]["n"])
    truth = ReferenceErrors(problem.mesh, problem.element, solved(problem), scene["norms"])
    widths, rows = [1.0 / n for n in scene["levels"]], []
    for element in scene["elements"]:
        problems = [discretize(statement, element, n) for n in scene["levels"]]
        by_level = [truth.of(problem.mesh, element, solved(problem)) for problem in problems]
        for norm in scene["norms"]:
            errors = [level[norm] for level in by_level]
            values = [*errors, slopes(widths, errors)["mean"]]
            rows += [
                {"element": element, "n": n, "norm": norm, "value": value}
                for n, value in zip((*scene["levels"], 0), values, strict=True)
            ]
    return rows


def by_route(method):
    """Solve by a route; where it does not apply, by the default one.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> bool(abs(by_route("direct")(problem) - by_route("fourier")(problem)).max() < 1e-14)
    True
    """

    def solved(problem):
        tried = attempt(problem, method)
        return tried.result().u if tried.applies else solve(problem).u

    return solved


def last_bit(rng):
    """Solve with every datum moved by one unit in its last bit, up or down, or not at all.

    Examples
    --------
    >>> from signorini import discretize, load_scene, solve
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> moved = last_bit(np.random.default_rng(0))(problem)
    >>> bool(abs(moved - solve(problem).u).max() < 1e-14)
    True
    """

    def moved(values):
        return np.nextafter(values, values + rng.integers(-1, 2, values.size) * np.abs(values))

    def solved(problem):
        parts = {name: moved(getattr(problem, name)) for name in ("b", "lower", "fixed_values")}
        return solve(replace(problem, **parts)).u

    return solved


def renumbered(statement, rng):
    """Solve on the same mesh numbered at random, and number u back.

    Parameters
    ----------
    statement : ProblemStatement
    rng : numpy.random.Generator

    Returns
    -------
    callable
        From a `Problem` to u.

    Examples
    --------
    >>> from signorini import discretize, load_scene, solve
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> problem = discretize(scene, "CR", 8)
    >>> other = renumbered(scene.problem_statement, np.random.default_rng(0))(problem)
    >>> bool(abs(other - solve(problem).u).max() < 1e-14)
    True
    """

    def solved(problem):
        mesh, vertex, facet = renumber(problem.mesh, rng)
        u = solve(discretize_on(mesh, problem.element, statement), GENERAL).u
        return u[vertex if problem.element == "P1" else facet]

    return solved


def variant(name, statement, scene, samples):
    """The table computed in other ways.

    Parameters
    ----------
    name : {"auto", "routes", "last-bit", "renumbered"}
        By the default route; by every route; with chance in the data or in the numbering.
    statement, scene
        See `table`.
    samples : int
        Repetitions of what is random.

    Returns
    -------
    list of dict
        As `table`, with ``variant`` (the name, or the route's) and ``sample``.

    Raises
    ------
    SignoriniError
        If there is no such variant.
    """
    if name not in _WAYS:
        raise SignoriniError(f"--variant: there is no {name!r}; {nearest(name, _WAYS)}")
    return [
        {"variant": label, "sample": sample} | row
        for label, sample, solved in _WAYS[name](statement, samples)
        for row in table(statement, scene, solved)
    ]


def _by_routes(methods, statement, samples):
    return [(method, 0, by_route(method)) for method in methods]


def _last_bit(statement, samples):
    return [("last-bit", sample, last_bit(_rng(sample))) for sample in range(samples)]


def _renumbered(statement, samples):
    numbered = [renumbered(statement, _rng(sample)) for sample in range(samples)]
    return [("renumbered", sample, solved) for sample, solved in enumerate(numbered)]


def _rng(sample):
    return np.random.default_rng([20, sample])


# Variant -> function that lists, for each solve of the table, a name, a sample, and a function from
# a problem to u.
_WAYS = {
    "auto": partial(_by_routes, ("auto",)),
    "routes": partial(_by_routes, METHODS),
    "last-bit": _last_bit,
    "renumbered": _renumbered,
}
