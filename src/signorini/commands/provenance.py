"""Say what a folder of results was built from, by what and where: commit, versions, machine, the
duration of each job, and the SHA-256 of every input and product. Snakemake runs it when it ends.

example:
  signorini provenance results
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output
from signorini.exceptions import StorageError
from signorini.provenance.build import COMPLETE, STATES, describe_build
from signorini.provenance.folder import RECORD
from signorini.storage import write_json


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("results", metavar="FOLDER", help="where the results are, below this one")
    add_output(parser, "it, default: FOLDER/provenance.json", required=False)
    parser.add_argument("--state", choices=STATES, default=COMPLETE, help="how the run ended")
    parser.add_argument(
        "--failed", nargs="+", default=[], metavar="RULE", help="the rules that failed, if any did"
    )
    parser.add_argument(
        "--touched", action="store_true", help="that the run made nothing and touched files only"
    )
    parser.add_argument("--cores", type=int, metavar="N", help="how many Snakemake was given")
    parser.add_argument("--asked", default="", metavar="WORDS", help="what Snakemake was told")


def run(arguments):
    """Describe the build, and write the record.

    Raises
    ------
    StorageError
        If there is no such folder, or it cannot be written.
    """
    folder = Path(arguments.results)
    if folder.is_absolute() or ".." in folder.parts or not folder.is_dir():
        raise StorageError(f"{folder}: not a folder below this one; name that of the results")
    run = {
        "state": arguments.state,
        "failed": arguments.failed,
        "asked": arguments.asked.split(),
        "cores": arguments.cores,
        "touched": arguments.touched,
    }
    record = describe_build(Path(), folder.as_posix(), **run)
    write_json(arguments.output or folder / RECORD, record)
    counts = f"{len(record['products'])} products of {len(record['jobs'])} jobs"
    return Outcome(f"provenance: {counts}, {len(record['inputs'])} inputs", record)
