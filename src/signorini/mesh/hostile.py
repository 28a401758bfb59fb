"""Mesh files made to do harm, refused before anything parses them: bombs, reads of other files."""

import contextlib
import re
from xml.etree import ElementTree
from xml.parsers import expat

from signorini.exceptions import MeshError

_XML = (".vtu", ".xdmf", ".xmf", ".xml")
_XDMF = (".xdmf", ".xmf")
_DECLARATION = re.compile(rb"(<|&lt;|&#0*60;|&#x0*3c;)!\s*(DOCTYPE|ENTITY)", re.IGNORECASE)
_INCLUDE = re.compile(rb"^\s*\*\s*INCLUDE\b", re.IGNORECASE | re.MULTILINE)
_PLAIN_NAME = re.compile(r"\w[\w.-]*")


def refuse_hostile(path, content):
    """Refuse declarations of a document type or of entities, and includes of other files.

    Parameters
    ----------
    path : Path
        Its ending tells the format.
    content : bytes
        Of the file.

    Raises
    ------
    MeshError

    Examples
    --------
    >>> from pathlib import Path
    >>> refuse_hostile(Path("mesh.vtu"), b"<!DOCTYPE mesh><VTKFile/>")
    Traceback (most recent call last):
    signorini.exceptions.MeshError: declares a DOCTYPE or ENTITY, which no mesh needs; ...
    """
    suffix = path.suffix.lower()
    if suffix in _XML:
        if _DECLARATION.search(content) or _declares_doctype(content):
            raise MeshError(
                "declares a DOCTYPE or ENTITY, which no mesh needs; remove the declaration"
            )
        hdf5_beside(path, content)
    elif suffix == ".inp" and _INCLUDE.search(content):
        raise MeshError("includes another file; put the whole mesh into one")


def hdf5_beside(path, content):
    """The HDF5 files that an .xdmf may keep its arrays in, under plain names beside it.

    Parameters
    ----------
    path : Path
        For what is no .xdmf there are none.
    content : bytes
        Of the file.

    Returns
    -------
    list of Path
        Those that are there.

    Raises
    ------
    MeshError
        If the file is no XML, or takes data from anywhere else.
    """
    if path.suffix.lower() not in _XDMF:
        return []
    try:
        items = list(ElementTree.fromstring(content).iter("DataItem"))
    except ElementTree.ParseError as error:
        raise MeshError(f"not well-formed XML ({error}); write the file anew") from None
    files = {}
    for item in items:
        form = item.get("Format", "XML")
        name = (item.text or "").split(":")[0].strip()
        plain = _PLAIN_NAME.fullmatch(name) and not (path.parent / name).is_symlink()
        if form != "XML" and not (form == "HDF" and plain):
            raise MeshError(f"takes data from {name[:60]!r}; keep them inline, or in .h5 beside it")
        if form == "HDF":
            files[name] = path.parent / name
    return [file for file in files.values() if file.is_file()]


def _declares_doctype(content):
    """Whether a document type is declared, in any encoding.

    Expat decodes the file. A declaration stands before the first element or nowhere, so the parser
    is stopped at whichever comes first.
    """
    answers = []

    def stop(is_doctype):
        answers.append(is_doctype)
        raise StopIteration

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = lambda *_: stop(True)
    parser.StartElementHandler = lambda *_: stop(False)
    # What else is wrong, meshio will say.
    with contextlib.suppress(expat.ExpatError, StopIteration):
        parser.Parse(content, True)
    return True in answers
