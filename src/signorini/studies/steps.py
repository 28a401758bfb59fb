"""How many contact sets are tried before the right one: ours beside a plain active set.

The plain one is the primal-dual active set method as it is usually written, `rivals.active_set`. It
starts without contact, and each of its steps factorises the matrix of the whole body anew. A step
of ours works with what is condensed to the contact part.
"""

import numpy as np

from signorini.fem.problem import discretize_on
from signorini.rivals import RIVALS
from signorini.solvers import solve

_PLAIN = RIVALS["superlu"]
_TIME_LIMIT = 60.0


def step_rows(scene):
    """The steps of every element and level of a scene.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    list of dict
        ``element``, ``n``; ``contact``, the number of contact dofs; ``plain``, the steps of the
        plain active set, None where it finds no answer within a minute; ``ours`` and ``route``, the
        steps of the route that the scene takes; and ``warm``, the same from the contact set of the
        next coarser level, None on the coarsest.

    Examples
    --------
    >>> from signorini import load_scene
    >>> from dataclasses import replace
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> few = replace(scene, document=scene.document | {"levels": [8, 16]})
    >>> [(row["element"], row["n"]) for row in step_rows(few)]
    [('P1', 8), ('P1', 16), ('CR', 8), ('CR', 16)]
    """
    rows = []
    for element in scene.elements:
        coarser = None
        for n in scene.levels:
            mesh = scene.problem_statement.triangulations.level(n)
            problem = discretize_on(mesh, element, scene.problem_statement)
            row, coarser = _row(problem, scene.document["solver"]["method"], coarser)
            rows.append({"element": element, "n": n} | row)
    return rows


def _row(problem, method, coarser):
    """The steps of one level, and its solution."""
    answer = _PLAIN.solve(problem, time_limit=_TIME_LIMIT)
    solution = solve(problem, method)
    warm = None
    if coarser is not None:
        warm = solve(problem, method, guess=guess_from(coarser, problem)).iterations
    row = {
        "contact": problem.contact.size,
        "plain": answer.iterations if answer.claimed else None,
        "ours": solution.iterations,
        "route": solution.method,
        "warm": warm,
    }
    return row, solution


def guess_from(solution, problem):
    """The contact set of a solution, carried to the contact dofs of a finer level.

    Parameters
    ----------
    solution : Solution
    problem : Problem

    Returns
    -------
    ndarray of bool, shape (nc,)
        What holds at the nearest contact dof of the solution; nowhere contact where it has none.

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.solvers import solve
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> coarse, fine = (scene.problem("CR", n) for n in (16, 32))
    >>> guess = guess_from(solve(coarse), fine)
    >>> int(np.sum(guess != solve(fine).active)) <= 1
    True
    """
    known = solution.problem.contact_points
    if not known.size:
        return np.zeros(problem.contact.size, dtype=bool)
    distances = np.hypot(*(problem.contact_points[:, :, None] - known[:, None, :]))
    return solution.active[distances.argmin(axis=1)]
