"""The study of a scene: all its levels solved, and the rows of errors.csv.

Commands take it from here: no figure and no table of pandas can be reached.
"""

from collections.abc import Callable, Sequence
from typing import Any

from signorini.api.solving import solve_level, solve_levels
from signorini.errors.measure import against_exact, against_reference, error_row
from signorini.exceptions import SceneError
from signorini.scene.scene import Scene, naming


def scene_rows(scene: Scene, norms: Sequence[str] | None = None) -> list[dict[str, Any]]:
    """The rows of errors.csv of a scene, all of it solved here.

    Parameters
    ----------
    scene : Scene
    norms : sequence of str, optional
        By default those of the scene.

    Returns
    -------
    list of dict

    Raises
    ------
    SignoriniError
        Of the solver; or if the scene has no truth.

    Examples
    --------
    >>> from signorini import Scene
    >>> document = {
    ...     "domain": {"kind": "rectangle"},
    ...     "boundary": dict.fromkeys(("bottom", "right", "top", "left"), "dirichlet"),
    ...     "data": {}, "levels": [4, 8], "truth": {"kind": "exact", "u": "x - 2*y"},
    ... }
    >>> rows = scene_rows(Scene.from_dict(document), norms=["l2"])
    >>> [(row["element"], row["n"], row["l2"] < 1e-15) for row in rows]
    [('P1', 4, True), ('P1', 8, True), ('CR', 4, True), ('CR', 8, True)]
    """
    check_truth(scene)
    with naming(scene.source):
        errors = scene_errors(scene, scene.problem_statement.triangulations, norms)
        return [error_row(solution, errors) for solution in solve_levels(scene)]


def check_truth(scene: Scene) -> None:
    """Refuse a scene without a truth.

    Raises
    ------
    SceneError
        Naming its file.
    """
    if scene.truth["kind"] == "none":
        raise SceneError(f"{scene.source}: truth.kind is none: there is nothing to compare with")


def scene_errors(
    scene: Scene, domain: Any, norms: Sequence[str] | None = None, reference: Any = None
) -> Callable[..., dict[str, Any]]:
    """A function from a stored solution of a scene to its errors.

    Parameters
    ----------
    scene : Scene
    domain : Rectangle or Refined
        The scene's.
    norms : sequence of str, optional
        By default those of the scene.
    reference : StoredSolution, optional
        The scene's, where it has one; else it is solved here.

    Returns
    -------
    callable

    Examples
    --------
    >>> from signorini import load_scene
    >>> scene = load_scene("config/scenes/patch.yaml")
    >>> errors = scene_errors(scene, scene.problem_statement.triangulations, ["l2"])
    >>> errors(solve_level(scene, "CR", 4))["l2"] < 1e-14
    True
    """
    norms = norms or scene.document["norms"]
    if scene.truth["kind"] == "exact":
        return against_exact(scene.problem_statement, domain, norms)
    truth = reference or solve_level(scene, scene.truth["element"], scene.truth["n"])
    quadrature = scene.document["norm_quadrature"]
    coefficient = scene.document["data"]["coefficient"]
    return against_reference(truth, domain, norms, quadrature, coefficient)
