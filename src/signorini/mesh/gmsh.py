"""Gmsh's MSH 4.1, in text or binary, with every physical group of every entity; of these meshio
keeps the first alone.

The format: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format
"""

import re
import warnings

import numpy as np

from signorini.exceptions import MeshError

# Element type -> its name and number of nodes.
_ELEMENTS = {15: ("vertex", 1), 1: ("line", 2), 2: ("triangle", 3)}
_OTHER_ELEMENTS = {3: "quad", 4: "tetra", 8: "line3", 9: "triangle6", 10: "quad9", 16: "quad8"}
_OPENING = re.compile(rb"\s*\$(\w+)[ \t]*\r?\n")
_NAME = re.compile(rb'^\s*(\d+)\s+(-?\d+)\s+"(.*)"\s*$', re.MULTILINE)
_SHORTER = "is shorter than it says; write the file anew"


def sections(content):
    """The sections of a Gmsh file.

    Parameters
    ----------
    content : bytes

    Returns
    -------
    dict of str to bytes
        Name -> what stands between ``$Name`` and ``$EndName``.

    Raises
    ------
    MeshError
        If a section is not closed, or something stands between sections.
    """
    found, position = {}, 0
    while opening := _OPENING.match(content, position):
        name = opening[1].decode()
        end = content.find(b"$End" + opening[1], opening.end())
        if end < 0:
            raise MeshError(f"the section ${name[:40]} is not closed; write the file anew")
        found[name] = content[opening.end() : end]
        position = end + len(b"$End" + opening[1])
    if content[position:].strip():
        raise MeshError("text stands between the sections; write the file anew")
    return found


def version(content):
    """The version that a Gmsh file names, such as ``"4.1"``; empty if it names none."""
    found = re.search(rb"^\s*\$MeshFormat\s+([\d.]+)", content, re.MULTILINE)
    return found[1].decode() if found else ""


def physical_names(content):
    """The names of the physical groups.

    Parameters
    ----------
    content : bytes
        Of a Gmsh file of any version.

    Returns
    -------
    list of (int, int, str)
        Dimension, number and name of each.
    """
    section = re.search(
        rb"^\$PhysicalNames\s*$(.*?)^\$EndPhysicalNames", content, re.MULTILINE | re.DOTALL
    )
    found = _NAME.findall(section[1]) if section else []
    return [
        (int(dimension), int(number), name.decode(errors="replace"))
        for dimension, number, name in found
    ]


def read_msh(content):
    """Read MSH 4.1: also partitioned files, files with parametric nodes, and files with cells in no
    group.

    Parameters
    ----------
    content : bytes

    Returns
    -------
    points : ndarray, shape (nv, 3)
    cells : dict of str to ndarray of int
        ``"line"`` (k, 2) and ``"triangle"`` (nt, 3), vertices counted from 0.
    groups : dict of str to dict of int to ndarray of int
        For each kind of cell the number of each physical group -> its cells. A negative number in
        the file means that the orientation is reversed, and belongs to the same group.

    Raises
    ------
    MeshError
        If the file is damaged, or holds other cells than points, lines and triangles.
    """
    found = sections(content)
    for name in ("MeshFormat", "Nodes", "Elements"):
        if name not in found:
            raise MeshError(f"has no section ${name}; write the file anew")
    numbers = _reader(found["MeshFormat"])
    physical = {}
    if "Entities" in found:
        physical |= _entities(numbers(found["Entities"]))
    if "PartitionedEntities" in found:
        physical |= _partitioned_entities(numbers(found["PartitionedEntities"]))
    tags, points = _nodes(numbers(found["Nodes"]))
    blocks = _elements(numbers(found["Elements"]))
    cells, groups = {}, {}
    for kind, width in (("line", 2), ("triangle", 3)):
        own = [(entity, nodes) for entity, name, nodes in blocks if name == kind]
        nodes = np.concatenate([np.zeros((0, width), dtype=np.int64), *(nodes for _, nodes in own)])
        cells[kind] = _numbered(tags, nodes)
        groups[kind] = _members([(physical.get(entity, ()), len(nodes)) for entity, nodes in own])
    return points, cells, groups


class _Text:
    """Numbers of a section in text, taken in their order."""

    def __init__(self, body):
        self._numbers, self._taken = _parsed(body), 0

    def real(self, count):
        if not 0 <= count <= self._numbers.size - self._taken:
            raise MeshError(f"a section {_SHORTER}")
        self._taken += count
        return self._numbers[self._taken - count : self._taken]

    def whole(self, count):
        numbers = self.real(count)
        if np.all(np.abs(numbers) < 2.0**53):
            whole = numbers.astype(np.int64)
            if np.array_equal(whole, numbers):
                return whole
        raise MeshError("a number that must be whole is not; write the file anew")

    sizes = whole


class _Binary:
    """Numbers of a section in binary, taken in their order."""

    def __init__(self, body, order, width):
        self._body, self._taken, self._order, self._width = body, 0, order, width

    def _take(self, dtype, count):
        size = np.dtype(dtype).itemsize * count
        if not 0 <= size <= len(self._body) - self._taken:
            raise MeshError(f"a section {_SHORTER}")
        self._taken += size
        return np.frombuffer(self._body, dtype, count, self._taken - size)

    def real(self, count):
        return self._take(f"{self._order}f8", count)

    def whole(self, count):
        return self._take(f"{self._order}i4", count).astype(np.int64)

    def sizes(self, count):
        return self._take(f"{self._order}u{self._width}", count).astype(np.int64)


def _parsed(body):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # what is left of a text that cannot be read to its end
        try:
            return np.fromstring(body, sep=" ")
        except (DeprecationWarning, ValueError):
            raise MeshError(
                "a section holds something else than numbers; write the file anew"
            ) from None


def _reader(header):
    """What makes the reader of a section, by the section ``$MeshFormat``."""
    line, _, rest = header.partition(b"\n")
    fields = line.split()
    if len(fields) != 3 or fields[1] not in (b"0", b"1") or fields[2] not in (b"4", b"8"):
        raise MeshError("its $MeshFormat is damaged; write the file anew")
    if fields[1] == b"0":
        return _Text
    one = rest[:4]
    if one not in (b"\1\0\0\0", b"\0\0\0\1"):
        raise MeshError("its $MeshFormat is damaged; write the file anew")
    order = "<" if one[0] else ">"
    return lambda body: _Binary(body, order, int(fields[2]))


def _entities(numbers):
    """(dimension, entity) -> numbers of its physical groups."""
    found = {}
    for dimension, count in enumerate(numbers.sizes(4)):
        for _ in range(count):
            [entity] = numbers.whole(1)
            found[dimension, int(entity)] = _physical(numbers, dimension)
    return found


def _partitioned_entities(numbers):
    """As `_entities`: the parts of entities, which have the groups of their parents."""
    found = {}
    numbers.sizes(1)
    [ghosts] = numbers.sizes(1)
    numbers.whole(2 * int(ghosts))
    for dimension, count in enumerate(numbers.sizes(4)):
        for _ in range(count):
            entity, _, _ = numbers.whole(3)
            [partitions] = numbers.sizes(1)
            numbers.whole(int(partitions))
            found[dimension, int(entity)] = _physical(numbers, dimension)
    return found


def _physical(numbers, dimension):
    """The groups of an entity, past its extent and what bounds it."""
    numbers.real(3 if dimension == 0 else 6)
    [count] = numbers.sizes(1)
    groups = np.unique(np.abs(numbers.whole(int(count))))
    if dimension > 0:
        [bounding] = numbers.sizes(1)
        numbers.whole(int(bounding))
    return groups.tolist()


def _nodes(numbers):
    """Numbers of the nodes and their coordinates, shapes (nv,) and (nv, 3)."""
    blocks, total, _, _ = numbers.sizes(4)
    tags, points = [np.zeros(0, dtype=np.int64)], [np.zeros((0, 3))]
    for _ in range(blocks):
        dimension, _, parametric = numbers.whole(3)
        [count] = numbers.sizes(1)
        # Beside x, y, z there may be the node's parameters on its curve or surface.
        width = 3 + (int(dimension) if parametric else 0)
        if not 3 <= width <= 6:
            raise MeshError(f"nodes of dimension {dimension}; write the file anew")
        tags.append(numbers.sizes(int(count)))
        points.append(numbers.real(width * int(count)).reshape(-1, width)[:, :3])
    tags, points = np.concatenate(tags), np.concatenate(points)
    if len(tags) != total:
        raise MeshError(f"promises {total} nodes and holds {len(tags)}; write the file anew")
    return tags, points


def _elements(numbers):
    """Blocks of elements: (dimension, entity), kind of the cells, numbers of their nodes."""
    blocks, total, _, _ = numbers.sizes(4)
    found = []
    for _ in range(blocks):
        dimension, entity, element = (int(number) for number in numbers.whole(3))
        [count] = (int(number) for number in numbers.sizes(1))
        if element not in _ELEMENTS:
            kind = _OTHER_ELEMENTS.get(element, f"elements of type {element}")
            raise MeshError(
                f"holds {count} {kind}; only triangles of three vertices (order 1) are supported"
            )
        kind, width = _ELEMENTS[element]
        rows = numbers.sizes(count * (1 + width)).reshape(count, 1 + width)
        found.append(((dimension, entity), kind, rows[:, 1:]))
    held = sum(len(nodes) for _, _, nodes in found)
    if held != total:
        raise MeshError(f"promises {total} elements and holds {held}; write the file anew")
    return found


def _numbered(tags, nodes):
    """Positions of the nodes in the file, from their numbers, which may be sparse and in any order."""
    order = np.argsort(tags, kind="stable")
    place = np.searchsorted(tags[order], nodes)
    known = place < len(tags)
    known[known] = tags[order[place[known]]] == nodes[known]
    if not known.all():
        raise MeshError(
            f"an element uses node {nodes[~known][0]}, which the file does not have; write the file anew"
        )
    return order[place]


def _members(blocks):
    """Group -> its cells, from the groups and the number of cells of each block."""
    found, start = {}, 0
    for groups, count in blocks:
        for group in groups:
            found.setdefault(group, []).append(np.arange(start, start + count))
        start += count
    return {group: np.concatenate(parts) for group, parts in sorted(found.items())}
