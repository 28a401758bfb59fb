"""A scene: one whole question, validated."""

from collections.abc import Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from signorini.exceptions import SignoriniError, StorageError

if TYPE_CHECKING:
    from signorini.fem.discrete_problem import Problem


@dataclass(frozen=True, repr=False)
class Scene:
    """A validated scene.

    Parameters
    ----------
    name : str
        The file's name without ending.
    document : dict
        The file's content with every default filled in.
    source : Path, optional
        The file.
    reference_note : str, optional
        What a reference that is hardly finer than the finest level does to errors and slopes, see
        `errors.rates.reference_note`; None where the truth is no reference, or fine enough.
    written : dict, optional
        The document as it was written, where it has a sweep, whose points start from it.
    """

    name: str
    document: dict[str, Any]
    source: Path | None = None
    reference_note: str | None = None
    written: dict[str, Any] | None = None

    def __repr__(self) -> str:
        levels = ", ".join(map(str, self.levels))
        solved = f"{', '.join(self.elements)} on n = {levels}"
        return f"<Scene {self.name}: {solved}; truth {self.truth['kind']}>"

    @classmethod
    def from_dict(
        cls, mapping: Mapping[str, Any], name: str = "scene", folder: str | Path = "."
    ) -> "Scene":
        """A scene from a mapping: what `load_scene` reads, without a file.

        Parameters
        ----------
        mapping : dict
            The sections of a scene; see config/README.md. Tuples and numbers of NumPy may stand for
            lists and numbers.
        name : str, optional
            In place of the name of a file, also in messages.
        folder : str or Path, optional
            Where the file would be: the paths of other files are relative to it.

        Returns
        -------
        Scene

        Raises
        ------
        SceneError, FormulaError, MeshError
            As `load_scene`.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> scene = Scene.from_dict(
        ...     {
        ...         "domain": {"kind": "rectangle"},
        ...         "boundary": sides,
        ...         "data": {"f": "2*pi*sin(2*pi*x)"},
        ...         "levels": [4, 8],
        ...     }
        ... )
        >>> scene.problem("CR", 8).contact.size
        8
        """
        from signorini.scene.read import scene_of_mapping

        return scene_of_mapping(mapping, name, folder)

    def problem(self, element: str, n: int) -> "Problem":
        """The discrete problem of one element and level; as `discretize`.

        Parameters
        ----------
        element : {"P1", "CR"}
        n : int
            The level, n = 1/h; any, not only those of the scene.

        Returns
        -------
        Problem

        Raises
        ------
        SceneError, MeshError, FormulaError
            As `discretize`.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> load_scene("config/scenes/paper.yaml").problem("CR", 8)
        <Problem: CR, n = 8: 208 dofs, 8 in contact>
        """
        from signorini.fem.problem import discretize

        return discretize(self, element, n)

    @cached_property
    def problem_statement(self):
        """What a discretisation depends on, and nothing else of the scene: a `ProblemStatement`."""
        from signorini.scene.statement import ProblemStatement

        return ProblemStatement.from_mapping(self.statement)

    def check(self) -> None:
        """Check what only a triangulation shows; errors name the file.

        Raises
        ------
        SceneError, MeshError
            See `ProblemStatement.check`.
        """
        with naming(self.source):
            self.problem_statement.check()

    def section(self, *keys: str) -> dict[str, Any]:
        """The parts of the document with the names `keys`, as a new dict.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> load_scene("config/scenes/paper.yaml").section("elements", "norms")
        {'elements': ['P1', 'CR'], 'norms': ['l2', 'h1']}
        """
        return {key: self.document[key] for key in keys}

    @property
    def statement(self) -> dict[str, Any]:
        """The parts of the document that `ProblemStatement.from_mapping` reads, as a new dict.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> statement = load_scene("config/scenes/paper.yaml").statement
        >>> statement["load_quadrature"], statement["coarsest"]
        ('centroid', 2)
        """
        exact = ["truth"] if self.truth["kind"] == "exact" else []
        load = ["data", "load_quadrature", "load_precision"]
        parts = self.section("domain", "boundary", "constraint", *load, *exact)
        return parts | {"coarsest": self.levels[0]}

    @property
    def warnings(self) -> list[str]:
        """What a user should know though the scene is valid: lines that name their field.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> load_scene("config/scenes/punch.yaml").warnings
        []
        """
        measured = {"errors", "rates", "table"} & set(self.document["outputs"])
        return [f"truth.n: {self.reference_note}"] if measured and self.reference_note else []

    @property
    def elements(self) -> list[str]:
        """Elements compared, a list of names.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> load_scene("config/scenes/paper.yaml").elements
        ['P1', 'CR']
        """
        return self.document["elements"]

    @property
    def levels(self) -> list[int]:
        """Levels n = 1/h, increasing.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> load_scene("config/scenes/paper.yaml").levels[-1]
        64
        """
        return self.document["levels"]

    @property
    def truth(self) -> dict[str, Any]:
        """The section ``truth``.

        Examples
        --------
        >>> from signorini.scene.read import load_scene
        >>> load_scene("config/scenes/paper.yaml").truth["n"]
        512
        """
        return self.document["truth"]


@contextmanager
def naming(path):
    """Let an error name the scene's file; one of storage names its own.

    Parameters
    ----------
    path : str or Path

    Raises
    ------
    SignoriniError
        Of the kind that was raised in the block.

    Examples
    --------
    >>> from signorini.exceptions import SceneError
    >>> with naming("my.yaml"):
    ...     raise SceneError("levels: missing")
    Traceback (most recent call last):
    signorini.exceptions.SceneError: my.yaml: levels: missing
    """
    try:
        yield
    except StorageError:
        raise
    except SignoriniError as error:
        raise type(error)(f"{path}: {error}") from None
