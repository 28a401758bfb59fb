"""The run of a build in an RO-Crate: its rules as steps, its jobs as actions, and Snakemake's part.

The words are those of the profile Provenance Run Crate: a tool is the source file of a command, a
step is a rule that runs it, an action is a job.
"""

import re
from datetime import UTC, datetime
from urllib.parse import quote

from signorini.exceptions import StorageError
from signorini.provenance.build import COMPLETE, LIBRARY

_COMMANDS = f"{LIBRARY}signorini/commands"
_CALL = re.compile(r"-m signorini ([\w-]+)(?: ([\w-]+))?")
_STATUS = "http://schema.org/CompletedActionStatus", "http://schema.org/FailedActionStatus"


def add_run(crate, workflow, files, record):
    """Add how the files came to be.

    Parameters
    ----------
    crate : rocrate.rocrate.ROCrate
    workflow : rocrate.model.entity.Entity
        The main workflow in it.
    files : dict
        Path -> the entity of each file of the crate.
    record : dict
        ``provenance.json``.

    Returns
    -------
    list of rocrate.model.entity.Entity
        The run as a whole, Snakemake's part in it, and the jobs.

    Raises
    ------
    StorageError
        If the command of a job is none of the program, or its file is no input.
    """
    jobs = sorted(record["jobs"], key=lambda job: job["started"])
    tools = [_tool(job, files, record) for job in jobs]
    actions = [_job(crate, job, tool, files) for job, tool in zip(jobs, tools, strict=True)]
    controls = _steps(crate, workflow, jobs, tools, actions)
    workflow["hasPart"] = _distinct(tools)
    run = _run(crate, workflow, files, record)
    found = [run, _engine(crate, run, controls, record), *actions]
    crate.root_dataset["mentions"] = found
    return found


def _steps(crate, workflow, jobs, tools, actions):
    """Add a step for each rule, in the order of their first jobs, and what Snakemake did for it."""
    of_rule = {}
    for job, *both in zip(jobs, tools, actions, strict=True):
        of_rule.setdefault(job["rule"], []).append(both)
    steps, controls = [], []
    for place, (rule, each) in enumerate(of_rule.items(), 1):
        used, done = zip(*each, strict=True)
        steps.append(_step(crate, rule, place, used))
        controls.append(_control(crate, steps[-1], done))
    workflow["step"] = compact(steps)
    return controls


def _distinct(entities):
    return compact({each.id: each for each in entities}.values())


def entity(crate, identifier, kind, **facts):
    """Add what is no file: a program, a person, an action.

    Parameters
    ----------
    crate : rocrate.rocrate.ROCrate
    identifier : str
        Its ``@id`` in the crate.
    kind : str
        Its ``@type``.
    **facts
        Its other properties.

    Returns
    -------
    rocrate.model.entity.Entity
    """
    from rocrate.model.contextentity import ContextEntity

    added = crate.add(ContextEntity(crate, identifier, properties={"@type": kind}))
    for key, value in facts.items():
        added[key] = value
    return added


def compact(values):
    """A list, or its only value in its place, as RO-Crate 1.1 asks."""
    values = list(values)
    return values[0] if len(values) == 1 else values


def as_list(value):
    """What `compact` was given."""
    return value if isinstance(value, list) else [value]


def _tool(job, files, record):
    """The source file of a job's command, as a tool."""
    path = _command_file(job["command"], files)
    if path is None:
        raise StorageError(f"{job['rule']}: no command of signorini in its job; build again")
    tool = files[path]
    tool.properties()["@type"] = ["File", "SoftwareSourceCode"]
    words = path.removeprefix(f"{_COMMANDS}/").removesuffix(".py").replace("_", "-").split("/")
    tool["name"] = " ".join(["signorini", *words])
    tool["version"] = record["source"]["commit"] or "unknown"
    return tool


def _command_file(command, files):
    """Of `signorini benchmark point ...` commands/benchmark/point.py, or else benchmark.py."""
    found = _CALL.search(command)
    words = [word.replace("-", "_") for word in found.groups("")] if found else []
    places = ["/".join([_COMMANDS, *words[:count]]) + ".py" for count in (2, 1)]
    return next((place for place in places if place in files), None)


def _job(crate, job, tool, files):
    """A job: what it was told and read, what it made, and when."""
    outputs = sorted(job["outputs"])
    made = [path for output in outputs for path in _files_of(output, files)]
    return crate.add_action(
        tool,
        f"#job/{quote(outputs[0])}",
        object=compact([files[path] for path in job["reads"] if path in files]),
        result=compact([files[path] for path in made]),
        properties={
            "name": f"{job['rule']}: {outputs[0]}",
            "description": job["command"],
            "actionStatus": _STATUS[0],
            "startTime": _time(job["started"]),
            "endTime": _time(job["started"] + job["seconds"]),
        },
    )


def _files_of(output, files):
    """The files of an output, which may be a folder."""
    if output in files:
        return [output]
    return [path for path in files if path.startswith(f"{output}/")]


def _time(seconds):
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds")


def _step(crate, rule, place, tools):
    facts = {"name": rule, "position": str(place), "workExample": _distinct(tools)}
    return entity(crate, f"#step/{rule}", "HowToStep", **facts)


def _control(crate, step, actions):
    """What Snakemake did for a step: it started these jobs."""
    rule = step["name"]
    facts = {"name": f"jobs of the rule {rule}", "instrument": step, "object": compact(actions)}
    return entity(crate, f"#control/{rule}", "ControlAction", **facts)


def _run(crate, workflow, files, record):
    """The whole: what it was given, what it made, when, on what machine, and how it ended."""
    complete, machine = record["state"] == COMPLETE, record["machine"]
    where = ", ".join(str(machine[key]) for key in ("processor", "system") if machine.get(key))
    asked = " ".join(["snakemake", *record["asked"]])
    facts = {
        "name": f"Run of {asked}",
        "description": f"{asked}; {len(record['jobs'])} jobs, on {where or 'unknown'}",
        "actionStatus": _STATUS[not complete],
        "startTime": _time(min(job["started"] for job in record["jobs"])),
        "endTime": record["written"],
    }
    if not complete:
        facts["error"] = f"failed: {', '.join(record['failed'])}"
    given = compact([files[path] for path in record["inputs"] if not _is_program(path)])
    made = compact([files[path] for path in record["products"]])
    return crate.add_action(workflow, "#run", object=given, result=made, properties=facts)


def _is_program(path):
    """Whether an input is of the program, and not what it is asked."""
    return path.startswith((LIBRARY, "workflow/")) or path in ("Snakefile", "requirements.txt")


def _engine(crate, run, controls, record):
    """Snakemake's part: it made the run of its jobs."""
    snakemake = _snakemake(crate, record["machine"]["versions"].get("snakemake"))
    facts = {"name": "Snakemake", "instrument": snakemake} | {
        "object": compact(controls),
        "result": run,
    }
    return entity(crate, "#snakemake", "OrganizeAction", **facts)


def _snakemake(crate, version):
    if version:
        return package(crate, "snakemake", version)
    return entity(crate, "https://snakemake.github.io", "SoftwareApplication", name="snakemake")


def package(crate, name, version):
    """A package of PyPI; the same entity when it is asked for again.

    Parameters
    ----------
    crate : rocrate.rocrate.ROCrate
    name, version : str

    Returns
    -------
    rocrate.model.entity.Entity
    """
    address = f"https://pypi.org/project/{name}/{version}/"
    facts = {"name": name, "softwareVersion": version, "url": address}
    return crate.get(address) or entity(crate, address, "SoftwareApplication", **facts)
