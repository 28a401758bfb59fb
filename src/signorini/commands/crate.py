"""Pack a build as a Workflow Run RO-Crate: the workflow, its inputs and its results with their
SHA-256 and sizes, and the run, from FOLDER/provenance.json. It needs the package rocrate.

example:
  signorini crate results -o build/crate
"""

import json
from importlib.util import find_spec
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.exceptions import StorageError


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("results", metavar="FOLDER", help="the results, with provenance.json")
    parser.add_argument(
        "--citation", default="CITATION.cff", metavar="FILE", help="default: CITATION.cff"
    )
    parser.add_argument(
        "-o", "--output", metavar="FOLDER", required=True, help="where to write it; a new folder"
    )


def run(arguments):
    """Check every file against the record, and write the crate.

    Raises
    ------
    StorageError
        If rocrate is not there, the folder is not new, or a file is not as recorded.
    """
    output = Path(arguments.output)
    if output.exists():
        raise StorageError(f"{output}: is there already; name a new folder")
    if find_spec("rocrate") is None:
        raise StorageError("rocrate: not installed; pip install rocrate")
    record, about = _record(Path(arguments.results)), _about(arguments.citation)

    from signorini.provenance.crate import build_crate

    build_crate(Path(), record, about).write(output)
    counts = f"{len(record['inputs'])} inputs, {len(record['products'])} results"
    return Outcome(f"{output}: {counts}")


def _record(folder):
    from signorini.provenance.build import FORMAT
    from signorini.provenance.folder import RECORD, read_small

    try:
        record = json.loads(read_small(folder / RECORD))
    except ValueError as error:
        raise StorageError(f"{folder / RECORD}: no JSON ({error}); build again") from None
    if not isinstance(record, dict) or record.get("format") != FORMAT:
        raise StorageError(f"{folder / RECORD}: no record of format {FORMAT}; build again")
    return record


def _about(path):
    from signorini.scene.strict_yaml import load_yaml

    about = load_yaml(path)
    missing = {"title", "abstract", "license"} - set(about)
    if missing:
        raise StorageError(f"{path}: no {', '.join(sorted(missing))}; add what is missing")
    return about
