"""Where accuracy ends: errors on ever finer meshes, condition numbers, and stretched cells."""

import time
from functools import partial

import numpy as np

from signorini.errors.exact import ExactErrors
from signorini.errors.norms import PARTS_OF_H1
from signorini.exact import family as exact_family
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.problem import discretize, discretize_on
from signorini.generated.bodies import pressed_flat, with_labels
from signorini.generated.statements import LABELS, grid, square, statement
from signorini.solvers import solve
from signorini.solvers.attempts import attempt

_FAMILIES = ("smooth", "patch")  # of exact solutions
_DENSE = 1000  # unknowns up to which all eigenvalues are found at once


def errors(family, element, levels):
    """Errors against a family of exact solutions, by the default route.

    Parameters
    ----------
    family : {"smooth", "patch"}
    element : {"P1", "CR"}
    levels : sequence of int

    Returns
    -------
    list of dict
        Per level: ``family``, ``element``, ``n``, ``method``, ``dofs``, ``l2``, ``h1_semi``,
        ``residual``, ``accuracy``, ``seconds`` of the solve.
    """
    problem_statement = statement(truth={"family": family}, domain=square())
    measured = ExactErrors(exact_family(family), PARTS_OF_H1)
    rows = []
    for n in levels:
        problem = discretize(problem_statement, element, n)
        start = time.perf_counter()
        solution = solve(problem)
        seconds = time.perf_counter() - start
        row = {"family": family, "element": element, "n": n, "method": solution.method}
        norms = measured.of(problem.mesh, element, solution.u)
        row |= {"dofs": problem.b.size, **{norm: norms[norm] for norm in PARTS_OF_H1}}
        row |= {"residual": solution.residual, "accuracy": solution.accuracy}
        rows.append(row | {"seconds": seconds})
    return rows


def conditions(levels):
    """Condition numbers of the stiffness matrix on the free unknowns, on uniform grids.

    Returns
    -------
    list of dict
        ``element``, ``n``, ``condition``, ``largest`` and ``smallest`` eigenvalue.

    Examples
    --------
    >>> [round(row["condition"], 2) for row in conditions([2])]
    [20.15, 74.44]
    """
    return [
        {"element": element, "n": n}
        | _spectrum(discretize_on(grid(n, n), element, statement({"obstacle": 1.0})))
        for element in ELEMENTS
        for n in levels
    ]


def stretching(aspects, n=8, seed=0):
    """The contact patch test, u = 1 - y / height, on shaken meshes that are pressed flat.

    Parameters
    ----------
    aspects : sequence of float
        Heights of the rectangle of width 1.
    n : int, optional
        Cells along a side.
    seed : int, optional

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
            mesh = with_labels(pressed_flat(n, aspect, seed), LABELS)
            problem = discretize_on(mesh, element, statement({"obstacle": 1.0}))
            row = {"element": element, "aspect": aspect} | _patch_test(problem, aspect)
            rows.append(row | {"condition": _spectrum(problem)["condition"]})
    return rows


def _patch_test(problem, aspect):
    solution = attempt(problem, "direct").solution
    if solution is None:
        return {"error": None, "accuracy": None, "status": "refused"}
    _, y = find_element(problem.element).nodes(problem.mesh, np.arange(problem.b.size))
    error = float(np.max(np.abs(solution.u - (1.0 - y / aspect))))
    return {"error": error, "accuracy": solution.accuracy, "status": solution.status}


def _spectrum(problem):
    """Largest and smallest eigenvalue on the free unknowns, and their ratio."""
    free = problem.free
    A = problem.A[free][:, free].tocsc()
    if free.size <= _DENSE:
        values = np.linalg.eigvalsh(A.toarray())
        smallest, largest = float(values[0]), float(values[-1])
    else:
        from scipy.sparse.linalg import eigsh

        largest = float(eigsh(A, 1, which="LA", return_eigenvectors=False, tol=1e-4)[0])
        smallest = float(eigsh(A, 1, sigma=0.0, which="LM", return_eigenvectors=False, tol=1e-6)[0])
    return {"condition": largest / smallest, "largest": largest, "smallest": smallest}


def _stretching(exponents):
    return stretching([10.0**-exponent for exponent in exponents])


PIECES = {
    f"{family}-{element}": partial(errors, family, element)
    for family in _FAMILIES
    for element in ELEMENTS
} | {"conditions": conditions, "stretching": _stretching}
"""What is measured: name -> function from its levels to rows; of stretching, from the exponents of
ten, negated, of the aspects."""
