"""Solutions of a scene, computed on the spot."""

import logging
from collections.abc import Iterator
from typing import Any

from signorini.scene.scene import Scene

_log = logging.getLogger(__name__)


def solve_level(scene: Scene, element: str, n: int) -> Any:
    """The solution of an element and a level of a scene.

    Parameters
    ----------
    scene : Scene
    element : {"P1", "CR"}
    n : int

    Returns
    -------
    StoredSolution
    """
    from signorini.fem.problem import discretize_on
    from signorini.solvers import solve
    from signorini.solvers.stored import stored

    _log.info("%s n = %d: solving", element, n)
    domain, method = scene.problem_statement.triangulations, scene.document["solver"]["method"]
    problem = discretize_on(domain.level(n), element, scene.problem_statement)
    return stored(problem, solve(problem, method), n, domain.mesh_size(n))


def solve_levels(scene: Scene) -> Iterator[Any]:
    """The solutions of all elements and levels of a scene, one after the other.

    Parameters
    ----------
    scene : Scene

    Yields
    ------
    StoredSolution
    """
    for element in scene.elements:
        for n in scene.levels:
            yield solve_level(scene, element, n)
