"""Where accuracy ends: errors against exact solutions on ever finer meshes, and condition numbers."""

import time

import numpy as np

from signorini.errors.exact import ExactErrors
from signorini.exact import family as exact_family
from signorini.exceptions import SolverError
from signorini.fem.elements import ELEMENTS
from signorini.fem.elements import element as find_element
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.grid import SIDES, Grid
from signorini.mesh.labels import labelled
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve
from signorini.studies.stability.bodies import pressed_flat

EPS = np.finfo(float).eps
FAMILIES = ("smooth", "patch")
NORMS = ("l2", "h1_semi")
_LABELS = ("contact", "neumann", "dirichlet", "neumann")


def truth_statement(family):
    """The unit square with a family of exact solutions as truth."""
    domain = {"origin": [0, 0], "size": [1, 1], "diagonal": "falling", "cells": "per-side"}
    boundary = dict(zip(SIDES, _LABELS, strict=True))
    mapping = {"domain": domain, "boundary": boundary, "data": {}, "load_quadrature": "exact"}
    return ProblemStatement.from_mapping(mapping | {"truth": {"family": family}})


def errors(family, element, levels, method="auto"):
    """Errors against a family of exact solutions.

    Parameters
    ----------
    family : {"smooth", "patch"}
    element : {"P1", "CR"}
    levels : sequence of int
    method : str
        Route.

    Returns
    -------
    list of dict
        Per level: ``family``, ``element``, ``n``, ``method``, ``dofs``, ``l2``, ``h1_semi``,
        ``residual``, ``accuracy``, ``seconds`` of the solve.
    """
    statement, measured = truth_statement(family), ExactErrors(exact_family(family), NORMS)
    rows = []
    for n in levels:
        problem = discretize(statement, element, n)
        start = time.perf_counter()
        solution = solve(problem, method)
        seconds = time.perf_counter() - start
        found = measured.of(problem.mesh, element, solution.u)
        rows.append(
            {
                "family": family,
                "element": element,
                "n": n,
                "method": solution.method,
                "dofs": problem.b.size,
                **{norm: found[norm] for norm in NORMS},
                "residual": solution.residual,
                "accuracy": solution.accuracy,
                "seconds": seconds,
            }
        )
    return rows


def conditions(levels):
    """Condition numbers of the stiffness matrix on the free unknowns, on uniform grids of the unit
    square.

    Returns
    -------
    list of dict
        ``element``, ``n``, ``condition``, ``largest`` and ``smallest`` eigenvalue.
    """
    rows = []
    for element in ELEMENTS:
        for n in levels:
            grid = Grid(n, n, (0.0, 0.0), (1.0, 1.0), "falling", _LABELS)
            rows.append(
                {"element": element, "n": n} | _extremes(discretize_on(grid, element, _patch(1.0)))
            )
    return rows


def stretching(aspects, n=8, seed=0):
    """The contact patch test, u = 1 - y / height, on shaken meshes that are pressed flat.

    Returns
    -------
    list of dict
        ``element``, ``aspect``; ``error``, the largest at a degree of freedom; ``accuracy``, as the
        solution states it; ``status``; ``condition``. Where the solve is refused, status says so
        and error and accuracy are empty.
    """
    rows = []
    for element in ELEMENTS:
        for aspect in aspects:
            mesh = labelled(pressed_flat(n, aspect, seed), dict(zip(SIDES, _LABELS, strict=True)))
            problem = discretize_on(mesh, element, _patch(1.0))
            _, y = find_element(element).nodes(mesh, np.arange(problem.b.size))
            what = {
                "element": element,
                "aspect": aspect,
                "error": None,
                "accuracy": None,
                "status": "refused",
            }
            try:
                solution = solve(problem, "direct")
                error = float(np.max(np.abs(solution.u - (1.0 - y / aspect))))
                what |= {"error": error, "accuracy": solution.accuracy, "status": solution.status}
            except SolverError:
                pass
            rows.append(what | {"condition": _extremes(problem)["condition"]})
    return rows


def _patch(obstacle):
    zero = {"f": 0, "g": 0, "dirichlet": 0, "obstacle": obstacle}
    return ProblemStatement.from_mapping(
        {"domain": {}, "boundary": {}, "data": zero, "load_quadrature": "exact"}
    )


def _extremes(problem):
    """Largest and smallest eigenvalue on the free unknowns, and their ratio."""
    free = problem.free
    A = problem.A[free][:, free].tocsc()
    if free.size <= 1000:
        values = np.linalg.eigvalsh(A.toarray())
        smallest, largest = float(values[0]), float(values[-1])
    else:
        from scipy.sparse.linalg import eigsh

        largest = float(eigsh(A, 1, which="LA", return_eigenvectors=False, tol=1e-4)[0])
        smallest = float(eigsh(A, 1, sigma=0.0, which="LM", return_eigenvectors=False, tol=1e-6)[0])
    return {"condition": largest / smallest, "largest": largest, "smallest": smallest}


def growth(rows, column, by="n"):
    """Least-squares exponent and factor of ``column = factor * by**exponent``, per element that is
    not zero.

    Returns
    -------
    dict
        Element to (exponent, factor).
    """
    found = {}
    for element in dict.fromkeys(row["element"] for row in rows):
        own = [row for row in rows if row["element"] == element and row[column]]
        if len(own) > 1:
            x, y = (np.log([row[key] for row in own]) for key in (by, column))
            exponent, offset = np.polyfit(x, y, 1)
            found[element] = (float(exponent), float(np.exp(offset)))
    return found


def crossings(rows):
    """Where the smooth family's error would meet the patch family's, which is round-off alone, if
    both went on so.

    Parameters
    ----------
    rows : list of dict
        Of `errors`, by the route that is taken unasked.

    Returns
    -------
    list of dict
        Per ``element`` and ``norm``: ``order`` and ``factor`` of the error, ``floor`` on the finest
        level, the growth ``floor_order`` of the floor, and ``h``, the mesh width where they would
        meet; both None for a floor of zero.
    """
    found = []
    for element in sorted({row["element"] for row in rows}, key=list(ELEMENTS).index):
        for norm in NORMS:
            smooth, floor = (
                sorted(
                    (
                        (row["n"], row[norm])
                        for row in rows
                        if (row["family"], row["element"]) == (family, element)
                    ),
                )
                for family in FAMILIES
            )
            (order, error), (slope, least) = (_power(points[-4:]) for points in (smooth, floor))
            meeting = (least / error) ** (1.0 / (order - slope)) if least else None
            found.append(
                {
                    "element": element,
                    "norm": norm,
                    "order": -order,
                    "floor": floor[-1][1],
                    "floor_order": slope,
                    "h": 1.0 / meeting if meeting else None,
                }
            )
    return found


def _power(points):
    positive = [point for point in points if point[1] > 0]
    if len(positive) < 2:
        return None, None
    n, values = np.log(positive).T
    exponent, offset = np.polyfit(n, values, 1)
    return float(exponent), float(np.exp(offset))
