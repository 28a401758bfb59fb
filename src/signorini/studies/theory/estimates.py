"""Both sides of the paper's estimates for the CR solution, level by level.

Of each statement ``left <= C right``, the smallest C with which it holds on a mesh is left / right.
A sequence of them that stays bounded as h falls confirms the statement; one that falls says that
the left side is of higher order than proved.
"""

from typing import NamedTuple

import numpy as np

from signorini.errors.exact import ExactErrors
from signorini.fem.elements import find_element
from signorini.fem.problem import discretize
from signorini.solvers import solve
from signorini.studies.theory.contact_terms import contact_terms
from signorini.studies.theory.exact_parts import interpolate, sobolev_norms

_CR = "CR"
_NORMS_LEVEL = 64  # at which the norms of an exact solution are integrated


class Estimate(NamedTuple):
    """A statement of the paper: its name, its two sides from what is known of a level."""

    name: str
    left: object
    right: object


ESTIMATES = (
    Estimate("Lemma 2.1", lambda of: of.error, lambda of: np.sqrt(of.approximation + of.residual)),
    Estimate(
        "Lemma 3.3",
        lambda of: of.terms.A,
        lambda of: of.h * of.norms.h2_semi * of.error + of.h**1.5 * of.norms.h2**2,
    ),
    Estimate(
        "Lemma 3.4",
        lambda of: of.terms.A,
        lambda of: (
            of.h * of.norms.h2_semi * of.error
            + of.h**2 * np.sqrt(np.log(1 / of.h)) * of.norms.h2**2
        ),
    ),
    Estimate(
        "Lemma 4.1",
        lambda of: of.error**2,
        lambda of: (of.h * of.norms.h2_semi) ** 2 + of.terms.total,
    ),
    Estimate(
        "Theorem 4.1",
        lambda of: of.error,
        lambda of: of.h * np.log(1 / of.h) ** 0.25 * of.norms.h2,
    ),
    Estimate(
        "Theorem 4.2",
        lambda of: of.error,
        lambda of: of.h * (of.norms.h2 + of.norms.boundary_lipschitz),
    ),
    Estimate("Theorem 4.3", lambda of: of.error, lambda of: of.h * of.norms.h2),
)


class Level(NamedTuple):
    """What is known of one level.

    Attributes
    ----------
    h : float
        Mesh width, unit of length.
    error : float
        E, the broken energy norm of u - u_h.
    approximation, residual : float
        ``||u - Pi u||_h**2`` and ``|a_h(u, Pi u - u_h) - chi(Pi u - u_h)|``.
    terms : ContactTerms
    norms : SobolevNorms
    """

    h: float
    error: float
    approximation: float
    residual: float
    terms: object
    norms: object


def estimates_of(scene, levels):
    """Every statement on every level of a scene with an exact solution.

    Parameters
    ----------
    scene : Scene
    levels : sequence of int
        n = 1/h.

    Returns
    -------
    estimates : list of dict
        A row for each statement and level: ``statement``, ``n``, ``h``, ``left``, ``right`` and
        ``constant``.
    terms : list of dict
        A row for each level: ``n``, ``h``, ``error``, the edges ``binding``, ``free`` and
        ``mixed``, the terms ``D1``, ``D2`` and ``A``.

    Raises
    ------
    SceneError
        If the scene has no exact truth.
    """
    statement = scene.problem_statement
    norms = sobolev_norms(statement.exact, statement.triangulations.level(_NORMS_LEVEL))
    estimates, terms = [], []
    for n in levels:
        level = measure_level(statement, n, norms)
        terms.append(_terms_row(n, level))
        estimates += [_estimate_row(each, n, level) for each in ESTIMATES]
    return estimates, terms


def measure_level(statement, n, norms):
    """Solve one level and measure it.

    Parameters
    ----------
    statement : ProblemStatement
        With an exact truth.
    n : int
    norms : SobolevNorms

    Returns
    -------
    Level
    """
    exact, problem = statement.exact, discretize(statement, _CR, n)
    mesh, u_h = problem.mesh, solve(problem).u
    interpolant = interpolate(exact, mesh)
    difference = interpolant - u_h
    difference[problem.fixed] = (
        0.0  # Dirichlet values at midpoints are not means; zero to order h^4
    )
    residual = float(difference @ (problem.apply(interpolant) - problem.b))
    seminorm = ExactErrors(exact, ["h1_semi"])
    return Level(
        h=statement.triangulations.mesh_size(n),
        error=seminorm.of(mesh, find_element(_CR), u_h)["h1_semi"],
        approximation=seminorm.of(mesh, find_element(_CR), interpolant)["h1_semi"] ** 2,
        residual=abs(residual),
        terms=contact_terms(exact, statement.data.obstacle, mesh, u_h, interpolant),
        norms=norms,
    )


def _estimate_row(estimate, n, level):
    left, right = float(estimate.left(level)), float(estimate.right(level))
    sides = {"left": left, "right": right, "constant": left / right}
    return {"statement": estimate.name, "n": n, "h": level.h} | sides


def _terms_row(n, level):
    terms = level.terms
    edges = {"binding": terms.binding, "free": terms.free, "mixed": terms.mixed}
    sums = {"D1": terms.D1, "D2": terms.D2, "A": terms.A}
    return {"n": n, "h": level.h, "error": level.error} | edges | sums
