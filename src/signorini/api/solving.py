"""Solutions of a scene, computed on the spot."""

import logging
from collections.abc import Iterable, Iterator
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

    Examples
    --------
    >>> from signorini import load_scene
    >>> solution = solve_level(load_scene("config/scenes/paper.yaml"), "CR", 64)
    >>> solution.status, solution.dofs
    ('solved', 12352)
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

    Examples
    --------
    >>> from signorini import load_scene
    >>> solutions = solve_levels(load_scene("config/scenes/paper.yaml"))
    >>> next(solutions).element, next(solutions).n
    ('P1', 4)
    """
    for element in scene.elements:
        for n in scene.levels:
            yield solve_level(scene, element, n)


def certify_levels(scene: Scene, solutions: Iterable[Any]) -> list[Any]:
    """Guaranteed bounds on all levels of a scene.

    Parameters
    ----------
    scene : Scene
    solutions : iterable of StoredSolution
        Of its elements and levels; what a bound needs besides is solved here.

    Returns
    -------
    list of Level

    Raises
    ------
    SolverError
        If a solution is of status inaccurate.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from signorini import load_scene
    >>> scene = load_scene("config/scenes/corner.yaml")
    >>> few = replace(scene, document=scene.document | {"levels": [4, 8]})
    >>> coarse, fine = certify_levels(few, [])
    >>> bool(fine.numbers["upper"][0] < coarse.numbers["upper"][0])
    True
    """
    from signorini.certificate.level import certified_level
    from signorini.fem.element_facts import ELEMENT_NAMES

    domain, method = scene.problem_statement.triangulations, scene.document["solver"]["method"]
    given = {(solution.element, solution.n): solution for solution in solutions}
    found = []
    for n in scene.levels:
        pair = {name: given.get((name, n)) or solve_level(scene, name, n) for name in ELEMENT_NAMES}
        _log.info("n = %d: certifying", n)
        options = {"n": n, "h": domain.mesh_size(n), "method": method, "elements": scene.elements}
        found.append(certified_level(scene.problem_statement, domain.level(n), pair, **options))
    return found
