"""A build as a Workflow Run RO-Crate: the workflow, what it read, what it made, and how it ran.

All of it is taken from ``provenance.json``; who started the run is not known, and not said.
"""

from datetime import UTC, datetime
from pathlib import Path, PurePosixPath

from signorini.exceptions import StorageError
from signorini.provenance.build import COMPLETE, LIBRARY
from signorini.provenance.folder import check_inside, digest_of
from signorini.wording import cut

WORKFLOW = "Snakefile"
BASE = "https://w3id.org/ro/wfrun"
PROFILES = {
    f"{BASE}/process/0.5": "Process Run Crate",
    f"{BASE}/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
_BIOSCHEMAS = "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE"
_RO_CRATE = "1.1"  # to which these versions of the profiles belong
_STATUS = "http://schema.org/CompletedActionStatus", "http://schema.org/FailedActionStatus"
_FORMATS = {
    ".csv": "text/csv",
    ".json": "application/json",
    ".md": "text/markdown",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".py": "text/x-python",
    ".tex": "application/x-tex",
    ".txt": "text/plain",
    ".yaml": "application/yaml",
}
_MACHINERY = (LIBRARY, "workflow/", WORKFLOW, "requirements.txt")


def build_crate(project, record, about):
    """The crate of a build, not yet written.

    Parameters
    ----------
    project : path-like
        The folder in which Snakemake was started.
    record : dict
        Its ``provenance.json``.
    about : dict
        ``title``, ``abstract`` and ``license`` as in ``CITATION.cff``.

    Returns
    -------
    rocrate.rocrate.ROCrate
        Its method ``write`` copies the files and writes ``ro-crate-metadata.json``.

    Raises
    ------
    StorageError
        If a file is not there, leads out of the folder, or is not as the record says.
    """
    from rocrate.rocrate import ROCrate

    digests = record["inputs"] | {path: told["sha256"] for path, told in record["products"].items()}
    if WORKFLOW not in record["inputs"]:
        raise StorageError(f"inputs: no {WORKFLOW}; build with Snakemake in the project's folder")
    crate = ROCrate(version=_RO_CRATE)
    _describe(crate, record, about)
    main = _workflow(crate, Path(project), record)
    files = {WORKFLOW: main}
    for path, digest in digests.items():
        facts = _facts(Path(project), path, digest)
        if path == WORKFLOW:
            main.properties().update(facts)
        else:
            files[path] = crate.add_file(Path(project, path), path, properties=facts)
    main["hasPart"] = [files[path] for path in record["inputs"] if _is_part(path)]
    _action(crate, main, files, record)
    return crate


def _is_part(path):
    """Whether an input is of the program, and not what it is asked."""
    return path.startswith(_MACHINERY) and path != WORKFLOW


def _facts(project, path, digest):
    """What is said of a file, once it is known to be the one of the record."""
    check_inside(path, "provenance.json")
    found = digest_of(project / path)
    if found != digest:
        told = f"its SHA-256 is {found[:12]}..., not {cut(str(digest))[:12]}..."
        raise StorageError(f"{path}: {told}; build again, or restore it")
    facts = {
        "name": path,
        "sha256": digest,
        "contentSize": str((project / path).stat().st_size),
    }
    kind = _FORMATS.get(PurePosixPath(path).suffix)
    return facts | ({"encodingFormat": kind} if kind else {})


def _describe(crate, record, about):
    crate.name = f"A build of {about['title']}"
    crate.description = " ".join(about["abstract"].split())
    crate.license = f"https://spdx.org/licenses/{about['license']}"
    crate.datePublished = record["written"]
    profiles = [_profile(crate, address, name) for address, name in PROFILES.items()]
    crate.root_dataset["conformsTo"] = profiles


def _profile(crate, address, name):
    version = address.rpartition("/")[2]
    return _entity(crate, address, "CreativeWork", name=name, version=version)


def _entity(crate, identifier, kind, **facts):
    from rocrate.model.contextentity import ContextEntity

    return crate.add(ContextEntity(crate, identifier, properties={"@type": kind} | facts))


def _workflow(crate, project, record):
    versions = record["machine"]["versions"]
    main = crate.add_workflow(
        project / WORKFLOW,
        WORKFLOW,
        main=True,
        lang="snakemake",
        lang_version=versions.get("snakemake"),
    )
    main["conformsTo"] = {"@id": _BIOSCHEMAS}
    main["version"] = record["source"]["commit"] or "unknown"
    main["softwareRequirements"] = [
        _package(crate, name, version) for name, version in versions.items() if version
    ]
    return main


def _package(crate, name, version):
    address = f"https://pypi.org/project/{name}/{version}/"
    facts = {"name": name, "softwareVersion": version, "url": address}
    return _entity(crate, address, "SoftwareApplication", **facts)


def _action(crate, main, files, record):
    """The run: what it was given, what it made, when, on what machine, and how it ended."""
    complete = record["state"] == COMPLETE
    machine = record["machine"]
    where = ", ".join(str(machine[key]) for key in ("processor", "system") if machine.get(key))
    asked = " ".join(["snakemake", *record["asked"]])
    facts = {
        "name": f"Run of {asked}",
        "description": f"{asked}; {len(record['jobs'])} jobs, on {where or 'unknown'}",
        "actionStatus": {"@id": _STATUS[not complete]},
        "endTime": record["written"],
    }
    starts = [job["started"] for job in record["jobs"]]
    if starts:
        facts["startTime"] = datetime.fromtimestamp(min(starts), UTC).isoformat(timespec="seconds")
    if not complete:
        facts["error"] = f"failed: {', '.join(record['failed'])}"
    given = [files[path] for path in record["inputs"] if not path.startswith(_MACHINERY)]
    made = [files[path] for path in record["products"]]
    action = crate.add_action(main, "#run", object=given, result=made, properties=facts)
    crate.root_dataset["mentions"] = [action]
