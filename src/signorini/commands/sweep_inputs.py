"""A scene with a sweep, as the commands of a sweep take it."""

from signorini.commands.inputs import scene_of
from signorini.exceptions import SceneError


def swept_scene(path):
    """The scene that an argument names.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Scene

    Raises
    ------
    SceneError
        If it has no sweep, or as `inputs.scene_of`.
    """
    scene = scene_of(path)
    if "sweep" not in scene.document:
        raise SceneError(
            f"{scene.source}: there is no section sweep; "
            "add one, for instance sweep: {data.obstacle: {from: -1, to: 0, count: 11}}"
        )
    return scene
