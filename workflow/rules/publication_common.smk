# What the rules of publications ask of scenes.
from signorini.publication.keys import FILES, declared_keys, table_of
from signorini.publication.made import published_of, tables_of, taken_files
from signorini.publication.manuscript import read_manuscript
from signorini.scene.publication import SURFACE, TABLE, names_of
from signorini.scene.read import read_scene


@reported
def publication(name):
    """The section of a scene, for a rule that needs it."""
    section = scene(name).document.get("publication")
    if section is None:
        raise SignoriniError(
            f"config/scenes/{name}.yaml: publication: missing; add it, docs/own-paper.md tells how"
        )
    return section


@reported
def publication_file(name, key):
    """A file that the section of a scene names."""
    section = publication(name)
    if key not in section:
        raise SignoriniError(
            f"config/scenes/{name}.yaml: publication.{key}: missing; name the file"
        )
    return section[key]


def published_file(wildcards):
    return [publication_file(wildcards.scene, "published")]


def published_if_any(wildcards):
    section = publication(wildcards.scene)
    return [section["published"]] if "published" in section else []


@cache
def manuscript_files(name):
    """The manuscript of a scene, and the files of its folder that it takes in."""
    return [str(path) for path in read_manuscript(publication_file(name, "manuscript")).files]


def source_files(wildcards):
    return manuscript_files(wildcards.scene)


def source_if_any(wildcards):
    has_source = "manuscript" in publication(wildcards.scene)
    return manuscript_files(wildcards.scene) if has_source else []


def tables_of_check(wildcards):
    """The tables that hold the numbers to be compared with published ones."""
    asked = scene(wildcards.scene).document
    declared, published = declared_keys(asked), published_of(publication(wildcards.scene))
    return tables_from(wildcards, {table_of(number.key, declared) for number in published})


def tables_of_macros(wildcards):
    return tables_from(wildcards, tables_of(scene(wildcards.scene).document) or ["scene"])


def asked_of_macros(wildcards):
    """The parts of a scene that numbers of a manuscript depend on beside tables."""
    asked = scene(wildcards.scene)
    keys = ["elements", "levels", "norms", "truth", "slope", "quantities"]
    return as_json(asked.section(*keys, *(["sweep"] if "sweep" in asked.document else [])))


def tables_from(wildcards, tables):
    """Files of tables; the scene itself starts no job."""
    wanted = [FILES[table] for table in FILES if table in tables and table != "scene"]
    return [f"results/{wildcards.scene}/{file}" for file in wanted]


@cache
def parts_of(name):
    """What a manuscript takes of the scene's results."""
    publication_file(name, "manuscript")
    return [f"results/{name}/{file}" for file in taken_files(scene(name).document)]


def verdict_if_any(wildcards):
    return ["results/{scene}/check.txt"] * ("published" in publication(wildcards.scene))


def appendix(name):
    """Pages of studies built so far, with their figures: parts of the PDF that no build of it waits for."""
    folders = [Path("results/studies", study) for study in publication(name)["appendix"]]
    return [
        part
        for folder in sorted(folders)
        if (folder / f"{folder.name}.tex").is_file()
        for part in (folder / f"{folder.name}.tex", *sorted(folder.glob("*.pdf")))
    ]


def publication_output(name):
    """The check, the macros and the PDF of a scene, as far as its publication asks for them."""
    section = scene(name).document.get("publication")
    if section is None:
        return []
    files = ["check.csv", "check.txt"] if "published" in section else []
    files += ["macros.tex"]
    files += ["paper.pdf"] if "manuscript" in section and not WITHOUT else []
    return [f"results/{name}/{file}" for file in files]


def named_figures(name):
    """The files of the figures that have a name of their own."""
    names = names_of(scene(name).document)
    return [
        f"{stem}.{ending}"
        for kind, stem in names.items()
        if kind != TABLE
        for ending in ("pdf", "png")
    ]


@cache
def scenes_with_names():
    """Scene -> names of its files. A scene that nobody asks for is read only where it has such names, and may be broken."""
    asked = {name: scene(name) for name in CONFIG["scenes"]}
    for name in set(known_scenes()) - asked.keys():
        path = Path("config/scenes", f"{name}.yaml")
        with suppress(SignoriniError, OSError, UnicodeDecodeError):
            if "names:" in path.read_text(encoding="utf-8"):
                asked[name] = read_scene(path)
    return {name: names_of(found.document) for name, found in sorted(asked.items())}


def stem_pattern(kind):
    """A pattern of the name that each scene gives to files of a kind, in its own folder; of nothing where there are none.

    Looking back at the folder keeps apart what two scenes call by one name.
    """
    named = {scene: names.get(kind, kind) for scene, names in scenes_with_names().items()}
    found = [f"(?<=/{scene}/){stem}" for scene, stem in named.items() if stem != kind]
    return "|".join(found) or "(?!)"


def norm_figures(name):
    """Options of the convergence plots that a scene gives names to: norm, PDF and PNG."""
    names = scenes_with_names()[name]
    return {norm: stem for norm, stem in names.items() if norm in RATED}
