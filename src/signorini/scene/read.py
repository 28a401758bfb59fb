"""Scenes from their files, validated before any work is done."""

import os
from functools import cache
from pathlib import Path

from signorini.errors.rates import reference_note
from signorini.exceptions import SceneError, SignoriniError
from signorini.scene.checks import check_critical_points, check_document
from signorini.scene.file_names import check_file, check_name
from signorini.scene.publication import check_names, with_paths
from signorini.scene.scene import Scene, naming
from signorini.scene.schema import validated
from signorini.scene.strict_yaml import load_yaml
from signorini.scene.sweep import check_sweep, sweep_points, with_values

# What is built by default where no errors are measured.
_WITHOUT_ERRORS = {"none": (), "certificate": ("table", "figures")}


@cache
def scene_schema():
    """The JSON schema of a scene, a dict.

    Examples
    --------
    >>> scene_schema()["properties"]["elements"]["items"]
    {'enum': ['P1', 'CR']}
    """
    return load_yaml(Path(__file__).with_name("schema.yaml"))


def load_scene(path: str | Path) -> Scene:
    """Read a scene file and check all that can be checked before work is done.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Scene

    Raises
    ------
    SceneError, FormulaError, MeshError
        One line that names the file, the field, the value and the remedy.

    Examples
    --------
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> scene.elements, scene.levels[:3], scene.truth["kind"]
    (['P1', 'CR'], [2, 4, 8], 'reference')
    """
    scene = read_scene(path)
    scene.check()
    return scene


def read_scene(path):
    """Read a scene file and check what the document alone shows; NumPy is not imported.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Scene
        Whose `check` checks the rest.

    Raises
    ------
    SceneError, FormulaError, MeshError
        As `load_scene`.

    Examples
    --------
    >>> read_scene("config/scenes/paper.yaml").name
    'paper'
    """
    path = Path(path)
    check_file(path)
    check_name(path.stem)
    return _validated_scene(load_yaml(path), path.stem, path)


def scene_of_mapping(mapping, name, folder):
    """See `Scene.from_dict`.

    Parameters
    ----------
    mapping : dict
    name : str
    folder : str or Path
        As of `Scene.from_dict`.

    Returns
    -------
    Scene

    Raises
    ------
    SceneError, FormulaError, MeshError
        As `load_scene`.

    Examples
    --------
    >>> sides = dict.fromkeys(("bottom", "right", "top", "left"), "dirichlet")
    >>> document = {"domain": {"kind": "rectangle"}, "boundary": sides, "data": {"f": 1}}
    >>> rest = {"levels": [2, 4], "truth": {"kind": "none"}}
    >>> scene_of_mapping(document | rest, "membrane", ".").elements
    ['P1', 'CR']
    """
    scene = read_mapping(mapping, name, folder)
    scene.check()
    return scene


def read_mapping(mapping, name, folder):
    """As `Scene.from_dict`, but checks only what the mapping alone shows; see `read_scene`.

    Parameters
    ----------
    mapping : dict
    name : str
    folder : str or Path
        As of `Scene.from_dict`.

    Returns
    -------
    Scene
        Whose `check` checks the rest.

    Raises
    ------
    SceneError, FormulaError, MeshError
        As `load_scene`.
    """
    if not isinstance(mapping, dict):
        raise SceneError(
            f"{name}: a {type(mapping).__name__} is no mapping; give the sections of a scene"
        )
    check_name(name)
    return _validated_scene(plain(mapping), name, Path(folder, name))


def scene_of_point(scene, point):
    """The scene of a point of a sweep: the scene with the point's values, and no sweep.

    Parameters
    ----------
    scene : Scene
        With a sweep.
    point : Point
        Of `sweep.sweep_points`.

    Returns
    -------
    Scene
        Validated, but for what `Scene.check` checks.

    Raises
    ------
    SceneError, FormulaError, MeshError
        One line that names the file, the point, the field, the value and the remedy.

    Examples
    --------
    >>> from signorini.scene.sweep import sweep_points
    >>> scene = read_scene("config/scenes/punch-widths.yaml")
    >>> point = sweep_points(scene.document["sweep"])[0]
    >>> point.description, scene_of_point(scene, point).levels == scene.levels
    ('truth.parameters.half_width = 0.1', True)
    """
    written = with_values(scene.written, point.values)
    try:
        return _validated_scene(written, scene.name, scene.source)
    except SignoriniError as error:
        problem = str(error).removeprefix(f"{scene.source}: ")
        place = f"{scene.source}: at {point.description} of the sweep"
        raise type(error)(f"{place}: {problem}") from None


def check_points(scene):
    """Check the scene of every point of a sweep, as far as its document shows.

    Parameters
    ----------
    scene : Scene

    Raises
    ------
    SceneError, FormulaError, MeshError
        As `scene_of_point`.

    Examples
    --------
    >>> check_points(read_scene("config/scenes/punch-widths.yaml"))
    """
    for point in sweep_points(scene.document.get("sweep", {})) if scene.written else ():
        scene_of_point(scene, point)


def plain(value):
    """A value as YAML would give it: tuples and arrays as lists, numbers of NumPy as Python's.

    Examples
    --------
    >>> import numpy as np
    >>> plain({"levels": np.array([2, 4]), 3: (1.5, "x")})
    {'levels': [2, 4], '3': [1.5, 'x']}
    """
    if isinstance(value, dict):
        return {str(key): plain(entry) for key, entry in value.items()}
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return value


def _validated_scene(written, name, path):
    """A `Scene`, from a document as it was written, and the path of its file."""
    document = validated(written, scene_schema(), path)
    if "sweep" in document:
        with naming(path):
            check_sweep(document["sweep"], scene_schema())
    truth = document["truth"]["kind"]
    if truth in _WITHOUT_ERRORS and "outputs" not in written:
        document["outputs"] = list(_WITHOUT_ERRORS[truth])
    with naming(path):
        check_document(document)
        if truth != "exact":  # else what is not given is derived
            document["data"] = dict.fromkeys(("g", "dirichlet", "obstacle"), 0) | document["data"]
        if document["domain"]["kind"] == "mesh":
            document["domain"]["file"] = _mesh_file(document["domain"]["file"], path)
        if "publication" in document:
            check_names(document)
            document["publication"] = with_paths(document["publication"], path)
        note = reference_note(document["truth"], document["levels"], document["elements"])
        kept = written if "sweep" in document else None
        scene = Scene(name, document, path, note, kept)
        check_critical_points(document, scene.problem_statement.exact)
    return scene


def _mesh_file(file, scene_path):
    """Path of the mesh file from the working folder.

    It must lie in the folder above that of the scene.
    """
    from signorini.mesh.imported import resolve_mesh_path

    folder = scene_path.absolute().parent
    return os.path.relpath(resolve_mesh_path(file, folder.parent, folder))
