"""The folder of a point: its scene, and what was found, with all that it depends on."""

import hashlib
import json
from pathlib import Path

from signorini.exceptions import SignoriniError, StorageError
from signorini.scene.read import scene_of_point
from signorini.scene.validated import write_validated
from signorini.storage import read_json, write_json
from signorini.sweeps.solves import Solver

_ASKED = ("elements", "levels", "truth", "norms", "norm_quadrature", "quantities", "solver")


def solve_points(scene, points, folder, library, tell=None):
    """Solve points that are not solved yet, and read what is known of the others.

    Parameters
    ----------
    scene : Scene
        With a sweep.
    points : sequence of Point
        Those that state the same problem one after the other.
    folder : str or Path
        Each point has a folder of its name there, with ``scene.json`` and ``point.json``.
    library : str
        A digest of the code: what was found by another is found anew.
    tell : callable, optional
        Called with each record.

    Returns
    -------
    list of dict
        Of each point: ``point``, its name; ``values``; ``rows``, see `Solver.rows`; and ``failed``,
        the message where it could not be solved, else None.
    """
    scenes = [scene_of_point(scene, point) for point in points]  # all are valid before any solve
    solver, records = Solver(), []
    for point, own in zip(points, scenes, strict=True):
        question = question_of(own, library)
        place = Path(folder, point.name)
        record = _known(place, question)
        if record is None:
            record = _solved(solver, own, point) | {"question": question}
            write_validated(place / "scene.json", own)
            write_json(place / "point.json", record, compact=True)
        if tell:
            tell(record)
        records.append({key: record[key] for key in ("point", "values", "rows", "failed")})
    return records


def is_known(scene, point, folder, library):
    """Whether a point has been solved, by this code and as it is stated now.

    Parameters
    ----------
    scene, folder, library
        See `solve_points`.
    point : Point

    Returns
    -------
    bool
    """
    question = question_of(scene_of_point(scene, point), library)
    return _known(Path(folder, point.name), question) is not None


def question_of(scene, library):
    """A digest of all that the rows of a point depend on.

    Parameters
    ----------
    scene : Scene
        Of the point.
    library : str
        A digest of the code.

    Returns
    -------
    str
    """
    domain = scene.document["domain"]
    files = _contents(domain["file"]) if domain["kind"] == "mesh" else ""
    asked = [scene.statement, scene.section(*_ASKED), files, library]
    return hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()


def _contents(file):
    """A digest of the files that a mesh is read from."""
    from signorini.mesh.files import files_read

    parts = [Path(path).read_bytes() for path in files_read(file)]
    return hashlib.sha256(b"".join(parts)).hexdigest()


def _known(place, question):
    """The record of a point, or None where there is none, or one of another question."""
    try:
        record = read_json(place / "point.json")
    except StorageError:
        return None
    return record if record.get("question") == question else None


def _solved(solver, scene, point):
    """The record of a point that is solved now."""
    known = {"point": point.name, "values": point.values, "rows": [], "failed": None}
    try:
        return known | {"rows": solver.rows(scene)}
    except SignoriniError as error:
        return known | {"failed": str(error)}
