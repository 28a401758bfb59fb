"""A build as a Provenance Run Crate: the workflow, what it read and made, and how each job ran.

All of it is taken from ``provenance.json``.
"""

import os
import re
from io import StringIO
from pathlib import Path, PurePosixPath

from signorini.exceptions import StorageError
from signorini.provenance.crate_run import add_run, as_list, compact, entity, package
from signorini.provenance.folder import RECORD, check_inside, digest_of
from signorini.provenance.whole import RESULTS
from signorini.storage import digest_file
from signorini.wording import cut

WORKFLOW = "Snakefile"
README = "README.md"
PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    "https://w3id.org/ro/wfrun/provenance/0.5": "Provenance Run Crate",
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": "Workflow RO-Crate",
}
# Version 1.1, to which these profiles belong, has no word for a SHA-256: their own terms do.
_TERMS = "https://w3id.org/ro/terms/workflow-run/context"
_RO_CRATE = "1.1"
_BIOSCHEMAS = "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE"
_AGENT = re.compile(r"([^<>]*[^<>\s])(?:\s+<(https?://[^<>\s]+)>)?")
_UNKNOWN = "application/octet-stream"
_FORMATS = {
    "": "text/plain",
    ".bib": "application/x-bibtex",
    ".csv": "text/csv",
    ".html": "text/html",
    ".j2": "text/plain",
    ".json": "application/json",
    ".md": "text/markdown",
    ".npz": "application/zip",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".py": "text/x-python",
    ".pvd": "application/xml",
    ".smk": "text/plain",
    ".sha256": "text/plain",
    ".svg": "image/svg+xml",
    ".tex": "application/x-tex",
    ".txt": "text/plain",
    ".vtu": "application/xml",
    ".yaml": "application/yaml",
}
_ABOUT = """# {name}

This folder is an RO-Crate: `ro-crate-metadata.json` says of each file what it is, and of each
result which job made it, by which command, from which files, and when.

- Sources: commit {commit}.
- Results: `{results}`, of {jobs} jobs; state: {state}.
- Whether the files are still those of the build: `signorini verify {whole}`, in this folder.
"""


def build_crate(project, record, about, agent=None):
    """The crate of a build, not yet written.

    Parameters
    ----------
    project : path-like
        The folder in which Snakemake was started.
    record : dict
        Its ``provenance.json``.
    about : dict
        ``title``, ``abstract``, ``license`` and ``authors`` as in ``CITATION.cff``; ``keywords``
        and ``repository-code`` where it has them.
    agent : str, optional
        Who started the run: a name, and an address in angle brackets if there is one.

    Returns
    -------
    rocrate.rocrate.ROCrate
        Its method ``write`` copies the files and writes ``ro-crate-metadata.json``.

    Raises
    ------
    StorageError
        If the record is not that of a run of Snakemake, the agent has no name, or a file is not
        there, leads out of the folder, or is not as the record says.
    """
    from rocrate.rocrate import ROCrate

    if WORKFLOW not in record["inputs"] or not record["jobs"]:
        raise StorageError(
            f"{RECORD}: no {WORKFLOW} or no jobs; build with Snakemake, in its folder"
        )
    named = _agent(agent) if agent else None
    crate = ROCrate(version=_RO_CRATE)
    crate.metadata.extra_contexts.append(_TERMS)
    _describe(crate, record, about)
    workflow = _workflow(crate, Path(project), record)
    files = _files(crate, Path(project), record, workflow)
    actions = add_run(crate, workflow, files, record)
    if named:
        _name_agent(crate, actions, *named)
    if address := about.get("repository-code") or about.get("url"):
        for program in [workflow, *as_list(workflow["hasPart"])]:
            program["url"] = address
    return crate


def _agent(agent):
    """The name and the address, or None in its place, of who started the run."""
    found = _AGENT.fullmatch(agent)
    if not found:
        raise StorageError(f"agent: {cut(agent)!r} is no name; write NAME or 'NAME <https://...>'")
    return found.groups()


def _name_agent(crate, actions, name, address):
    """Say of every action who started it; who is an author too is the same person."""
    place = address or "#agent"
    agent = crate.get(place) or entity(crate, place, "Person", name=name)
    for action in actions:
        action["agent"] = agent


def _files(crate, project, record, workflow):
    """Path -> entity of every file, once each is known to be that of the record."""
    products = {path: product["sha256"] for path, product in record["products"].items()}
    used = products.keys() | {path for job in record["jobs"] for path in job.get("reads", ())}
    files = {}
    for path, digest in (record["inputs"] | products).items():
        check_inside(path, RECORD)
        _check_unchanged(project, path, digest, path in used)
        facts = _facts(project, path, digest)
        if path == WORKFLOW:
            workflow.properties().update(facts)
            files[path] = workflow
        else:
            files[path] = crate.add_file(project / path, path, properties=facts)
    _add_record(crate, project, record)
    if README not in files:
        _add_readme(crate, record)
    return files


def _add_record(crate, project, record):
    """The record itself, and the digests beside results, which `signorini verify` reads."""
    seals = [digest_file(path) for path in record["products"]]
    there = [path.as_posix() for path in seals if os.path.lexists(project / path)]
    for path in (f"{record['results']}/{RECORD}", *there):
        facts = _facts(project, path, digest_of(project / path))
        crate.add_file(project / path, path, properties=facts)


def _add_readme(crate, record):
    commit = record["source"]["commit"] or "unknown"
    facts = {"results": record["results"], "jobs": len(record["jobs"]), "state": record["state"]}
    whole = "." if record["results"] == RESULTS else record["results"]
    text = _ABOUT.format(name=crate.name, commit=commit, whole=whole, **facts)
    about = {"name": README, "encodingFormat": _FORMATS[".md"], "about": {"@id": "./"}}
    crate.add_file(StringIO(text), README, properties=about)


def _check_unchanged(project, path, digest, is_used):
    """Refuse a file that is not that of the record, in which no job is said to read the library."""
    if not os.path.lexists(project / path):
        raise StorageError(f"{path}: in the record, but gone; {_remedy(is_used)}")
    if digest_of(project / path) != digest:
        raise StorageError(f"{path}: changed since the build; {_remedy(is_used)}")


def _remedy(is_used):
    built = "restore it, or build again"
    recorded = "; if no job reads it, `signorini provenance` records it as it is"
    return built if is_used else built + recorded


def _facts(project, path, digest):
    """What is said of a file, whose digest is known."""
    return {
        "name": path,
        "sha256": digest,
        "contentSize": str((project / path).stat().st_size),
        "encodingFormat": _FORMATS.get(PurePosixPath(path).suffix, _UNKNOWN),
    }


def _describe(crate, record, about):
    root = crate.root_dataset
    root["name"] = f"A build of {about['title']}"
    root["description"] = " ".join(about["abstract"].split())
    root["datePublished"] = record["written"]
    root["license"] = _license(crate, about["license"])
    authors = [_author(crate, *item) for item in enumerate(about["authors"], 1)]
    root["author"] = compact(authors)
    root["conformsTo"] = [_profile(crate, *item) for item in PROFILES.items()]
    if about.get("keywords"):
        root["keywords"] = ", ".join(about["keywords"])


def _license(crate, name):
    address = f"https://spdx.org/licenses/{name}"
    return entity(crate, address, "CreativeWork", name=name, url=address)


def _author(crate, place, author):
    """An author of the citation file: a person, or a group with one name."""
    names = [author.get("given-names"), author.get("family-names")]
    person = " ".join(filter(None, names))
    kind = "Person" if person else "Organization"
    name = person or author.get("name", "unknown")
    return entity(crate, author.get("orcid", f"#author-{place}"), kind, name=name)


def _profile(crate, address, name):
    version = address.rpartition("/")[2]
    found = crate.get(address)
    return found or entity(crate, address, "CreativeWork", name=name, version=version)


def _workflow(crate, project, record):
    versions = record["machine"]["versions"]
    workflow = crate.add_workflow(
        project / WORKFLOW,
        WORKFLOW,
        main=True,
        lang="snakemake",
        lang_version=versions.get("snakemake"),
    )
    workflow.properties()["@type"] = [*workflow.type, "HowTo"]
    workflow["conformsTo"] = {"@id": _BIOSCHEMAS}
    workflow["version"] = record["source"]["commit"] or "unknown"
    workflow["softwareRequirements"] = [
        package(crate, name, version) for name, version in versions.items() if version
    ]
    return workflow
