"""A whole folder: the sources of a build beside its results, as an archive or a crate has them.

As in `verify`, the folder may be anybody's, and no link in it is followed.
"""

import os
import re
from pathlib import Path

from signorini.exceptions import StorageError
from signorini.provenance.folder import RECORD, digest_of, inside, read_small
from signorini.provenance.verify import REFUSED, Finding

RESULTS = "results"
# The record of the first that is there holds for both: an archive has `expected` results.
_PARTS = ("expected", RESULTS)
_SHA256 = re.compile(r"[0-9a-f]{64}")


def parts_of(folder):
    """The folders of results in a whole.

    Parameters
    ----------
    folder : Path

    Returns
    -------
    list of Path
        The first has the record that holds for all; empty where the folder is one of results.
    """
    if (folder / RECORD).is_file():
        return []
    there = [folder / name for name in _PARTS if not (folder / name).is_symlink()]
    return [part for part in there if (part / RECORD).is_file()]


def check_inputs(folder, record):
    """Hold what the jobs read against what is beside the results.

    Parameters
    ----------
    folder : Path
        The whole.
    record : dict
        As `read_record` returns it.

    Returns
    -------
    list of Finding

    Raises
    ------
    StorageError
        If the record tells no inputs.
    """
    inputs = record.get("inputs")
    if not (isinstance(inputs, dict) and all(map(_is_digest, inputs.values()))):
        raise StorageError(f"{RECORD}: no SHA-256 of inputs; `signorini provenance` writes them")
    return [found for path in sorted(inputs) for found in _held(folder, path, inputs[path])]


def _is_digest(value):
    return isinstance(value, str) and _SHA256.fullmatch(value)


def _held(folder, path, wanted):
    try:
        place = inside(folder, path, RECORD)
        if not os.path.lexists(place):
            return [Finding("missing", path, "the build read it")]
        found = digest_of(place)
    except StorageError as error:
        return [Finding(REFUSED, path, str(error))]
    difference = f"its SHA-256 is {found[:12]}..., the build read {wanted[:12]}..."
    return [] if found == wanted else [Finding("changed", path, difference)]


def check_sum(archive):
    """Hold an archive against the digest beside it, where there is one.

    Parameters
    ----------
    archive : Path

    Returns
    -------
    list of Finding
    """
    beside = Path(f"{archive}.sha256")
    if not beside.is_file():
        return []
    same = read_small(beside).split()[:1] == [digest_of(archive.resolve()).encode()]
    return [] if same else [Finding("changed", str(archive), f"not the SHA-256 in {beside.name}")]
