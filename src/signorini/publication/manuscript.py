r"""A manuscript: the files that it is made of, and the numbers that it asks for by ``\result``.

It is read as text, line by line; comments do not count. What is put together by macros, as in
``\result{l2, CR, #1}``, is left to LaTeX.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

from signorini.exceptions import SceneError
from signorini.publication.keys import tidy
from signorini.storage.files import read_bytes

MACROS = "macros.tex"
_COMMENT = re.compile(r"(?<!\\)((?:\\\\)*)%.*")
_VERBATIM = re.compile(r"\\begin\{(verbatim|lstlisting)\}.*?\\end\{\1\}", re.S)
_RESULT = re.compile(r"\\result(?![A-Za-z])\s*(?:\[([^]]*)\]\s*)?\{([^{}]*)\}")
_BEGUN = re.compile(r"\\result(?![A-Za-z])\s*(?:\[[^]]*\]\s*)?\{")
_BRACE = re.compile(r"\\.|([{}])", re.S)  # what follows a backslash is none
_TAKES = re.compile(
    r"\\(input|include|includegraphics|bibliography|addbibresource|bibliographystyle|usepackage"
    r"|RequirePackage|documentclass|lstinputlisting|verbatiminput)(?![A-Za-z])\*?\s*"
    r"(?:\[[^]]*\]\s*)?\{([^{}]+)\}"
)
_FOLDERS = re.compile(r"\\graphicspath\s*\{((?:\s*\{[^{}]*\})+)\s*\}")
# Command -> endings that it adds to a name without one.
_ENDINGS = {
    "input": (".tex",),
    "include": (".tex",),
    "includegraphics": (".pdf", ".png", ".jpg", ".jpeg"),
    "bibliography": (".bib",),
    "bibliographystyle": (".bst",),
    "usepackage": (".sty",),
    "RequirePackage": (".sty",),
    "documentclass": (".cls",),
}
# Files that only the manuscript's folder or the scene can have, not the distribution of TeX.
_OWN = ("input", "include", "includegraphics", "bibliography", "addbibresource")


@dataclass(frozen=True)
class Use:
    r"""A ``\result`` in a manuscript.

    Parameters
    ----------
    place : str
        File and line.
    key : str
        As `keys.tidy` returns it.
    options : str
        What stands in brackets.
    """

    place: str
    key: str
    options: str = ""

    @property
    def is_open(self):
        """Whether the key is only known when LaTeX runs."""
        return any(sign in self.key for sign in "#\\")

    @property
    def stem(self):
        """What is known of an open key: the words before the first that is open."""
        words = self.key.split(", ")
        first = next(k for k, word in enumerate(words) if set("#\\") & set(word))
        return ", ".join(words[:first])


@dataclass(frozen=True)
class Taken:
    """A file that a manuscript names.

    Parameters
    ----------
    place : str
        File and line.
    command : str
        Of LaTeX, without backslash.
    name : str
        As it stands there.
    folders : tuple of str, optional
        Where LaTeX looks for it, first of all here.
    """

    place: str
    command: str
    name: str
    folders: tuple = ("",)

    @property
    def candidates(self):
        """The names that LaTeX tries, in their order.

        Examples
        --------
        >>> Taken("", "usepackage", "amsmath").candidates
        ['amsmath', 'amsmath.sty']
        """
        endings = ("", *_ENDINGS.get(self.command, ()))
        return [f"{folder}{self.name}{end}" for folder in self.folders for end in endings]

    def found_in(self, names):
        """The first of the names that LaTeX would take.

        Parameters
        ----------
        names : container of str

        Returns
        -------
        str or None

        Examples
        --------
        >>> Taken("", "includegraphics", "figures/l2").found_in({"figures/l2.pdf"})
        'figures/l2.pdf'
        """
        return next((name for name in self.candidates if name in names), None)

    @property
    def is_own(self):
        """Whether the distribution of TeX has hardly such a file.

        Examples
        --------
        >>> Taken("", "input", "macros").is_own, Taken("", "usepackage", "amsmath").is_own
        (True, False)
        """
        return self.command in _OWN


@dataclass(frozen=True)
class Manuscript:
    """A manuscript, read.

    Parameters
    ----------
    path : Path
    files : tuple of Path
        Its own, from its folder: itself first, then what it takes in.
    uses : tuple of Use
    others : tuple of Taken
        What it takes in and its folder does not have.
    taken : tuple of Taken
        All that it takes in.
    """

    path: Path
    files: tuple
    uses: tuple
    others: tuple = field(default=())
    taken: tuple = field(default=())


def read_manuscript(path):
    """Read a manuscript and the files of its folder that it takes in.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Manuscript

    Raises
    ------
    SceneError, StorageError
        Naming the file that cannot be read, or the line of a number whose brace is not closed.
    """
    path = Path(path)
    folder, files, uses, taken, others = path.parent, [path], [], [], []
    waiting, pictures = [path], [""]
    while waiting:
        file = waiting.pop(0)
        text = _plain_text(file)
        uses += _uses(file, text)
        pictures += _picture_folders(text)
        for entry in _takes(file, text, tuple(pictures)):
            taken.append(entry)
            own = _own_file(folder, entry)
            if own is None:
                others.append(entry)
            elif own not in files:
                files.append(own)
                waiting += [own] if own.suffix == ".tex" else []
    return Manuscript(path, tuple(files), tuple(uses), tuple(others), tuple(taken))


def _plain_text(path):
    """The text without comments and listings, its lines kept."""
    try:
        text = read_bytes(path).decode("utf-8")
    except UnicodeDecodeError as error:
        raise SceneError(
            f"{path}: not UTF-8 text ({error.reason} at byte {error.start}); save it as UTF-8"
        ) from None
    text = _COMMENT.sub(r"\1", text)
    return _VERBATIM.sub(lambda found: "\n" * found[0].count("\n"), text)


def _place(path, text, found):
    return f"{path}:{text.count(chr(10), 0, found.start()) + 1}"


def _uses(path, text):
    _refuse_unclosed(path, text)
    for found in _RESULT.finditer(text):
        yield Use(_place(path, text, found), tidy(found[2]), (found[1] or "").strip())


def _refuse_unclosed(path, text):
    """Refuse a number whose brace is never closed: LaTeX tells the end of the file alone."""
    for found in _BEGUN.finditer(text):
        if not _is_closed(text, found.end()):
            raise SceneError(f"{_place(path, text, found)}: {found[0]} is not closed; add a brace")


def _is_closed(text, start):
    """Whether the brace before a place is closed."""
    depth = 1
    for found in _BRACE.finditer(text, start):
        depth += {"{": 1, "}": -1}.get(found[1], 0)
        if depth == 0:
            return True
    return False


def _takes(path, text, pictures):
    """The files that a text names; those whose name a macro puts together are not known."""
    for found in _TAKES.finditer(text):
        for name in map(str.strip, found[2].split(",")):
            if name and not set("#\\") & set(name):
                folders = pictures if found[1] == "includegraphics" else ("",)
                yield Taken(_place(path, text, found), found[1], name, folders)


def _picture_folders(text):
    for found in _FOLDERS.finditer(text):
        yield from re.findall(r"\{\s*([^{}]*?)\s*\}", found[1])


def _own_file(folder, entry):
    """The file in the manuscript's folder that LaTeX takes, or None."""
    files = (folder / name for name in entry.candidates)
    return next((file for file in files if file.is_file() and _is_within(file, folder)), None)


def _is_within(file, folder):
    return file.resolve().is_relative_to(folder.resolve())
