# What is built: by the scenes that the configuration asks for, and of each what it asks for itself.
import atexit

PUBLISHED = "config/published/table_5_1.csv"
WITHOUT = [program for program in ("latexmk", "pdflatex") if not shutil.which(program)]
FIGURES = ["figure_5_1", "figure_5_2", "figure_5_3"]


def check_known(place, wildcard, value, names):
    """Refuse a value of a wildcard that is not one of the names, or of those that a function lists."""
    known = names() if callable(names) else names
    if value not in known:
        raise SignoriniError(f"{place}: there is no {wildcard} {value!r}; {nearest(value, known)}")


def paper_scene(wildcards):
    """The scene `paper`, validated."""
    return validated_file("paper")


def of_paper(*keys):
    """A parameter: parts of the scene `paper`."""
    return lambda wildcards: as_json(scene("paper").section(*keys))


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


def all_scenes():
    return [file for name in known_scenes() for file in scene_output(name)]


def final_output():
    return [file for name in CONFIG["scenes"] for file in scene_output(name)] + paper_output()


if WITHOUT and paper_output() and workflow.is_main_process:
    # Snakemake's own onsuccess is silent where there is nothing to do.
    atexit.register(
        print,
        f"results/paper/paper.pdf: not built, for want of {' and '.join(WITHOUT)}. On Debian: apt-get install latexmk"
        " texlive-latex-recommended lmodern",
        file=sys.stderr,
    )
