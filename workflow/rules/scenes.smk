# Scenes: read and checked before any job starts; each job reads what was validated, scene.json.

from signorini.mesh.boundary import labels_of
from signorini.mesh.files import files_read
from signorini.scene.read import check_name, read_scene


@cache
@reported
def scene(name):
    asked = written(name)
    if asked.problem.needs_mesh:
        check_once(asked)
    return asked


@cache
@reported
def written(name):
    """A scene of which only its file has been read."""
    check_name(name)
    path = Path("config/scenes", f"{name}.yaml")
    if not path.is_file():
        place = (
            f"{where_asked('scenes')}: scenes" if name in CONFIG["scenes"] else f"results/{name}"
        )
        raise SignoriniError(f"{place}: there is no {path}; {nearest(name, known_scenes())}")
    found = read_scene(path)
    for line in found.warnings:
        print(f"warning: {path}: {line}", file=sys.stderr)
    return found


def check_once(asked):
    """Check what takes numpy and a mesh, and remember by a file that this scene has passed this library's checks."""
    domain = asked.document["domain"]
    files = files_read(domain["file"]) if domain["kind"] == "mesh" else []
    seen = as_json([asked.statement, digest(files), digest_of_checks()])
    mark = Path(".snakemake/checked", hashlib.sha256(seen.encode()).hexdigest())
    if mark.is_file():
        return
    asked.check()
    with suppress(OSError):  # it will be checked again
        mark.parent.mkdir(parents=True, exist_ok=True)
        mark.touch()


@cache
def digest_of_checks():
    """What is in the files that check a scene."""
    return digest(modules_from("signorini.scene.statement"))


def known_scenes():
    return sorted(path.stem for path in Path("config/scenes").glob("*.yaml"))


def scene_file(wildcards):
    """The validated scene, an input that starts no job: params hold the parts on which a job depends."""
    return f"results/{wildcards.scene}/scene.json"


def statement(wildcards):
    """What a discretisation depends on, as JSON: it reruns when this changes and only then."""
    return statement_of(wildcards.scene)


def statement_of(name):
    return as_json(scene(name).statement)


def check_memory(jobs):
    """Refuse to start where a job could not hold its level; on a cluster each job says so itself."""
    from signorini.scene.memory_check import check_level

    for job in jobs:
        if job.rule.name in ("solve", "reference"):
            name, n = job.wildcards.scene, int(job.params.get("n") or job.wildcards.n)
            element = job.params.get("element") or job.wildcards.element
            try:
                check_level(scene(name).problem, element, n, job.params.method)
            except SignoriniError as error:
                sys.exit(f"error: config/scenes/{name}.yaml: {error}")


def parts(*keys):
    """A parameter: the parts of a scene on which a job depends; it runs again when they change and only then."""
    return lambda wildcards: as_json(scene(wildcards.scene).section(*keys))


def reference_note(wildcards):
    """What a table says of a reference that is hardly finer than the finest level; empty where it is fine enough."""
    return scene(wildcards.scene).reference_note or ""


rule scene:
    input:
        library("check"),
        file="config/scenes/{scene}.yaml",
    output:
        "results/{scene}/scene.json",
    log:
        "results/{scene}/logs/scene.log",
    priority: 20
    params:
        content=content("check", lambda wildcards: [f"config/scenes/{wildcards.scene}.yaml"]),
    shell:
        "python3 -m signorini check {input.file:q} --document-only -o {output:q} 2>&1 | tee {log:q}"
