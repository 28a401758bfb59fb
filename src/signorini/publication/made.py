"""What a scene makes for a manuscript, and what of it a manuscript takes."""

from signorini.mesh.boundary import labels_of
from signorini.publication.keys import FILES, declared_keys, table_of
from signorini.publication.manuscript import MACROS, read_manuscript
from signorini.publication.published import read_published
from signorini.publication.swept import SWEEP
from signorini.scene.publication import TABLE, names_of

_DRAWN = ("pdf", "png")
_WHOLE = ("scene", "errors", "rates", "check")  # tables whose numbers all become macros


def made_files(document):
    """The files that a scene can make for a manuscript.

    Parameters
    ----------
    document : dict
        A validated scene.

    Returns
    -------
    dict
        Name as the manuscript takes it -> file or folder in the scene's results.

    Examples
    --------
    >>> from signorini import load_scene
    >>> "macros.tex" in made_files(load_scene("config/scenes/paper.yaml").document)
    True
    """
    names = names_of(document)
    found = {MACROS: MACROS}
    if document["truth"]["kind"] != "none" and len(document["levels"]) > 1:
        found[f"{names[TABLE]}.tex"] = f"{names[TABLE]}.tex"
    if SWEEP in document:
        swept = [f"{SWEEP}.{end}" for end in ("tex", *_DRAWN)]
        found |= dict(zip(swept, swept, strict=True))
    drawn = [f"{name}.{end}" for kind, name in names.items() if kind != TABLE for end in _DRAWN]
    found |= dict(zip(drawn, drawn, strict=True))
    return found | {
        f"figures/{name}.{end}": "figures" for name in _figures(document) for end in _DRAWN
    }


def _figures(document):
    """Names of the figures in the folder of that name."""
    yield "solution"
    if "contact" in labels_of(document["boundary"]):
        yield "contact_line"
    if document["truth"]["kind"] != "none" and "rates" in document["outputs"]:
        yield from document["norms"]


def taken_files(document):
    """What a scene's manuscript takes of the scene's results.

    Parameters
    ----------
    document : dict
        A validated scene with a publication.

    Returns
    -------
    list of str
        Files, and perhaps the folder ``figures``; the macros always.
    """
    made = made_files(document)
    taken = read_manuscript(document["publication"]["manuscript"]).others
    names = [entry.found_in(made) for entry in taken]
    return list(dict.fromkeys([MACROS, *(made[name] for name in names if name)]))


def tables_of(document):
    """The tables that the macros of a scene take numbers from.

    Parameters
    ----------
    document : dict
        A validated scene with a publication.

    Returns
    -------
    list of str
        Of `keys.FILES`: those that the manuscript asks for, or without manuscript errors, slopes
        and the check.
    """
    section = document["publication"]
    published = published_of(section)
    declared = declared_keys(document, published)
    if "manuscript" not in section:
        return [
            table for table in ("scene", "errors", "rates", "check") if table in declared.values()
        ]
    uses = read_manuscript(section["manuscript"]).uses
    wanted = {table for use in uses for table in tables_of_use(use, declared)}
    return [table for table in FILES if table in wanted]


def tables_of_use(use, declared):
    """The tables that may hold the number of a use.

    Parameters
    ----------
    use : Use
    declared : dict
        As `keys.declared_keys` returns it.

    Returns
    -------
    set of str
        Of `keys.FILES`; empty where there is no such number.

    Examples
    --------
    >>> from signorini.publication.manuscript import Use
    >>> sorted(tables_of_use(Use("", "l2, CR, 64"), {"l2, CR, 64": "errors"}))
    ['errors']
    """
    if not use.is_open:
        return {table_of(use.key, declared)} - {None}
    return {table for key, table in declared.items() if key.startswith(use.stem)}


def published_of(section):
    """The published numbers of a publication.

    Parameters
    ----------
    section : dict
        The section of that name of a scene.

    Returns
    -------
    list of Published
        Empty where it names no file.

    Raises
    ------
    SceneError, StorageError
        As `read_published`.
    """
    return list(read_published(section["published"]).values()) if "published" in section else []
