"""Table 5.1 computed in other ways that are equally right."""

from dataclasses import replace

import numpy as np

from signorini.errors.rates import slopes
from signorini.errors.reference import ReferenceErrors
from signorini.fem.problem import discretize, discretize_on
from signorini.generated.numbering import renumber
from signorini.solvers import METHODS, solve
from signorini.solvers.attempts import GENERAL, attempt


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
        found = [truth.of(problem.mesh, element, solved(problem)) for problem in problems]
        for norm in scene["norms"]:
            errors = [level[norm] for level in found]
            values = [*errors, slopes(widths, errors)["mean"]]
            rows += [
                {"element": element, "n": n, "norm": norm, "value": value}
                for n, value in zip((*scene["levels"], 0), values, strict=True)
            ]
    return rows


def by_route(method):
    """Solve by a route; where it does not apply, by the default one."""

    def solved(problem):
        found = attempt(problem, method)
        return found.result().u if found.applies else solve(problem).u

    return solved


def last_bit(rng):
    """Solve with every datum moved by one unit in its last bit, up or down, or not at all."""

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
    """
    return [
        {"variant": label, "sample": sample} | row
        for label, sample, solved in _ways(name, statement, samples)
        for row in table(statement, scene, solved)
    ]


def _ways(name, statement, samples):
    """(variant, sample, function from a problem to u)."""
    if name in ("auto", "routes"):
        methods = METHODS if name == "routes" else ("auto",)
        return [(method, 0, by_route(method)) for method in methods]
    rngs = [np.random.default_rng([20, sample]) for sample in range(samples)]
    chances = [last_bit(rng) if name == "last-bit" else renumbered(statement, rng) for rng in rngs]
    return [(name, sample, solved) for sample, solved in enumerate(chances)]
