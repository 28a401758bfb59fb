"""Uniform refinement undone: the mesh that a mesh was refined from, where its numbers show one.

They do where it was refined by scikit-fem or by this library, both of which number alike; see
`refinement`. Multigrid then has levels also on a mesh that came without its history.
"""

import numpy as np

from signorini.mesh.facets import pair_keys
from signorini.mesh.named_mesh import NamedMesh


def coarsest(mesh):
    """The mesh that a mesh was refined from, uniformly.

    Parameters
    ----------
    mesh : NamedMesh

    Returns
    -------
    root : NamedMesh
        `mesh` itself where nothing shows that it was refined. Refined, it has the vertices and
        facets of `mesh` by the same numbers, and its triangles, perhaps by others.
    times : int
        How many times it was.

    Examples
    --------
    >>> from skfem import MeshTri
    >>> from signorini.mesh.given import from_skfem
    >>> root, times = coarsest(from_skfem(MeshTri().refined(3)))
    >>> root.t.shape[1], times
    (2, 3)
    """
    times, coarser = 0, _parent(mesh)
    while coarser is not None:
        mesh, times = coarser, times + 1
        coarser = _parent(mesh)
    return mesh, times


def _parent(mesh):
    """The mesh that `mesh` is the refinement of, or None."""
    if mesh.t.shape[1] % 4:
        return None
    t = _corners(mesh.t)
    if t is None:
        return None
    parent = NamedMesh(mesh.p[:, : t.max() + 1], t, source=mesh.source, note=mesh.note)
    if not (_has_midpoints(mesh, parent) and _has_children(mesh, parent)):
        return None
    parts = {name: _joined(mesh, parent, ends) for name, ends in mesh.parts.items()}
    subdomains = {name: _gathered(mesh, cells) for name, cells in mesh.subdomains.items()}
    if any(found is None for found in (*parts.values(), *subdomains.values())):
        return None
    return NamedMesh(parent.p, t, parts, subdomains, mesh.source, mesh.note)


def _corners(t):
    """Vertices of the parents, (3, nt / 4); None where the children do not lie as they should.

    Vertex k of a parent is that of its child k which its middle child 3 does not have.
    """
    children = t.reshape(3, 4, -1)
    middle = children[:, 3]
    own = np.all(children[:, None, :3] != middle[None, :, None], axis=1)  # vertex, child, parent
    if np.any(own.sum(axis=0) != 1):
        return None
    return np.where(own, children[:, :3], 0).sum(axis=0)


def _has_midpoints(mesh, parent):
    """Whether the other vertices are the midpoints of the parent's facets, in their order."""
    start, end = parent.facets
    midpoints = 0.5 * (parent.p[:, start] + parent.p[:, end])
    return np.array_equal(mesh.p[:, parent.p.shape[1] :], midpoints)


def _has_children(mesh, parent):
    """Whether the triangles are the children of the parent's, in their order."""
    ab, bc, ac = parent.p.shape[1] + parent.t2f
    a, b, c = parent.t
    corners = (a, ab, ac), (b, ab, bc), (c, ac, bc), (ab, bc, ac)
    expected = np.concatenate([np.stack(corner) for corner in corners], axis=1)
    return np.array_equal(np.sort(expected, axis=0), np.sort(mesh.t, axis=0))


def _joined(mesh, parent, ends):
    """The parent's facets of whose halves a part consists, as end vertices; None if of others."""
    if not ends.size:
        return ends
    count = mesh.p.shape[1]
    middle = parent.p.shape[1] + np.arange(parent.facets.shape[1])
    keys = pair_keys(ends, count)
    halves = [np.isin(pair_keys(np.stack([end, middle]), count), keys) for end in parent.facets]
    whole = halves[0] & halves[1]
    if 2 * whole.sum() != np.unique(keys).size:
        return None
    return parent.facets[:, whole]


def _gathered(mesh, cells):
    """The parents of whose children a subdomain consists; None if of others."""
    inside = np.zeros(mesh.t.shape[1], dtype=bool)
    inside[cells] = True
    children = inside.reshape(4, -1)
    if np.any(children != children[0]):
        return None
    return np.flatnonzero(children[0])
