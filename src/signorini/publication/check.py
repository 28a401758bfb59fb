"""What can be wrong with a publication, found before any work."""

import difflib
import shutil
import subprocess

from signorini.exceptions import SceneError
from signorini.publication.keys import declared_keys, nearest_key, table_of
from signorini.publication.made import made_files, tables_of_use
from signorini.publication.manuscript import MACROS, read_manuscript
from signorini.publication.notation import read_form
from signorini.publication.published import read_published
from signorini.wording import listed

_TOLD = 5  # mistakes of a manuscript, in one line


def check_publication(scene):
    """Check the files that a scene's publication names, if it has one.

    Parameters
    ----------
    scene : Scene

    Raises
    ------
    SceneError, StorageError
        Naming the file, the line, the value and the remedy.
    """
    section = scene.document.get("publication")
    if section is None:
        return
    published = {}
    if "published" in section:
        published = read_published(section["published"])
        _check_computed(section["published"], published, scene)
    if "manuscript" in section:
        declared = declared_keys(scene.document, published.values())
        _check_manuscript(read_manuscript(section["manuscript"]), scene, declared)


def _check_computed(path, published, scene):
    """Refuse a published number that the scene does not compute."""
    declared = declared_keys(scene.document)
    for line, number in published.items():
        if table_of(number.key, declared) not in ("errors", "rates", "outputs", "contact_line"):
            raise SceneError(
                f"{path}: line {line}: the scene {scene.name} computes no {{{number.key}}}; "
                f"{nearest_key(number.key, declared)}; or restore levels, elements and norms"
            )


def _check_manuscript(manuscript, scene, declared):
    _check_uses(manuscript.uses, scene, declared)
    made = made_files(scene.document)
    _check_own_files(manuscript, made)
    if manuscript.uses and MACROS not in {entry.found_in(made) for entry in manuscript.taken}:
        raise SceneError(
            f"{manuscript.uses[0].place}: \\result is not defined; "
            f"add \\input{{{MACROS}}} to the preamble"
        )
    for entry in manuscript.others:
        if entry.is_own and not entry.found_in(made):
            _check_distributed(entry, [*made, *_studies(scene)])


def _check_uses(uses, scene, declared):
    """Refuse uses that are wrong, and tell all of them, or the first few of many."""
    found = [complaint for use in uses if (complaint := _complaint(use, scene, declared))]
    more = [f"{len(found) - _TOLD} more"] if len(found) > _TOLD else []
    if found:
        raise SceneError("; also ".join(found[:_TOLD] + more))


def _complaint(use, scene, declared):
    """What is wrong with a use, or None."""
    try:
        read_form(use.options)
    except ValueError as error:
        return f"{use.place}: \\result[{use.options}]: {error}"
    if tables_of_use(use, declared):
        return None
    remedy = nearest_key(use.key, declared)
    reason = f"the scene {scene.name} has no such number"
    return f"{use.place}: \\result{{{use.key}}}: {reason}; {remedy}"


def _check_own_files(manuscript, made):
    """Refuse files of the manuscript's folder that hide those of the scene."""
    folder = manuscript.path.parent
    own = {str(file.relative_to(folder)): file for file in manuscript.files}
    for name in own.keys() & made.keys():
        raise SceneError(
            f"{own[name]}: the scene makes a file of that name; delete one, "
            "or choose another name in publication.names"
        )


def _studies(scene):
    return [f"{name}.tex" for name in scene.document["publication"]["appendix"]]


def _check_distributed(entry, made):
    """Refuse a file that is nowhere: not in the folder, not made, not in the distribution."""
    if entry.found_in(made) or _distributed(entry):
        return
    near = difflib.get_close_matches(entry.name, made, n=1, cutoff=0.5)
    hint = f"did you mean {near[0]}? " if near else ""
    raise SceneError(
        f"{entry.place}: {entry.name}: no such file beside the manuscript, "
        f"and the scene makes none; {hint}it makes {listed(made)}"
    )


def _distributed(entry):
    """Whether the distribution of TeX has the file, or there is none to ask."""
    if not shutil.which("kpsewhich"):
        return True
    ending = {"bibliography": ".bib"}.get(entry.command, "")
    command = ["kpsewhich", f"{entry.name}{ending}"]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0
