"""Pack a build as an RO-Crate, by the profile Provenance Run Crate: the workflow, its inputs and
results with their SHA-256 and sizes, and how each job ran, all from FOLDER/provenance.json.

example:
  signorini crate results -o build/crate
"""

import os
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from signorini.commands.catalogue import Outcome
from signorini.exceptions import StorageError


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("results", metavar="FOLDER", help="the results, with provenance.json")
    parser.add_argument(
        "--citation", default="CITATION.cff", metavar="FILE", help="default: CITATION.cff"
    )
    parser.add_argument(
        "--agent",
        metavar="NAME",
        help="who started the run, 'NAME <https://orcid.org/...>'; the record does not know",
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
    results, output = Path(arguments.results), Path(arguments.output)
    if output.exists():
        raise StorageError(f"{output}: is there already; name a new folder")
    if output.resolve().is_relative_to(results.resolve()):
        raise StorageError(f"{output}: is among the results; name a folder outside of {results}")
    _check_writable(output)
    if find_spec("rocrate") is None:
        raise StorageError(
            "it needs rocrate, which is not installed: pip install 'signorini[crate]'"
        )
    record, about = _record(results), _about(arguments.citation)

    from signorini.provenance.crate import build_crate

    _write(build_crate(Path(), record, about, arguments.agent), output)
    counts = f"{len(record['inputs'])} inputs, {len(record['products'])} results"
    return Outcome(f"{output}: {counts}, {len(record['jobs'])} jobs")


def _check_writable(output):
    """Refuse a place where nothing can be made, before the files are read."""
    there = next(folder for folder in output.absolute().parents if folder.exists())
    if not (there.is_dir() and os.access(there, os.W_OK | os.X_OK)):
        raise StorageError(f"{output}: cannot write in {there}; choose a writable folder")


def _record(folder):
    from signorini.provenance.verify import read_record

    record, below = read_record(folder)
    if below or folder.resolve() != Path(record["results"]).resolve():
        whole = f"the folder of results is {record['results']}, below that of the project"
        raise StorageError(f"{folder}: {whole}; go there, and name it")
    return record


def _write(crate, output):
    """All of it, or nothing."""
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=output.parent) as folder:
            crate.write(Path(folder, output.name))
            Path(folder, output.name).rename(output)
    except OSError as error:
        raise StorageError(f"{output}: cannot write ({error.strerror}); free its place") from error


def _about(path):
    from signorini.scene.strict_yaml import load_yaml

    about = load_yaml(path)
    missing = {"title", "abstract", "license", "authors"} - set(about)
    if missing:
        raise StorageError(f"{path}: no {', '.join(sorted(missing))}; add what is missing")
    return about
