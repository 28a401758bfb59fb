"""Gmsh's MSH 4.1, text or binary, with every group of every entity: meshio keeps but the first.

The format: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format
"""

import re

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh import msh_sections
from signorini.mesh.msh_numbers import numbers_by_format

_OPENING = re.compile(rb"\s*\$(\w+)[ \t]*\r?\n")
_NAME = re.compile(rb'^\s*(\d+)\s+(-?\d+)\s+"(.*)"\s*$', re.MULTILINE)
_VERSION = re.compile(rb"^\s*\$MeshFormat\s+([\d.]+)", re.MULTILINE)
_NAMES = re.compile(rb"^\$PhysicalNames\s*$(.*?)^\$EndPhysicalNames", re.MULTILINE | re.DOTALL)


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

    Examples
    --------
    >>> sections(b"$MeshFormat\\n4.1 0 8\\n$EndMeshFormat\\n")
    {'MeshFormat': b'4.1 0 8\\n'}
    """
    bodies, position = {}, 0
    while opening := _OPENING.match(content, position):
        name = opening[1].decode()
        closing = b"$End" + opening[1]
        end = content.find(closing, opening.end())
        if end < 0:
            raise MeshError(f"the section ${name[:40]} is not closed; write the file anew")
        bodies[name] = content[opening.end() : end]
        position = end + len(closing)
    if content[position:].strip():
        raise MeshError("text stands between the sections; write the file anew")
    return bodies


def version(content):
    """The version that a Gmsh file names, such as ``"4.1"``; empty if it names none."""
    match = _VERSION.search(content)
    return match[1].decode() if match else ""


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
    section = _NAMES.search(content)
    rows = _NAME.findall(section[1]) if section else []
    return [
        (int(dimension), int(number), name.decode(errors="replace"))
        for dimension, number, name in rows
    ]


def read_msh(content):
    """Read MSH 4.1, be it partitioned, with parametric nodes, or with cells in no group.

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
    bodies = sections(content)
    for name in ("MeshFormat", "Nodes", "Elements"):
        if name not in bodies:
            raise MeshError(f"has no section ${name}; write the file anew")
    numbers = numbers_by_format(bodies["MeshFormat"])
    physical = _physical_groups(bodies, numbers)
    tags, points = msh_sections.read_nodes(numbers(bodies["Nodes"]))
    blocks = msh_sections.read_elements(numbers(bodies["Elements"]))
    cells, groups = {}, {}
    for kind, width in (("line", 2), ("triangle", 3)):
        own = [(entity, nodes) for entity, name, nodes in blocks if name == kind]
        nodes = np.concatenate([np.zeros((0, width), dtype=np.int64), *(nodes for _, nodes in own)])
        cells[kind] = _positions(tags, nodes)
        groups[kind] = _members([(physical.get(entity, ()), len(nodes)) for entity, nodes in own])
    return points, cells, groups


def _physical_groups(bodies, numbers):
    """(dimension, entity) -> numbers of its physical groups, from the sections that have them."""
    groups = {}
    if "Entities" in bodies:
        groups |= msh_sections.read_entities(numbers(bodies["Entities"]))
    if "PartitionedEntities" in bodies:
        body = bodies["PartitionedEntities"]
        groups |= msh_sections.read_partitioned_entities(numbers(body))
    return groups


def _positions(tags, nodes):
    """Positions of the nodes in the file, from their numbers, sparse and in any order."""
    order = np.argsort(tags, kind="stable")
    place = np.searchsorted(tags[order], nodes)
    known = place < len(tags)
    known[known] = tags[order[place[known]]] == nodes[known]
    if not known.all():
        raise MeshError(
            f"an element uses node {nodes[~known][0]}, which the file does not have; "
            "write the file anew"
        )
    return order[place]


def _members(blocks):
    """Group -> its cells, from the groups and the number of cells of each block."""
    cells, start = {}, 0
    for groups, count in blocks:
        for group in groups:
            cells.setdefault(group, []).append(np.arange(start, start + count))
        start += count
    return {group: np.concatenate(parts) for group, parts in sorted(cells.items())}
