"""Texts of mesh files, whole ones and templates, and the message with which one is refused."""

import numpy as np
import pytest

from signorini.exceptions import MeshError
from signorini.mesh.imported import read_mesh
from signorini.mesh.patterns import alternating

SQUARE = alternating(3, 3, (0, 0), (3, 3))
NUMBERS = {"bottom": 1, "right": 2, "top": 3, "left": 4}

# The corners of the unit square, as Gmsh 4.1 writes them.
GMSH_NODES = """$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
"""


def gmsh(p=SQUARE.p.T, t=SQUARE.t.T, lines=None, names=True, nodes=None):
    """The text of a Gmsh 2.2 file; `lines` are triples of two vertices and a physical group."""
    if lines is None:
        lines = [(a, b, NUMBERS[side]) for side, ends in SQUARE.parts.items() for a, b in ends.T]
    cells = [f"1 2 {tag} {tag} {a + 1} {b + 1}" for a, b, tag in lines]
    cells += [f"2 2 9 1 {a + 1} {b + 1} {c + 1}" for a, b, c in t]
    titles = [f'1 {tag} "{side}"' for side, tag in NUMBERS.items()] + ['2 9 "plate"']
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
        + (["$PhysicalNames", str(len(titles)), *titles, "$EndPhysicalNames"] if names else [])
        + [
            "$Nodes",
            str(nodes or len(p)),
            *(f"{k + 1} {x!r} {y!r} 0" for k, (x, y) in enumerate(np.asarray(p).tolist())),
        ]
        + [
            "$EndNodes",
            "$Elements",
            str(len(cells)),
            *(f"{k + 1} {cell}" for k, cell in enumerate(cells)),
        ]
        + ["$EndElements", ""]
    )


# The unit square in two triangles, as Gmsh 4.1 writes it; its right side is in two physical groups.
GMSH41 = f"""$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "base"
1 2 "rest"
1 3 "wall"
2 4 "plate"
$EndPhysicalNames
$Entities
0 4 1 0
1 0 0 0 1 0 0 1 1 0
2 1 0 0 1 1 0 2 2 3 0
3 0 1 0 1 1 0 1 2 0
4 0 0 0 0 1 0 1 2 0
1 0 0 0 1 1 0 1 4 4 1 2 3 4
$EndEntities
{GMSH_NODES}$Elements
5 6 1 6
1 1 1 1
1 1 2
1 2 1 1
2 2 3
1 3 1 1
3 3 4
1 4 1 1
4 4 1
2 1 2 2
5 1 2 3
6 1 3 4
$EndElements
"""


VTU = """<?xml version="1.0"?>{doctype}
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" {options}>
<UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1"><Points>
<DataArray type="Float64" NumberOfComponents="3" format="{format}" offset="0">{points}</DataArray>
</Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="Int64" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid>
{appended}</VTKFile>
"""


def vtu(points="0 0 0 1 0 0 0 1 0", doctype="", options="", format="ascii", appended=""):
    return VTU.format(
        points=points, doctype=doctype, options=options, format=format, appended=appended
    )


def refusal(path, groups=None):
    """The message with which a file is refused.

    It is one line that starts with the file's name or the section.
    """
    with pytest.raises(MeshError) as caught:
        read_mesh(
            path,
            groups
            or {"bottom": "contact", "top": "dirichlet", "left": "neumann", "right": "neumann"},
        )
    message = str(caught.value)
    assert message.startswith((f"{path.name}: ", "boundary: "))
    assert "\n" not in message
    assert len(message) < 600
    return message


# An .xdmf: the format of its points, and where or what they are.
XDMF = (
    '<Xdmf Version="3.0"><Domain><Grid><Geometry Type="XY">'
    '<DataItem Dimensions="3 2" Format="{}">{}</DataItem>'
    "</Geometry></Grid></Domain></Xdmf>"
)
