"""The same mesh with other numbers."""

import numpy as np

from signorini.mesh.labels import labelled
from signorini.mesh.named_mesh import NamedMesh
from signorini.mesh.triangulation import LABELS


def renumber(mesh, rng):
    """Number vertices, triangles and edges of a mesh at random.

    Parameters
    ----------
    mesh : Grid or Triangulation
    rng : numpy.random.Generator

    Returns
    -------
    mesh : Triangulation
    vertex, facet : ndarray of int
        The new number of each old vertex and facet.
    """
    vertex = rng.permutation(mesh.number_of_vertices)
    p = np.empty_like(mesh.p)
    p[:, vertex] = mesh.p
    t = vertex[mesh.t][:, rng.permutation(mesh.number_of_triangles)]
    ends = {label: vertex[mesh.facets[:, mesh.boundary_facets(label)]] for label in LABELS}
    parts = {label: found for label, found in ends.items() if found.size}
    new = labelled(NamedMesh(p, np.ascontiguousarray(t), parts), {label: label for label in parts})
    # A facet is known by its two ends, whatever their order: one number for each pair.
    keys, wanted = (
        np.sort(facets, axis=0).T.astype(np.int64) @ [p.shape[1], 1]
        for facets in (new.facets, vertex[mesh.facets])
    )
    order = np.argsort(keys)
    return new, vertex, order[np.searchsorted(keys[order], wanted)]
