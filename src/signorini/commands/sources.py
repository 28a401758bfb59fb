"""Which files of the library a command can load, found from the syntax trees of those files.

A workflow makes them inputs of its jobs, so that an edit of any of them runs those jobs again. An
import counts wherever it stands, also within a function. So does a text that is the full name of a
module, alone or before a colon: modules that are loaded by name, as routes and rivals are, stand in
a table of such texts. So does a text that names a template of a page.
"""

import ast
import hashlib
import re
from functools import cache
from pathlib import Path

from signorini.commands.catalogue import module_of

PACKAGE = "signorini"
_ROOT = Path(__file__).parents[1]
# Jobs read the validated scene: no command but those named here reads a scene's own file.
_READER, _READERS = f"{PACKAGE}.scene.read", ("check", "scenes", "new", "sweep", "sweep-points")
# A text that is the name of a module, alone or before a colon.
_MODULE = re.compile(rf'"({PACKAGE}(?:\.\w+)+)[":]')
# What every command passes through.
_PROGRAM = (f"{PACKAGE}.__main__", f"{PACKAGE}.commands.program")


@cache
def sources(command):
    """The files of the library that a command can load.

    Parameters
    ----------
    command : str
        One of `catalogue.commands`.

    Returns
    -------
    tuple of Path
        Sorted; absolute.
    """
    return modules_from(module_of(command), *_PROGRAM, reader=command in _READERS)


@cache
def modules_from(*names, reader=False):
    """The files that modules can load, their own included.

    Parameters
    ----------
    *names : str
        Full names of modules.
    reader : bool
        Whether the module that reads scene files counts where another names it.

    Returns
    -------
    tuple of Path
        Sorted; absolute.
    """
    loaded = set()
    waiting = [file for name in names for file in _executed(name)]
    left_out = () if reader else _executed(_READER)[-1:]
    while waiting:
        path = waiting.pop()
        if path not in loaded and path not in left_out:
            loaded.add(path)
            waiting += _named(path)
    return tuple(sorted(loaded))


@cache
def content_of(command):
    """A digest of what is in the files that a command can load; finding them takes a moment.

    Parameters
    ----------
    command : str
        One of `catalogue.commands`.

    Returns
    -------
    str
    """
    digests = (hashlib.sha256(path.read_bytes()).hexdigest() for path in sources(command))
    return hashlib.sha256("".join(digests).encode()).hexdigest()


@cache
def _named(path):
    """The files that executing a file, or any function of it, may load."""
    text = path.read_text(encoding="utf-8")
    templates = {_ROOT / name for name in re.findall(r'"([\w/]+\.\w+\.j2)"', text)}
    if path.suffix == ".j2":
        return templates
    names = set(_MODULE.findall(text))
    for node in _statements(ast.parse(text).body):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return templates | {file for name in names for file in _executed(name)}


def _statements(body):
    """All statements, those within others included; expressions hold no import."""
    for node in body:
        yield node
        for part in ("body", "orelse", "finalbody", "handlers", "cases"):
            yield from _statements(getattr(node, part, ()))


@cache
def _executed(name):
    """The files that importing a module executes: its packages' __init__.py, and its own."""
    parts = name.split(".")
    if parts[0] != PACKAGE or not all(part.isidentifier() for part in parts):
        return ()
    files = []
    for count in range(1, len(parts) + 1):
        stem = _ROOT.joinpath(*parts[1:count])
        files += [stem / "__init__.py", stem.with_suffix(".py")]
    return tuple(file for file in files if file.is_file())
