"""The sections of Gmsh's MSH 4.1 that a mesh is made from: entities, nodes, elements.

A file describes geometrical entities (points, curves, surfaces), each known by its dimension and
its number. Entities are in physical groups; nodes and elements come in blocks, one an entity. Each
function reads one section from its numbers, see `msh_numbers`.
"""

import numpy as np

from signorini.exceptions import MeshError

# Element type -> its name and number of nodes.
_ELEMENTS = {15: ("vertex", 1), 1: ("line", 2), 2: ("triangle", 3)}
_OTHER_ELEMENTS = {3: "quad", 4: "tetra", 8: "line3", 9: "triangle6", 10: "quad9", 16: "quad8"}


def read_entities(numbers):
    """(dimension, entity) -> numbers of its physical groups."""
    groups = {}
    for dimension, count in enumerate(numbers.sizes(4)):
        for _ in range(count):
            [entity] = numbers.whole(1)
            groups[dimension, int(entity)] = _physical_groups(numbers, dimension)
    return groups


def read_partitioned_entities(numbers):
    """As `read_entities`: the parts of entities, which have the groups of their parents."""
    groups = {}
    numbers.sizes(1)  # the number of partitions
    [ghosts] = numbers.sizes(1)
    numbers.whole(2 * int(ghosts))
    for dimension, count in enumerate(numbers.sizes(4)):
        for _ in range(count):
            entity, _, _ = numbers.whole(3)  # and its parent, dimension and number
            [partitions] = numbers.sizes(1)
            numbers.whole(int(partitions))
            groups[dimension, int(entity)] = _physical_groups(numbers, dimension)
    return groups


def _physical_groups(numbers, dimension):
    """The groups of an entity, past its extent and what bounds it."""
    numbers.real(3 if dimension == 0 else 6)
    [count] = numbers.sizes(1)
    groups = np.unique(np.abs(numbers.whole(int(count))))
    if dimension > 0:
        [bounding] = numbers.sizes(1)
        numbers.whole(int(bounding))
    return groups.tolist()


def read_nodes(numbers):
    """Numbers of the nodes and their coordinates, shapes (nv,) and (nv, 3).

    Raises
    ------
    MeshError
        If the section is damaged.
    """
    count_of_blocks, total, _, _ = numbers.sizes(4)
    tags, points = [np.zeros(0, dtype=np.int64)], [np.zeros((0, 3))]
    for _ in range(count_of_blocks):
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


def read_elements(numbers):
    """Blocks of elements: (dimension, entity), name of the cells, numbers of their nodes.

    Raises
    ------
    MeshError
        If the section is damaged, or holds other elements than points, lines and triangles.
    """
    count_of_blocks, total, _, _ = numbers.sizes(4)
    blocks = []
    for _ in range(count_of_blocks):
        dimension, entity, element = (int(number) for number in numbers.whole(3))
        [count] = (int(number) for number in numbers.sizes(1))
        if element not in _ELEMENTS:
            name = _OTHER_ELEMENTS.get(element, f"elements of type {element}")
            raise MeshError(
                f"holds {count} {name}; only triangles of three vertices (order 1) are supported"
            )
        name, width = _ELEMENTS[element]
        rows = numbers.sizes(count * (1 + width)).reshape(count, 1 + width)
        blocks.append(((dimension, entity), name, rows[:, 1:]))
    held = sum(len(nodes) for _, _, nodes in blocks)
    if held != total:
        raise MeshError(f"promises {total} elements and holds {held}; write the file anew")
    return blocks
