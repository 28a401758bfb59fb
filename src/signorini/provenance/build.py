"""What a build made: ``results/provenance.json``.

A digest is taken when a product is first recorded, and kept as long as no job makes the product
anew: so a file that was changed by hand later is not what the record says. ``snakemake --touch``
makes nothing anew, and what it touches is marked.
"""

import json
from datetime import UTC, datetime
from pathlib import Path

from signorini.exceptions import StorageError
from signorini.provenance.folder import RECORD, digest_of, is_result, read_small, walk
from signorini.provenance.jobs import read_jobs
from signorini.provenance.origin import pinned, source_of

FORMAT = 1
COMPLETE, FAILED = STATES = ("complete", "failed")
LIBRARY = "src/"
# What no job reads and every job follows.
_WORKFLOW = (
    *("Snakefile", "requirements.txt", "config/config.yaml", "workflow/Snakefile"),
    *("workflow/rules/*.smk", "workflow/schemas/*.yaml", "workflow/profiles/*/*.yaml"),
)


def describe_build(
    project, results, state=COMPLETE, failed=(), asked=(), cores=None, touched=False
):
    """Describe what is in a folder of results, and how it came there.

    Parameters
    ----------
    project : path-like
        The folder in which Snakemake was started.
    results : str
        The folder of the results, relative to it.
    state : {"complete", "failed"}
        How the run ended.
    failed : iterable of str
        The rules that failed.
    asked : iterable of str
        What Snakemake was told.
    cores : int, optional
        How many cores it was given.
    touched : bool, optional
        Whether the run made nothing and touched files only.

    Returns
    -------
    dict
        For JSON; docs/artifact.md tells its keys.
    """
    from signorini.studies.machine import OURS, describe

    project = Path(project)
    jobs = [job for job in read_jobs(project) if _of(results, job)]
    inputs, outdated = _inputs(project, results, jobs)
    return {
        "format": FORMAT,
        "state": state,
        "failed": sorted(set(failed)),
        "asked": list(asked),
        "source": source_of(project),
        "machine": describe(pinned(project) or OURS) | {"cores_given": cores},
        "results": results,
        "jobs": [_job(job, outdated) for job in jobs],
        "inputs": inputs,
        "products": _products(project, results, jobs, touched),
        "written": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def _of(results, job):
    return any(path.startswith(f"{results}/") for path in job.outputs)


def _job(job, outdated):
    """A job, for JSON: the files of the library are many, and told all together."""
    library = {path: digest for path, digest in job.inputs.items() if path.startswith(LIBRARY)}
    return {
        "rule": job.rule,
        "command": job.command,
        "started": job.started,
        "seconds": round(job.seconds, 3),
        "reads": [path for path in job.inputs if path not in library],
        "library_files": len(library),
        "outdated": [path for path in job.inputs if (path, job.inputs[path]) in outdated],
        "outputs": job.outputs,
    }


def _inputs(project, results, jobs):
    """Digest by path of what is no result, as the newest job read it; and what older jobs read of
    them, where that was another content.
    """
    found = {}
    for job in sorted(jobs, key=lambda job: job.ended):
        found |= job.inputs
    made = {path for job in jobs for path in job.outputs}
    scenes = [path for path in found if _is_scene(path) and path not in made]
    found |= dict.fromkeys(_of_no_job(project, scenes))
    inputs = {
        path: found[path] or digest_of(project / path)
        for path in sorted(found)
        if not path.startswith(f"{results}/") and (found[path] or (project / path).is_file())
    }
    outdated = {
        (path, digest)
        for job in jobs
        for path, digest in job.inputs.items()
        if digest and found[path] not in (None, digest) and not _is_scene(path)
    }
    return inputs, outdated


def _is_scene(path):
    """A validated scene changes with its title; parameters hold the parts that a job depends on."""
    return path.endswith("/scene.json")


def _of_no_job(project, scenes):
    """The workflow itself, and the files of the scenes that were validated."""
    for pattern in _WORKFLOW:
        yield from (path.relative_to(project).as_posix() for path in project.glob(pattern))
    for path in scenes:
        yield json.loads(read_small(project / path))["source"]


def _products(project, results, jobs, touched):
    """Path -> digest, size, rule and time stamp of every result, in folders of results too."""
    makers = {path: (job.rule, stamp) for job in jobs for path, stamp in job.outputs.items()}
    kept = _kept(project / results / RECORD)
    files, _ = walk(project / results)
    paths = [f"{results}/{path}" for path in files if is_result(path)]
    return {path: _product(project, path, makers, kept, touched) for path in paths}


def _product(project, path, makers, kept, touched):
    places = [path, *(parent.as_posix() for parent in Path(path).parents)]
    rule, stamp = next((makers[place] for place in places if place in makers), (None, None))
    before = kept.get(path)
    if before and stamp is not None and before.get("stamp") == stamp:
        return before
    mark = {"touched": True} if touched and stamp is not None else {}
    if mark and before:
        return before | {"stamp": stamp} | mark
    size = (project / path).stat().st_size
    return {"sha256": digest_of(project / path), "bytes": size, "rule": rule, "stamp": stamp} | mark


def _kept(path):
    """The products of the record before, if there is one of this format."""
    try:
        record = json.loads(read_small(path))
    except (StorageError, ValueError):
        return {}
    known = isinstance(record, dict) and record.get("format") == FORMAT
    return record["products"] if known else {}


def timeless(record):
    """A record without what differs between two builds of the same sources on a machine.

    Parameters
    ----------
    record : dict
        As `describe_build` returns it.

    Returns
    -------
    dict
    """
    jobs = [
        _without(job, "started", "seconds") | {"outputs": [*job["outputs"]]}
        for job in record["jobs"]
    ]
    products = {path: _without(product, "stamp") for path, product in record["products"].items()}
    machine = _without(record["machine"], "load", "date")
    kept = _without(record, "written", "asked")
    return kept | {"jobs": jobs, "products": products, "machine": machine}


def _without(mapping, *keys):
    return {key: value for key, value in mapping.items() if key not in keys}
