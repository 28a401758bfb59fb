"""Solutions for other programs: VTU files, which ParaView and meshio read, and series of them."""

import tempfile
from pathlib import Path

import numpy as np

from signorini.fem.contact_facets import contact_facets
from signorini.fem.elements import find_element
from signorini.mesh.boundary import LABELS
from signorini.storage import replacing, write_text

_SERIES = """\
<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">
  <Collection>
{}
  </Collection>
</VTKFile>
"""
_OF_SERIES = '    <DataSet timestep="{}" group="" part="0" file="{}"/>'
_FACET_CORNERS = np.array([[0, 1, 0], [1, 2, 2]])  # of a triangle's facets in the order 01, 12, 02


_ABSENT = {"contact_force": 0.0, "obstacle": np.nan, "binding": 0.0}  # off the contact part


def write_vtu(path, mesh, solution, cells=None):
    """Write a solution as VTU: same solution, same bytes; never half a file.

    Parameters
    ----------
    path : path-like
        Target; replaced in one step if it exists.
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution
    cells : mapping of str to ndarray, optional
        More values of triangles, (nt,) or (nt, 3), by the name that they get in the file: the
        ``coefficient``, the contributions of a certificate.

    Raises
    ------
    StorageError
        If the file cannot be written; the old one is then as it was.

    Notes
    -----
    Cells are the triangles, then the boundary facets as lines. Point data ``u``; for CR, which
    jumps across facets, every triangle has points of its own. Cell data ``gradient`` (3 components,
    on a line that of the triangle behind it) and ``label``: 0 on triangles, 1 on Dirichlet, 2 on
    contact, 3 on Neumann facets. Of contact facets there are ``contact_force``, ``obstacle`` and
    ``binding``, see `contact_facets`; elsewhere these are 0, NaN and 0.
    """
    import meshio

    content = _content(mesh, solution, cells or {})
    folder, name = Path(path).parent, Path(path).name
    with (
        replacing(path, "wb") as stream,
        tempfile.TemporaryDirectory(prefix=f".{name}.", dir=folder) as temporary,
    ):
        part = Path(temporary, "part.vtu")  # meshio writes to a path only
        meshio.write(part, content)
        stream.write(part.read_bytes())


def write_series(path, files):
    """Write a series of VTU files over the levels as PVD, which ParaView plays.

    Parameters
    ----------
    path : path-like
        Ending in ``.pvd``.
    files : mapping of int to str
        Level -> file, relative to the folder of `path`, with ``/`` between folders.

    Raises
    ------
    StorageError
        If the file cannot be written.
    """
    lines = [_OF_SERIES.format(n, file) for n, file in sorted(files.items())]
    write_text(path, _SERIES.format("\n".join(lines)))


def _content(mesh, solution, more):
    """A meshio.Mesh of the triangles and the boundary's lines."""
    import meshio

    element = find_element(solution.element)
    values = element.vertex_values(mesh, solution.u)
    p, t, u = (_continuous if element.continuous else _broken)(mesh, values)
    facets = [mesh.boundary_facets(label) for label in LABELS]
    labels = np.repeat(np.arange(1, len(LABELS) + 1), [f.size for f in facets])
    facets = np.concatenate(facets)
    owners, lines = _boundary(mesh, t, facets)
    gradient = np.zeros((mesh.number_of_triangles, 3))
    gradient[:, :2] = mesh.gradients(values).T
    of_triangles = {"gradient": gradient} | {name: np.asarray(more[name]) for name in more}
    return meshio.Mesh(
        np.append(p, np.zeros((1, p.shape[1])), axis=0).T,  # z = 0
        [("triangle", t.T), ("line", lines.T)],
        point_data={"u": u},
        cell_data={
            **{name: [own, own[owners]] for name, own in of_triangles.items()},
            "label": [np.zeros(len(gradient), labels.dtype), labels],
            **_contact(mesh, solution, facets, len(gradient)),
        },
    )


def _contact(mesh, solution, facets, triangles):
    """What happens on the contact part, as data of triangles, where nothing does, and of lines."""
    found = contact_facets(mesh, solution)
    data = {}
    for name, absent in _ABSENT.items():
        values = np.full(mesh.number_of_facets, absent)
        values[found["facets"]] = found[name]
        data[name] = [np.full(triangles, absent), values[facets]]
    return data


def _continuous(mesh, values):
    """Points, triangles, and values at the points, of a function continuous at the vertices."""
    u = np.empty(mesh.number_of_vertices)
    u[mesh.t] = values
    return mesh.p, mesh.t, u


def _broken(mesh, values):
    """Points, triangles and values at the points, every triangle with three points of its own."""
    t = np.arange(mesh.t.size).reshape(3, -1)
    return mesh.p[:, mesh.t].reshape(2, -1), t, values.ravel()


def _boundary(mesh, t, facets):
    """The triangle behind each boundary facet, and the facet's ends numbered as in `t`."""
    place = np.empty(mesh.number_of_facets, dtype=int)
    # Row k, column j of t2f is facet k of triangle j: flattened, its place is k nt + j.
    place[mesh.t2f] = np.arange(mesh.t2f.size).reshape(3, -1)
    local, owners = np.divmod(place[facets], mesh.number_of_triangles)
    return owners, t[_FACET_CORNERS[:, local], owners]
