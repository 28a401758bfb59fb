"""Digits one can trust: Table 5.1 computed in other ways that are equally right."""

from dataclasses import replace

import numpy as np

from signorini.errors.rates import slopes
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import SolverError
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.labels import NamedMesh, labelled
from signorini.mesh.triangulation import LABELS
from signorini.solvers import METHODS, solve

_EPS = np.finfo(float).eps


def table(statement, asked, solved=None):
    """The numbers of the table.

    Parameters
    ----------
    statement : ProblemStatement
    asked : dict
        Of the scene: ``elements``, ``levels``, ``norms``, and ``truth`` with ``element`` and ``n``.
    solved : callable, optional
        From a `Problem` to u; by default by the route that is taken unasked.

    Returns
    -------
    list of dict
        ``element``, ``n`` (0 for the mean slope), ``norm``, ``value``.
    """
    solved = solved or by_route("auto")
    problem = discretize(statement, asked["truth"]["element"], asked["truth"]["n"])
    truth = ReferenceErrors(problem.mesh, problem.element, solved(problem), asked["norms"])
    rows = []
    for element in asked["elements"]:
        found = {}
        for n in asked["levels"]:
            problem = discretize(statement, element, n)
            found[n] = truth.of(problem.mesh, element, solved(problem))
        for norm in asked["norms"]:
            errors = [found[n][norm] for n in asked["levels"]]
            slope = slopes([1.0 / n for n in asked["levels"]], errors)["mean"]
            values = dict(zip((*asked["levels"], 0), (*errors, slope), strict=True))
            rows += [
                {"element": element, "n": n, "norm": norm, "value": value}
                for n, value in values.items()
            ]
    return rows


def by_route(method):
    """Solve by a route; where it does not apply, by the one that is taken unasked."""

    def solved(problem):
        try:
            return solve(problem, method).u
        except SolverError as error:
            if "does not apply" not in str(error):
                raise
            return solve(problem).u

    return solved


def last_bit(rng):
    """Solve with every datum moved by one unit in its last binary digit, up or down, or not at all."""

    def solved(problem):
        parts = {}
        for name in ("b", "lower", "fixed_values"):
            values = getattr(problem, name)
            parts[name] = np.nextafter(
                values, values + rng.integers(-1, 2, values.size) * np.abs(values)
            )
        return solve(replace(problem, **parts)).u

    return solved


def renumbered(statement, rng, method):
    """Solve on the same mesh with vertices, triangles and edges numbered at random, and number u
    back.
    """

    def solved(problem):
        mesh, vertex, facet = renumber(problem.mesh, rng)
        u = solve(discretize_on(mesh, problem.element, statement), method).u
        return u[vertex if problem.element == "P1" else facet]

    return solved


def renumber(mesh, rng):
    """Number a mesh at random.

    Returns
    -------
    mesh : Triangulation
    vertex, facet : ndarray of int
        The new number of each old vertex and facet.
    """
    vertex = rng.permutation(mesh.number_of_vertices)
    p = np.empty_like(mesh.p)
    p[:, vertex] = mesh.p
    t = vertex[mesh.t][:, rng.permutation(mesh.number_of_triangles)]
    ends = {label: vertex[mesh.facets[:, mesh.boundary_facets(label)]] for label in LABELS}
    parts = {label: found for label, found in ends.items() if found.size}
    new = labelled(NamedMesh(p, np.ascontiguousarray(t), parts), {label: label for label in parts})
    keys, wanted = (
        np.sort(facets, axis=0).T.astype(np.int64) @ [p.shape[1], 1]
        for facets in (new.facets, vertex[mesh.facets])
    )
    order = np.argsort(keys)
    return new, vertex, order[np.searchsorted(keys[order], wanted)]


def variant(name, statement, asked, samples):
    """The table computed in other ways.

    Parameters
    ----------
    name : {"auto", "routes", "last-bit", "renumbered"}
        As it is computed unasked; by every route; with what chance there is in data and numbering.
    statement, asked
        See `table`.
    samples : int
        Repetitions of what is random.

    Returns
    -------
    list of dict
        As `table`, with ``variant`` (the name, or the route's) and ``sample``.
    """
    rows = []
    for label, sample, solved in _ways(name, statement, samples):
        rows += [
            {"variant": label, "sample": sample} | row for row in table(statement, asked, solved)
        ]
    return rows


def _ways(name, statement, samples):
    if name in ("auto", "routes"):
        return [
            (method, 0, by_route(method)) for method in (METHODS if name == "routes" else ("auto",))
        ]
    general = next(method for method in METHODS if method != "fourier")
    chances = [np.random.default_rng([20, sample]) for sample in range(samples)]
    if name == "last-bit":
        return [(name, sample, last_bit(rng)) for sample, rng in enumerate(chances)]
    return [
        (name, sample, renumbered(statement, rng, general)) for sample, rng in enumerate(chances)
    ]


def digits(base, rows):
    """Digits that no variant changes.

    Parameters
    ----------
    base : list of dict
        The table as it is computed unasked.
    rows : list of dict
        Of `variant`.

    Returns
    -------
    list of dict
        Per cell ``element``, ``n``, ``norm`` and ``value``; ``digits`` = -log10 of the largest
        relative change, at most that of one rounding; and the same per variant,
        ``digits_<variant>``.
    """
    key = ("element", "n", "norm")
    values = {tuple(row[k] for k in key): row["value"] for row in base}
    names = list(dict.fromkeys(row["variant"] for row in rows))
    found = []
    for cell, value in values.items():
        changes = {
            name: max(
                abs(row["value"] / value - 1.0)
                for row in rows
                if row["variant"] == name and tuple(row[k] for k in key) == cell
            )
            for name in names
        }
        stable = {f"digits_{name}": _digits(change) for name, change in changes.items()}
        found.append(
            dict(zip(key, cell, strict=True))
            | {"value": value, "digits": min(stable.values())}
            | stable
        )
    return found


def _digits(change):
    return float(-np.log10(max(change, _EPS)))
