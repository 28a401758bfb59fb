# Helpers of the rules: the configuration, the scenes, and what each job depends on.
import atexit
import hashlib
import json
import os
import re
import shutil
import sys
from contextlib import suppress
from datetime import date
from functools import cache
from pathlib import Path
from shlex import quote

PROJECT = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).parents[1]
if Path.cwd().resolve() != PROJECT.resolve():
    # Every path is relative to the project's folder: to find scenes, and not to tie results to a machine.
    sys.exit(
        "error: start Snakemake in the project's folder: cd {0}, or add --directory {0}".format(
            quote(str(PROJECT))
        )
    )

SOURCE = Path("src")
SCRIPTS = Path("workflow/scripts")
sys.path.insert(0, str(SOURCE.resolve()))
# The python3 of a job is the one that runs Snakemake.
os.environ.update(
    PATH=os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", os.defpath)])
)

from signorini.mesh.boundary import labels_of
from signorini.exceptions import SignoriniError
from signorini.mesh.files import files_read
from signorini.errors.norms import RATED
from signorini.scene.read import check_name, read_scene
from signorini.scene.schema import validated
from signorini.wording import nearest
from signorini.scene.strict_yaml import load_yaml

CONFIG_FILE = "config/config.yaml"
NAME = "[A-Za-z0-9][A-Za-z0-9_-]{0,63}"
PUBLISHED = "config/published/table_5_1.csv"
WITHOUT = [program for program in ("latexmk", "pdflatex") if not shutil.which(program)]
FIGURES = ["figure_5_1", "figure_5_2", "figure_5_3"]


def reported(function):
    """Let a user's mistake end Snakemake with its one line; an exception would add a traceback."""

    def called(*arguments):
        try:
            return function(*arguments)
        except SignoriniError as error:
            sys.exit(f"error: {error}")

    return called


def truth_value(value):
    """Of a value from the command line, where Snakemake reads True and False, but leaves YAML's true and false a text."""
    return value == "true" if value in ("true", "false") else value


@reported
def check_config():
    """config.yaml, read strictly, under what the command line says; each is answerable for its own."""
    schema = load_yaml("workflow/schemas/config.schema.yaml")
    document = validated(load_yaml(CONFIG_FILE), schema, CONFIG_FILE)
    for key, value in config.items():
        document[key] = validated({key: truth_value(value)}, schema, where_asked(key))[key]
    return document


def where_asked(key):
    """Where the value of a key comes from, for messages."""
    if key not in config:
        return CONFIG_FILE
    return "--config" if key in workflow.config_settings.config else "--configfile"


@reported
def check_results():
    """Refuse to start what could not be stored."""
    for folder in map(
        Path, ["results", "results/meshes", *(f"results/{name}" for name in CONFIG["scenes"])]
    ):
        if os.path.lexists(folder) and not (
            folder.is_dir() and os.access(folder, os.W_OK | os.X_OK)
        ):
            raise SignoriniError(
                f"{folder}: not a folder that can be written; make it one, or move it away"
            )


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


def reference_note(wildcards):
    """What a table says of a reference that is hardly finer than the finest level; empty where it is fine enough."""
    return scene(wildcards.scene).reference_note or ""


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
    return digest(map(Path, imported_by(SOURCE / "signorini/scene/statement.py")))


def known_scenes():
    return sorted(path.stem for path in Path("config/scenes").glob("*.yaml"))


@cache
def library(script):
    """The script and every file of the library that it imports, also through others: editing one reruns its jobs."""
    return imported_by(SCRIPTS / script)


@cache
def imported_by(path):
    """A file and all that it imports, also through others, sorted."""
    found, waiting = set(), [path]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        waiting += imported(path)
    return sorted(map(str, found))


@cache
def imported(path):
    """The files that a file's import statements name, and the rooms it names in text, to be imported when used."""
    text = path.read_text(encoding="utf-8")
    names = {match for match in re.findall(r'"(signorini\.[\w.]+)[":]', text)}
    for module, found in re.findall(
        r"^ *from (signorini[\w.]*|stage) import (\([^)]*\)|.*)$", text, re.M
    ):
        names |= {module, *(f"{module}.{name}" for name in re.findall(r"\w+", found))}
    return {file for name in names for file in module_files(name)}


@cache
def module_files(name):
    """The files that importing a module executes: its packages' __init__.py and itself; none if it is no module."""
    parts = name.split(".")
    root = SOURCE if parts[0] == "signorini" else SCRIPTS
    stems = [root.joinpath(*parts[: k + 1]) for k in range(len(parts))]
    files = [file for stem in stems for file in (stem / "__init__.py", stem.with_suffix(".py"))]
    return [file for file in files if file.is_file()]


def content(script, *sources):
    """A parameter: what is in the library files of a script, and in other files or what a function says are the files.

    A source counts as changed when this is, whatever its time stamp says. Snakemake compares no parameter that is a
    function of the job's inputs, so that they are listed again.
    """

    def found(wildcards):
        others = [source(wildcards) if callable(source) else [source] for source in sources]
        digests = map(file_digest, sum(others, library(script)))
        return hashlib.sha256("".join(digests).encode()).hexdigest()

    return found


@cache
def file_digest(path):
    if not os.path.isfile(path):
        return ""  # Snakemake is about to say so
    with open(path, "rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def as_json(value):
    return json.dumps(value, sort_keys=True)


def statement(wildcards):
    """What a discretisation depends on, as JSON: it reruns when this changes and only then."""
    return statement_of(wildcards.scene)


def statement_of(name):
    return as_json(scene(name).statement)


def domain_of(name):
    asked = written(name)
    return asked.section("domain", "boundary") | {"coarsest": asked.levels[0]}


@cache
def mesh_key(name):
    """Scenes with the same domain, boundary and coarsest level have the same mesh."""
    return hashlib.sha256(as_json(domain_of(name)).encode()).hexdigest()[:12]


@cache
def mesh_domain(key):
    """Of the scenes asked for first, so that a broken file elsewhere in config/scenes does no harm."""
    names = dict.fromkeys([*CONFIG["scenes"], *known_scenes()])
    return domain_of(next(name for name in names if mesh_key(name) == key))


def mesh_source(wildcards):
    domain = mesh_domain(wildcards.mesh)["domain"]
    return list(map(str, files_read(domain["file"]))) if domain["kind"] == "mesh" else []


def mesh_file(wildcards):
    return f"results/meshes/{mesh_key(wildcards.scene)}.npz"


def solutions(name):
    asked = scene(name)
    return [
        f"results/{name}/solutions/{element}/n{n}.npz"
        for element in asked.elements
        for n in asked.levels
    ]


def solution_files(wildcards):
    return solutions(wildcards.scene)


def finest(wildcards, element=None):
    asked = scene(wildcards.scene)
    return f"results/{wildcards.scene}/solutions/{element or asked.elements[0]}/n{asked.levels[-1]}.npz"


def finest_of_each(wildcards):
    return [finest(wildcards, element) for element in scene(wildcards.scene).elements]


def reference_file(wildcards):
    """The truth as an input of the errors: a file where it is a reference, none where it is exact."""
    return [f"results/{wildcards.scene}/reference.npz"] * (
        scene(wildcards.scene).truth["kind"] == "reference"
    )


def truth_option(wildcards, input):
    if input.reference:
        return f"--reference {quote(str(input.reference))} {coefficient_option(wildcards)}"
    return f"--statement {quote(statement(wildcards))}"


def coefficient_option(wildcards):
    """The diffusion coefficient, where a norm is weighted with it."""
    document = scene(wildcards.scene).document
    return f"--coefficient {quote(as_json(document['data']['coefficient']))}" * (
        "energy" in document["norms"]
    )


def asked_rows(wildcards):
    """Which rows errors.csv and rates.csv must have, as JSON."""
    return asked_rows_of(wildcards.scene)


def asked_rows_of(name):
    return as_json(scene(name).section("elements", "levels", "norms"))


def expected(wildcards):
    return scene(wildcards.scene).document["expect"]


def in_table(wildcards):
    """Norms that a table or figure shows."""
    return ",".join(scene(wildcards.scene).document["norms"])


def scene_output(name):
    """What one scene asks for; what it does not ask for never enters the job graph."""
    asked = scene(name)
    outputs, paper = asked.document["outputs"], name == "paper"
    files = [f"{output}.csv" for output in ("errors", "rates") if output in outputs]
    files += ["table_5_1.tex" if paper else "table.tex"] if "table" in outputs else []
    files += ["expect.txt"] if "expect" in asked.document else []
    files += [f"vtu/{element}.vtu" for element in asked.elements] if "vtu" in outputs else []
    if "figures" in outputs:
        files += (
            [f"{figure}.{ending}" for figure in FIGURES for ending in ("pdf", "png")]
            if paper
            else ["figures"]
        )
    return solutions(name) + [f"results/{name}/{file}" for file in files]


def shown(wildcards):
    """What the figures of a scene show: the field, and as far as there are any the contact line, errors and slopes."""
    document = scene(wildcards.scene).document
    files = {"field": "field.npz"}
    if "contact" in labels_of(document["boundary"]):
        files |= {"line": "contact_line.csv"}
    if drawn_norms(document):
        files |= {"errors": "errors.csv", "rates": "rates.csv"}
    return {name: f"results/{wildcards.scene}/{file}" for name, file in files.items()}


def drawn_norms(document):
    return (
        [norm for norm in document["norms"] if norm in RATED]
        if "rates" in document["outputs"]
        else []
    )


def figure_options(wildcards):
    """Options of figures.py for what `shown` lists, with the levels and norms to draw and the kind of slope."""
    document = scene(wildcards.scene).document
    options = shown(wildcards)
    if norms := drawn_norms(document):
        asked = scene(wildcards.scene).section("elements", "levels") | {"norms": norms}
        options |= {"asked": as_json(asked), "slope": document["slope"]}
    return " ".join(f"--{name} {quote(value)}" for name, value in options.items())


def paper_output():
    """The check and the PDF, where the scene `paper` is asked for with all that they show."""
    if "paper" not in CONFIG["scenes"] or {"rates", "table", "figures"} - set(
        scene("paper").document["outputs"]
    ):
        return []
    return [
        f"results/paper/{file}"
        for file in ("check.csv", "check.txt", "paper.pdf")[: 2 if WITHOUT else 3]
    ]


def all_scenes():
    return [file for name in known_scenes() for file in scene_output(name)]


def gallery_fields(wildcards):
    return [f"results/{name}/field.npz" for name in known_scenes()]


def gallery_titles(wildcards):
    return as_json({name: scene(name).document["title"] for name in known_scenes()})


def final_output():
    return [file for name in CONFIG["scenes"] for file in scene_output(name)] + paper_output()


def digits_asked():
    """What the scene `paper` asks, and no finer where the stability suite is to be quick."""
    asked = scene("paper").section("elements", "levels", "truth", "norms")
    return asked | (
        {"levels": asked["levels"][:4], "truth": asked["truth"] | {"n": 64}}
        if CONFIG["quick"]
        else {}
    )


def stability_pieces(folder, names):
    return [f"{STABILITY}/{folder}/{name}.csv" for name in names]


def stability_seeds():
    """0 for the fixed seeds; else the number asked for, or today's date as one (20261125), the same all day."""
    seeds = CONFIG["seeds"]
    if seeds == "random":
        seeds = int(date.today().strftime("%Y%m%d"))
        print(f"seeds: {seeds}; --config seeds={seeds} draws them again", file=sys.stderr)
    return 0 if seeds == "fixed" else seeds


def appendix():
    """Fragments of the studies built so far, with their figures: parts of the PDF that no build of the paper waits for."""
    fragments = [
        folder / f"{folder.name}.tex" for folder in sorted(Path("results/studies").glob("*"))
    ]
    return [
        part
        for path in fragments
        if path.is_file()
        for part in (path, *sorted(path.parent.glob("*.pdf")))
    ]


def sensitivity_levels():
    """The levels of the paper's table, or the coarse ones of them."""
    return [n for n in scene("paper").levels if n <= 16 or not CONFIG["quick"]]


def sensitivity_reference():
    return scene("paper").truth["n"] // (4 if CONFIG["quick"] else 1)


def digest(paths):
    return hashlib.sha256(b"".join(path.read_bytes() for path in paths)).hexdigest()


CONFIG = check_config()
check_results()
# Where the studies put what they measure; a quick run does not overwrite a full one.
STUDIES = "results/quick" if CONFIG["quick"] else "results/studies"
