"""What a codechecker starts from: ``codecheck.yml``, by the specification 1.0 of CODECHECK.

Who checked, when, in which report and with which certificate is for the codechecker to add.
"""

import re
from pathlib import PurePosixPath

from signorini.exceptions import StorageError
from signorini.publication.compare import verdict

VERSION = "https://codecheck.org.uk/spec/config/1.0/"
OPEN = ("codechecker", "report", "check_time", "certificate")
_HEAD = "%YAML 1.1\n# Written by `signorini codecheck`; open, for the codechecker: {}.\n---\n"
_NUMBERED = re.compile(r"(table|figure)_(\d+(?:_\d+)*)")
_SHOWN = {
    "table": "errors and slopes",
    "surface": "the reference solution as a surface",
}
_NORMS = {"l2": "the L2 norm", "h1": "the full H1 norm", "h1_semi": "the H1 seminorm"}
_ALWAYS = {
    "errors.csv": "errors of all levels, with all digits",
    "rates.csv": "slopes of the errors",
    "check.csv": "each published number beside the computed one",
    "check.txt": "how many published numbers are met",
}


def manifest(document, folder):
    """The files that must come out again.

    Parameters
    ----------
    document : dict
        A scene, as its schema has it.
    folder : str
        Where its results are, relative to ``codecheck.yml``.

    Returns
    -------
    list of dict
        ``file`` and ``comment``.

    Examples
    --------
    >>> scene = {"publication": {"names": {"surface": "figure_5_1"}}}
    >>> manifest(scene, "results/paper")[0]["comment"]
    'Figure 5.1: the reference solution as a surface'
    """
    publication = document["publication"]
    names = publication.get("names", {})
    comments = {}
    for kind, name in names.items():
        ending = "tex" if kind == "table" else "pdf"
        comments[f"{name}.{ending}"] = _comment(kind, name)
    comments |= _ALWAYS
    if "manuscript" in publication:
        comments["paper.pdf"] = "the article, with these numbers, tables and figures"
    return [
        {"file": str(PurePosixPath(folder, name)), "comment": comment}
        for name, comment in comments.items()
    ]


def _comment(kind, name):
    shown = _SHOWN.get(kind, f"errors in {_NORMS.get(kind, kind)} against mesh width")
    numbered = _NUMBERED.fullmatch(name)
    if not numbered:
        return shown
    word, number = numbered.groups()
    return f"{word.capitalize()} {number.replace('_', '.')}: {shown}"


def article(citation, source):
    """Title, authors and reference of the article in a citation file.

    Parameters
    ----------
    citation : dict
        The content of ``CITATION.cff``.
    source : path-like
        The file to name in errors.

    Returns
    -------
    dict

    Raises
    ------
    StorageError
        If it names no article with title and authors.
    """
    references = citation.get("references") if isinstance(citation, dict) else None
    articles = [each for each in references or [] if each.get("type") == "article"]
    if not articles or not {"title", "authors"} <= articles[0].keys():
        raise StorageError(
            f"{source}: references: no article with title and authors; add the one that is checked"
        )
    found = articles[0]
    names = [_name(author) for author in found["authors"]]
    parts = {"title": found["title"], "authors": [{"name": name} for name in names]}
    reference = found.get("doi") and f"https://doi.org/{found['doi']}"
    return parts | {"reference": reference or _printed(found)}


def _name(author):
    given, family = author.get("given-names", ""), author.get("family-names", "")
    return f"{given} {family}".strip() or author.get("name", "")


def _printed(found):
    """Where an article without a DOI is printed, and what its notes say of that."""
    pages = "-".join(str(found[key]) for key in ("start", "end") if key in found)
    year = f"({found['year']})" if "year" in found else ""
    place = " ".join(filter(None, (found.get("journal"), found.get("volume"), year, pages)))
    return ". ".join(filter(None, (place, found.get("notes"))))


def codecheck_text(document, rows, citation, folder, source="CITATION.cff"):
    """The text of ``codecheck.yml``.

    Parameters
    ----------
    document : dict
        A scene that names published numbers.
    rows : sequence of mapping
        Of its ``check.csv``.
    citation : dict
        The content of ``CITATION.cff``.
    folder : str
        Where the scene's results are, relative to ``codecheck.yml``.
    source : path-like
        The citation file to name in errors.

    Returns
    -------
    str

    Raises
    ------
    SignoriniError
        If a published number is not met, or the citation names no article.
    """
    import yaml

    found = verdict(rows, f"{folder}/check.csv")
    parts = {
        "version": VERSION,
        "manifest": manifest(document, folder),
        "paper": article(citation, source),
        "summary": f"What the build itself found, before any codechecker: {found}",
    }
    body = yaml.safe_dump(parts, sort_keys=False, allow_unicode=True, width=100)
    return _HEAD.format(", ".join(OPEN)) + body
