"""A scene: one whole question, read from a file and validated before any work is done."""

import os
import re
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from signorini.errors.rates import reference_note
from signorini.exceptions import SceneError, SignoriniError
from signorini.scene.checks import check_critical_points, check_document
from signorini.scene.schema import validated
from signorini.scene.statement import ProblemStatement
from signorini.scene.strict_yaml import load_yaml

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
_RESERVED = ("meshes", "studies", "quick")


@dataclass(frozen=True)
class Scene:
    """A validated scene.

    Parameters
    ----------
    name : str
        The file's name without ending.
    document : dict
        The file's content with every default filled in.
    problem : ProblemStatement
    source : Path, optional
        The file.
    """

    name: str
    document: dict
    problem: ProblemStatement
    source: Path | None = None

    def check(self):
        """Check what only a triangulation shows, see `ProblemStatement.check`; errors name the
        file.
        """
        with _naming(self.source):
            self.problem.check()

    def section(self, *keys):
        """The named parts of the document, as a new dict."""
        return {key: self.document[key] for key in keys}

    @property
    def statement(self):
        """The parts of the document that `ProblemStatement.from_mapping` reads, as a new dict."""
        return _statement(self.document)

    @property
    def reference_note(self):
        """What a reference that is hardly finer than the finest level does to errors and slopes, or
        None.
        """
        return reference_note(self.truth, self.levels, self.elements)

    @property
    def warnings(self):
        """What a user should know though the scene is valid: a list of lines, each of which names
        its field.
        """
        measured = {"errors", "rates", "table"} & set(self.document["outputs"])
        return [f"truth.n: {self.reference_note}"] if measured and self.reference_note else []

    @property
    def elements(self):
        """Elements compared, a list of names."""
        return self.document["elements"]

    @property
    def levels(self):
        """Levels n = 1/h, increasing."""
        return self.document["levels"]

    @property
    def truth(self):
        """The section ``truth``."""
        return self.document["truth"]


@cache
def scene_schema():
    """The JSON schema of a scene, a dict."""
    return load_yaml(Path(__file__).with_name("schema.yaml"))


def load_scene(path):
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
    """
    scene = read_scene(path)
    scene.check()
    return scene


def read_scene(path):
    """As `load_scene`, without `Scene.check`: what the document alone shows is validated, and numpy
    not imported.
    """
    path = Path(path)
    check_name(path.stem)
    written = load_yaml(path)
    document = validated(written, scene_schema(), path)
    if "outputs" not in written and document["truth"]["kind"] == "none":
        document["outputs"] = []
    with _naming(path):
        check_document(document)
        if document["truth"]["kind"] != "exact":
            document["data"] = dict.fromkeys(("g", "dirichlet", "obstacle"), 0) | document["data"]
        if document["domain"]["kind"] == "mesh":
            document["domain"]["file"] = _mesh_file(document["domain"]["file"], path)
        problem = ProblemStatement.from_mapping(_statement(document))
        check_critical_points(document, problem.exact)
    return Scene(path.stem, document, problem, path)


@contextmanager
def _naming(path):
    """Let an error name the scene's file."""
    try:
        yield
    except SignoriniError as error:
        raise type(error)(f"{path}: {error}") from None


def _statement(document):
    keys = ["domain", "boundary", "data", "load_quadrature"] + ["truth"] * (
        document["truth"]["kind"] == "exact"
    )
    return {key: document[key] for key in keys} | {"coarsest": document["levels"][0]}


def check_name(name):
    """Refuse a scene name that could leave its folder or trouble a shell."""
    if name in _RESERVED:
        raise SceneError(
            f"scene name {name!r}: results/{name} is used for other things; choose another name"
        )
    if not _NAME.fullmatch(name):
        raise SceneError(
            f"scene name {name[:80]!r} is not valid; use 1 to 64 letters, digits, '-' and '_', "
            "starting with a letter or digit"
        )


def _mesh_file(file, scene_path):
    """Path of the mesh file from the working folder; it must lie in the folder above that of the
    scene.
    """
    from signorini.mesh.imported import resolve_mesh_path

    folder = scene_path.absolute().parent
    return os.path.relpath(resolve_mesh_path(file, folder.parent, folder))
