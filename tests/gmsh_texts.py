"""Gmsh's MSH 4.1 in all its forms: one mesh, in text and in binary."""

import struct

from mesh_texts import GMSH_NODES

# The unit square in two triangles, as Gmsh 4.1 writes it. The bottom is in groups 1 and 2, the
# right side in 2, reversed, the rest in 3; both triangles are in 4, one of them also in 5.
HEADER = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"


NAMES = """$PhysicalNames
4
1 1 "bottom"
1 2 "lower right"
1 3 "body"
2 4 "body"
$EndPhysicalNames
"""


ENTITIES = """$Entities
1 4 2 0
1 0 0 0 0
1 0 0 0 1 0 0 2 1 2 2 1 -2
2 1 0 0 1 1 0 1 -2 2 2 -3
3 0 1 0 1 1 0 1 3 2 3 -4
4 0 0 0 0 1 0 1 3 2 4 -1
1 0 0 0 1 1 0 1 4 3 1 2 5
2 0 0 0 1 1 0 2 4 5 3 -5 3 4
$EndEntities
"""


BLOCKS = [
    (0, 1, [1]),
    (1, 1, [1, 2]),
    (1, 2, [2, 3]),
    (1, 3, [3, 4]),
    (1, 4, [4, 1]),
    (2, 1, [1, 2, 3]),
    (2, 2, [1, 3, 4]),
]


KINDS = {1: 15, 2: 1, 3: 2}  # number of corners -> Gmsh's type of element


def elements(parts=None, numbers=None):
    """The section of the elements; `parts` are other tags of entities, `numbers` other numbers of
    nodes.
    """
    parts, numbers = parts or {}, numbers or {}
    lines = ["$Elements", "7 7 1 7"]
    for k, (dimension, tag, corners) in enumerate(BLOCKS):
        lines.append(f"{dimension} {parts.get((dimension, tag), tag)} {KINDS[len(corners)]} 1")
        lines.append(
            " ".join(map(str, [k + 1, *(numbers.get(corner, corner) for corner in corners)]))
        )
    return "\n".join([*lines, "$EndElements", ""])


ELEMENTS = elements()


PARTITIONED = """$PartitionedEntities
2
1
9 1
0 2 1 0
11 1 1 1 1 0 0 0 1 0 0 2 1 -2 2 1 -4
12 1 2 2 1 2 1 0 0 1 1 0 1 2 2 2 -3
7 2 1 1 2 0 0 0 1 1 0 1 4 3 1 2 5
$EndPartitionedEntities
"""


PARAMETRIC = GMSH_NODES.replace("2 1 0 4", "2 1 1 4").replace(
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", "0 0 0 7 7\n1 0 0 7 7\n1 1 0 7 7\n0 1 0 7 7\n"
)


SPARSE = GMSH_NODES.replace("\n1\n2\n3\n4\n", "\n4000000000\n2\n3\n4\n")


def text(entities=ENTITIES, nodes=GMSH_NODES, elements=ELEMENTS, names=NAMES):
    """The file in text."""
    return HEADER + names + entities + nodes + elements


def binary(order, size, point=()):
    """The same mesh in binary, packed number by number: the order of bytes, and the width of Gmsh's
    size_t.
    """
    word = {4: "I", 8: "Q"}[size]

    def packed(layout, *numbers):
        return struct.pack(order + layout.replace("s", word), *numbers)

    def entity(tag, box, groups, bounding=None):
        bounds = (
            []
            if bounding is None
            else [packed("s", len(bounding)), packed(f"{len(bounding)}i", *bounding)]
        )
        head = packed("i", tag) + packed(f"{len(box)}d", *box)
        return (
            head + packed("s", len(groups)) + packed(f"{len(groups)}i", *groups) + b"".join(bounds)
        )

    box = (0, 0, 0, 1, 1, 0)
    entities = [
        packed("4s", 1, 4, 2, 0),
        entity(1, (0, 0, 0), point),
        *(entity(k + 1, box, groups, [1, -2]) for k, groups in enumerate([[1, 2], [-2], [3], [3]])),
        *(entity(k + 1, box, groups, [1, 2, 5]) for k, groups in enumerate([[4], [4, 5]])),
    ]
    nodes = [
        packed("4s", 1, 4, 1, 4) + packed("3i", 2, 1, 0) + packed("s", 4),
        packed("4s", 1, 2, 3, 4),
        packed("12d", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
    ]
    cells = [packed("4s", 7, 7, 1, 7)]
    for k, (dimension, tag, corners) in enumerate(BLOCKS):
        cells.append(packed("3i", dimension, tag, KINDS[len(corners)]) + packed("s", 1))
        cells.append(packed(f"{1 + len(corners)}s", k + 1, *corners))
    body = {"Entities": entities, "Nodes": nodes, "Elements": cells}
    content = (
        b"$MeshFormat\n4.1 1 %d\n" % size + packed("i", 1) + b"\n$EndMeshFormat\n" + NAMES.encode()
    )
    for name, parts in body.items():
        content += b"$%s\n%s\n$End%s\n" % (name.encode(), b"".join(parts), name.encode())
    return content


VARIANTS = {
    "text": text(),
    "partitioned": text(
        ENTITIES + PARTITIONED, elements=elements({(1, 1): 11, (1, 2): 12, (2, 1): 7})
    ),
    "parametric nodes": text(nodes=PARAMETRIC),
    "sparse node numbers": text(nodes=SPARSE, elements=elements(numbers={1: 4 * 10**9})),
    "Windows line ends": text().replace("\n", "\r\n"),
    "comments": "$Comments\n$Nodes are below\n$EndComments\n" + text(),
    "binary": binary("<", 8),
    "binary, other order of bytes": binary(">", 8),
    "binary, 32 bits": binary("<", 4),
}
