"""The section ``publication`` of a scene: the names of its files, and the paths that it names."""

import os
import re

from signorini.exceptions import SceneError
from signorini.wording import nearest

TABLE, SURFACE = "table", "surface"
# Names that other files of LaTeX have.
TAKEN = ("macros", "paper", "benchmark", "sensitivity", "stability", "theory", "adaptive")
_PLAIN = re.compile(r"[\w.+@ /-]+")


def names_of(document):
    """What a scene calls its table and its figures.

    Parameters
    ----------
    document : dict
        Validated.

    Returns
    -------
    dict
        ``"table"``, ``"surface"`` or a norm -> name of its files, without ending. There is always
        one of the table.

    Examples
    --------
    >>> names_of({"publication": {"names": {"l2": "figure_1"}}})
    {'table': 'table', 'l2': 'figure_1'}
    """
    return {TABLE: TABLE} | document.get("publication", {}).get("names", {})


def check_names(document):
    """Refuse names that collide, and figures that the scene cannot have.

    Parameters
    ----------
    document : dict
        Valid but for this, defaults filled in.

    Raises
    ------
    SceneError
        Naming the field, its value and the remedy.
    """
    names = document.get("publication", {}).get("names", {})
    for kind, name in names.items():
        field = f"publication.names.{kind}"
        _check_collision(field, kind, name, names)
        _CHECKS.get(kind, _check_norm)(field, kind, document)


def _check_collision(field, kind, name, names):
    others = {other for other in names if other != kind and names[other] == name}
    defaults = {TABLE, SURFACE} - {kind}
    if others:
        raise SceneError(
            f"{field}: {name} is also the name of {min(others)}; every file needs its own"
        )
    if name in TAKEN or name in defaults:
        raise SceneError(f"{field}: {name} is the name of another file; choose another")


def _check_surface(field, kind, document):
    truth, domain = document["truth"], document["domain"]
    is_sampled = domain["kind"] == "rectangle" and truth["kind"] == "reference"
    if not is_sampled or truth["element"] != "P1":
        raise SceneError(
            f"{field}: a surface is that of a P1 reference on a rectangle; drop it, "
            "the manuscript can include figures/solution.pdf"
        )


def _check_measured(field, kind, document):
    if document["truth"]["kind"] == "none" or len(document["levels"]) < 2:
        raise SceneError(
            f"{field}: {kind} needs a truth and two levels; set truth.kind and levels, or drop it"
        )


def _check_norm(field, norm, document):
    _check_measured(field, norm, document)
    if norm not in document["norms"]:
        raise SceneError(
            f"{field}: the norm is not computed; add it to norms, or drop it; "
            f"{nearest(norm, document['norms'])}"
        )


_CHECKS = {TABLE: _check_measured, SURFACE: _check_surface}


def with_paths(section, scene_path):
    """The section with its paths relative to the working folder.

    Parameters
    ----------
    section : dict
    scene_path : Path
        The scene's file. Files may lie anywhere below the folder two above its own.

    Returns
    -------
    dict

    Raises
    ------
    SceneError
        Where a file is missing or lies elsewhere.
    """
    found = {
        key: _resolved(f"publication.{key}", section[key], scene_path, ending)
        for key, ending in (("published", ".csv"), ("manuscript", ".tex"))
        if key in section
    }
    return section | found


def _resolved(field, file, scene_path, ending):
    folder = scene_path.absolute().parent
    tree = folder.parents[1] if len(folder.parents) > 1 else folder.parent
    path = (folder / file).resolve()
    if not _PLAIN.fullmatch(file) or path.suffix != ending:
        raise SceneError(f"{field}: {file!r} is not valid; name a file {ending}, in plain letters")
    if not path.is_relative_to(tree.resolve()):
        raise SceneError(
            f"{field}: {file!r} leads out of the project, {tree}; copy the file into it"
        )
    if not path.is_file():
        raise SceneError(f"{field}: {file!r} is no file, relative to {folder}; {_near(path)}")
    return os.path.relpath(path)


def _near(path):
    """A hint at the files of the folder that was meant."""
    if not path.parent.is_dir():
        return "there is no such folder; mend the path"
    there = sorted(file.name for file in path.parent.glob(f"*{path.suffix}"))
    return nearest(path.name, there) if there else "write it, or mend the path"
