"""What the benchmark measures: config/benchmark.yaml, validated."""

from pathlib import Path

from signorini.exceptions import SceneError
from signorini.scene.schema import validated
from signorini.scene.strict_yaml import load_yaml

_SCHEMA = Path(__file__).with_name("settings.schema.yaml")
_COARSER = 4  # how many times coarser than a reference the levels are whose errors are shown


def read_settings(path, quick=False):
    """Read the settings.

    Parameters
    ----------
    path : str or Path
    quick : bool
        Whether what stands under ``quick`` takes the place of the rest.

    Returns
    -------
    dict

    Raises
    ------
    SceneError
        Naming the file, the key, the value and the remedy.
    """
    settings = validated(load_yaml(path), load_yaml(_SCHEMA), path)
    return settings | (settings.get("quick", {}) if quick else {})


def check_references(settings, scenes, source):
    """Check that a reference is named for each scene without an exact solution.

    Parameters
    ----------
    settings : dict
    scenes : dict of str to Scene
    source : str or Path
        The file to name.

    Raises
    ------
    SceneError
        Naming the key that is missing.
    """
    for name, part in settings["scenes"].items():
        if scenes[name].truth["kind"] != "exact" and "reference" not in part:
            raise SceneError(
                f"{source}: scenes.{name}.reference: missing; the scene has no exact solution, so "
                "name the level of a reference, four times the last level whose error is shown"
            )


def measured_levels(settings, scene):
    """The levels of a scene that are measured, each twice the one before.

    Parameters
    ----------
    settings : dict
    scene : Scene

    Returns
    -------
    list of int

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> scene = SimpleNamespace(name="punch", levels=[8])
    >>> measured_levels({"scenes": {"punch": {"finest": 64}}}, scene)
    [8, 16, 32, 64]
    """
    n, levels = scene.levels[0], []
    while n <= settings["scenes"][scene.name]["finest"]:
        levels.append(n)
        n *= 2
    return levels


def shown_levels(settings, scene):
    """Those of `measured_levels` whose errors are shown: four times coarser than a reference.

    Parameters
    ----------
    settings : dict
    scene : Scene

    Returns
    -------
    list of int

    Examples
    --------
    Four times coarser than the reference, at least:

    >>> from types import SimpleNamespace
    >>> scene = SimpleNamespace(name="punch", levels=[8])
    >>> shown_levels({"scenes": {"punch": {"finest": 64, "reference": 128}}}, scene)
    [8, 16, 32]
    """
    levels = measured_levels(settings, scene)
    reference = settings["scenes"][scene.name].get("reference", _COARSER * levels[-1])
    return [n for n in levels if n <= reference // _COARSER]


def own_references(scenes):
    """The level of the reference of each scene that has one.

    Parameters
    ----------
    scenes : iterable of Scene

    Returns
    -------
    dict of str to int

    Examples
    --------
    >>> from signorini import load_scene
    >>> own_references([load_scene(f"config/scenes/{name}.yaml") for name in ("paper", "punch")])
    {'paper': 512}
    """
    return {scene.name: scene.truth["n"] for scene in scenes if scene.truth["kind"] == "reference"}


def coarse_references(settings, scenes):
    """Names of the scenes whose own reference is coarser than the benchmark's.

    Parameters
    ----------
    settings : dict
    scenes : dict of str to Scene

    Returns
    -------
    list of str
    """
    own = own_references(scenes)
    return [name for name, n in own.items() if settings["scenes"][name]["reference"] > n]
