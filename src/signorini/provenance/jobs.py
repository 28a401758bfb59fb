"""The jobs behind the results, as Snakemake keeps them in ``.snakemake/metadata``.

Snakemake writes one record for each output: JSON, in a file whose name is the output's path in
base64. A job is what the records of one command have in common.
"""

import base64
import json
import os
from dataclasses import dataclass
from pathlib import Path

_FORMAT = 6  # of Snakemake 9.27; later ones may add keys
_DIGEST = "sha256:"


@dataclass(frozen=True)
class Job:
    """A job that ended well.

    Parameters
    ----------
    rule, command : str
        The rule's name, and what its shell was told.
    started, ended : float
        In seconds of the clock: when the job began, and the time stamp of its last output.
    inputs : dict
        Path -> SHA-256 when the job had ended, or None of a file that Snakemake takes for large.
    outputs : dict
        Path -> its time stamp, as the job left it.
    """

    rule: str
    command: str
    started: float
    ended: float
    inputs: dict
    outputs: dict

    @property
    def seconds(self):
        """From its begin to the time stamp of its last output; of Snakemake only its waiting."""
        return max(0.0, self.ended - self.started)


def read_jobs(project):
    """The jobs whose outputs are there.

    Parameters
    ----------
    project : path-like
        The folder in which Snakemake was started.

    Returns
    -------
    list of Job
        Sorted by their first outputs; empty where Snakemake has never been.
    """
    state = Path(project, ".snakemake")
    unfinished = {path for path, _ in _named_files(state / "incomplete")}
    commands = {}
    for path, file in _named_files(state / "metadata"):
        record = None if path in unfinished else _record(file)
        if record and os.path.lexists(Path(project, path)):
            command = record["rule"], record["shellcmd"] or ""
            commands.setdefault(command, {})[path] = record
    jobs = [_job(*command, records) for command, records in commands.items()]
    return sorted(jobs, key=lambda job: min(job.outputs))


def _named_files(folder):
    """Path of an output -> the file of its record. Long names are split among folders."""
    for place, _, names in os.walk(folder):
        parts = [part.removeprefix("@") for part in Path(place).relative_to(folder).parts]
        for name in names:
            yield _decoded("".join([*parts, name])), Path(place, name)


def _decoded(name):
    try:
        return base64.urlsafe_b64decode(name).decode()
    except ValueError:
        return ""


def _record(file):
    """A record, or None where it is of another format, or half written."""
    try:
        record = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    known = isinstance(record, dict) and record.get("record_format_version", 0) >= _FORMAT
    complete = known and record.get("rule") and record.get("endtime") is not None
    return record if complete else None


def _job(rule, command, records):
    newest = max(records.values(), key=lambda record: record["endtime"])
    digests = newest.get("input_checksums") or {}
    paths = sorted(newest.get("input") or [])
    return Job(
        rule=rule,
        command=command,
        started=min(record["starttime"] for record in records.values()),
        ended=newest["endtime"],
        inputs={path: digests.get(path, "").removeprefix(_DIGEST) or None for path in paths},
        outputs={path: records[path]["endtime"] for path in sorted(records)},
    )
