# What is built: by the scenes that the configuration asks for, and of each what it asks for itself.
import atexit

from snakemake.logging import logger

# A report is of what is built: Snakemake refuses one with a file that is not there.
REPORTING = any(word.partition("=")[0] == "--report" for word in sys.argv)
WITHOUT = [program for program in ("latexmk", "pdflatex") if not shutil.which(program)]


def check_known(place, wildcard, value, names):
    """Refuse a value of a wildcard that is not one of the names, or of those that a function lists."""
    known = names() if callable(names) else names
    if value not in known:
        raise SignoriniError(f"{place}: there is no {wildcard} {value!r}; {nearest(value, known)}")


def scene_output(name):
    """What one scene asks for; what it does not ask for never enters the job graph."""
    asked = scene(name)
    outputs = asked.document["outputs"]
    files = [f"{output}.csv" for output in ("errors", "rates", "steps") if output in outputs]
    if "table" in outputs and asked.truth["kind"] != "certificate":
        files += [f"{names_of(asked.document)[TABLE]}.tex"]
    files += ["certificates.csv"] if is_certified(asked.document) else []
    files += ["outputs.csv"] if asked.document["quantities"] else []
    files += ["expect.txt"] if "expect" in asked.document else []
    endings = ("vtu", "pvd") if "vtu" in outputs else ()
    files += [f"vtu/{element}.{ending}" for element in asked.elements for ending in endings]
    files += ["details"] if "details" in outputs else []
    files += ["viewer.html"] if "viewer" in outputs else []
    files += (named_figures(name) or ["figures"]) if "figures" in outputs else []
    built = [f"results/{name}/{file}" for file in files]
    return solutions(name) + built + sweep_output(name)


def all_scenes():
    return [file for name in known_scenes() for file in scene_output(name)]


def final_output():
    files = [
        file for name in CONFIG["scenes"] for file in scene_output(name) + publication_output(name)
    ]
    return list(filter(os.path.exists, files)) if REPORTING else files


def files_of(name):
    """What a scene makes, below its folder; the many solutions last."""
    files = scene_output(name) + publication_output(name)
    return [file.removeprefix(f"results/{name}/") for file in sorted(files, key=is_solution)]


def is_solution(file):
    return "/solutions/" in file


def rule_names():
    """The rules that an argument may name: as a target those without wildcards."""
    told_aside = {"--until", "-U", "--omit-from", "-O", "--forcerun", "-R"} & set(sys.argv)
    rules = [rule for rule in workflow.rules if told_aside or not rule.has_wildcards()]
    return sorted(rule.name for rule in rules if rule.name != "default")


def instead_of(target):
    """What to type in place of a target that no rule makes."""
    path = Path(target)
    if path.is_relative_to(PROJECT):
        return f"name it from the project's folder: {path.relative_to(PROJECT)}"
    in_results = path.parts[:1] == ("results",)
    name, *below = path.parts[in_results:] or ("",)
    if name in known_scenes() and not below:
        return f"a scene is built by snakemake --cores 2 --config 'scenes=[{name}]'"
    if not (in_results and below):
        return nearest(target, rule_names())
    if name in known_scenes():
        return nearest("/".join(below), files_of(name))
    if name in ("studies", "quick"):
        return nearest(below[0], rule_names())
    return f"there is no scene {name}; {nearest(name, known_scenes())}"


# What Snakemake says of a target -> what follows, of the words that it names.
REMEDIES = {
    r"to produce (.+) \(if you use": lambda target: f"{target}: {instead_of(target)}",
    r"(Target rules) may not contain wildcards": lambda _: (
        "what makes files of any scene is no target: name a file, such as results/NAME/errors.csv, or ask for a scene,"
        " --config 'scenes=[NAME]'"
    ),
}


def add_remedy(record):
    """Say below what Snakemake says of a wrong target what to type in its place."""
    for said, remedy in REMEDIES.items():
        found = re.search(said, str(record.msg))
        if found:
            record.msg = f"{record.msg}\nerror: {remedy(found[1])}"
    return True


if workflow.is_main_process:
    logger.addFilter(add_remedy)


def untypeset():
    """The PDF files that are asked for and cannot be made, for want of LaTeX."""
    return [
        f"results/{name}/paper.pdf"
        for name in CONFIG["scenes"]
        if WITHOUT and "manuscript" in scene(name).document.get("publication", {})
    ]


if workflow.is_main_process:
    tell_sweeps(CONFIG["scenes"])

if workflow.is_main_process and untypeset():
    # Snakemake's own onsuccess is silent where there is nothing to do.
    atexit.register(
        print,
        f"{', '.join(untypeset())}: not built, for want of {' and '.join(WITHOUT)}. On Debian: apt-get install latexmk"
        " texlive-latex-recommended lmodern",
        file=sys.stderr,
    )
