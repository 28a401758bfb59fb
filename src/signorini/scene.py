"""A scene: one whole question, read from a file and validated before any work is done."""

import math
import re
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path

from signorini.exceptions import FormulaError, SceneError
from signorini.schema import validated
from signorini.statement import ProblemStatement
from signorini.strict_yaml import load_yaml

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")


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
    """

    name: str
    document: dict
    problem: ProblemStatement

    def section(self, *keys):
        """The named parts of the document, as a new dict."""
        return {key: self.document[key] for key in keys}

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
    return load_yaml(Path(__file__).with_name("scene.schema.yaml"))


def load_scene(path):
    """Read and validate a scene file.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Scene

    Raises
    ------
    SceneError, FormulaError
        One line that names the file, the field, the value and the remedy.
    """
    path = Path(path)
    check_name(path.stem)
    written = load_yaml(path)
    document = validated(written, scene_schema(), path)
    if "outputs" not in written and document["truth"]["kind"] == "none":
        document["outputs"] = []
    try:
        _cross_check(document)
        problem = ProblemStatement.from_mapping(document)
    except (SceneError, FormulaError) as error:
        raise type(error)(f"{path}: {error}") from None
    return Scene(path.stem, document, problem)


def check_name(name):
    """Refuse a scene name that could leave its folder or trouble a shell."""
    if not _NAME.fullmatch(name):
        raise SceneError(
            f"scene name {name[:80]!r} is not valid; use 1 to 64 letters, digits, '-' and '_', "
            "starting with a letter or digit"
        )


def _cross_check(document):
    domain, levels, truth = document["domain"], document["levels"], document["truth"]
    numbers = [("origin", v) for v in domain["origin"]] + [("size", v) for v in domain["size"]]
    for key, value in numbers:
        if not math.isfinite(value) or (key == "size" and value <= 0):
            raise SceneError(f"domain.{key}: {value} is not valid; it must be finite{', positive' * (key == 'size')}")
    if any(b <= a for a, b in pairwise(levels)):
        raise SceneError(f"levels: {levels} is not increasing; list each level once, coarsest first")
    if truth["kind"] == "reference":
        _check_reference(levels, truth)
    if truth["kind"] == "none" and document["outputs"]:
        raise SceneError(
            f"outputs: {document['outputs'][0]} needs a truth to compare with; set truth.kind, or write outputs: []"
        )


def _check_reference(levels, truth):
    if "n" not in truth:
        raise SceneError("truth.n: missing; give the level of the reference, for instance 512")
    if truth["n"] < levels[-1]:
        raise SceneError(f"levels: {levels[-1]} is finer than the reference, truth.n = {truth['n']}; raise truth.n")
    for n in levels:
        ratio, rest = divmod(truth["n"], n)
        if rest or ratio & (ratio - 1):
            raise SceneError(
                f"levels: {n} does not nest in the reference, truth.n = {truth['n']}; truth.n must be a power of two "
                f"times every level, for instance {n * 2 ** max(0, (truth['n'] // n).bit_length() - 1)}"
            )
