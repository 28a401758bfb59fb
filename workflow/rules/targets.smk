# What is built: by the scenes that the configuration asks for, and of each what it asks for itself.
import atexit

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
