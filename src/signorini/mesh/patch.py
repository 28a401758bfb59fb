"""Some triangles of a triangulation and their refinements: what one of several processes holds.

The triangles of a coarse mesh, which every process knows, are dealt out, and each process refines
its own. Where two processes meet, the refined mesh has the same vertices on both sides, in the
order of the chain from the smaller end of a coarse facet to the greater.
"""

from dataclasses import dataclass

import numpy as np

from signorini.mesh.boundary import part_key
from signorini.mesh.facets import pair_keys
from signorini.mesh.triangulation import Triangulation


class Patch(Triangulation):
    """Triangles of a larger mesh: where they were cut from the others there is no boundary."""

    def _check_labels(self):
        """The larger mesh has been looked at."""


def dealt_out(mesh, count):
    """Which of `count` processes gets each triangle, by bisection along the longer extent.

    Parameters
    ----------
    mesh : Triangulation
    count : int

    Returns
    -------
    ndarray of int, shape (nt,)

    Examples
    --------
    >>> from signorini.mesh.triangulation import Triangulation
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends).refined().refined()
    >>> np.bincount(dealt_out(mesh, 3)).tolist()
    [5, 5, 6]
    """
    centroids = mesh.p[:, mesh.t].mean(axis=1)
    owner = np.zeros(mesh.number_of_triangles, dtype=int)
    _deal(centroids, np.arange(owner.size), 0, count, owner)
    return owner


def _deal(centroids, cells, first, count, owner):
    if count == 1:
        owner[cells] = first
        return
    own = centroids[:, cells]
    axis = int(np.argmax(np.ptp(own, axis=1)))
    order = np.lexsort([cells, own[axis]])
    share = cells.size * (count // 2) // count
    _deal(centroids, cells[order[:share]], first, count // 2, owner)
    _deal(centroids, cells[order[share:]], first + count // 2, count - count // 2, owner)


@dataclass(frozen=True, eq=False)
class Cut:
    """One process's triangles of a coarse mesh, refined, and where it meets others.

    Parameters
    ----------
    mesh : Patch or Triangulation
    triangles : ndarray of int, shape (nt,)
        Their numbers in the whole refined mesh.
    corners : dict of int to ndarray of int
        Other process -> the coarse vertices that both have, by their number here, in an order that
        both know.
    chains : dict of int to ndarray of int, shape (k, 2**levels + 1)
        Other process -> the vertices along each coarse facet that both have, likewise.
    """

    mesh: Triangulation
    triangles: np.ndarray
    corners: dict
    chains: dict


def cut_out(mesh, owner, which, levels):
    """Cut the triangles of one process out of a coarse mesh, and refine them.

    Parameters
    ----------
    mesh : Triangulation
    owner : ndarray of int, shape (nt,)
        Of `dealt_out`.
    which : int
        The process.
    levels : int
        How often each triangle is cut into four.

    Returns
    -------
    Cut
    """
    cells = np.flatnonzero(owner == which)
    vertices = np.unique(mesh.t[:, cells])
    place = np.zeros(mesh.number_of_vertices, dtype=np.int32)
    place[vertices] = np.arange(vertices.size)
    ends = _own_ends(mesh, owner == which, place)
    curves = {name: at for name, at in mesh.curves.items() if ends[part_key(name)].size}
    inside = _own_subdomains(mesh, cells)
    patch = Patch(mesh.p[:, vertices], place[mesh.t[:, cells]], ends, inside, curves=curves)
    corners = {other: place[shared] for other, shared in _shared_vertices(mesh, owner, which)}
    chains = {other: place[ends].T for other, ends in _shared_facets(mesh, owner, which)}
    count, numbers = mesh.number_of_triangles, cells
    for _ in range(levels):
        chains = {other: _refined_chains(patch, chain) for other, chain in chains.items()}
        numbers = np.concatenate([child * count + numbers for child in range(4)])
        patch, count = patch.refined(), 4 * count
    return Cut(patch, numbers, corners, chains)


def _own_ends(mesh, own, place):
    """The labelled facets of own triangles, by own numbers of vertices."""
    behind = np.zeros(mesh.number_of_facets, dtype=bool)
    behind[mesh.t2f[:, own]] = True
    ends = {}
    for label in mesh.ends:
        facets = mesh.boundary_facets(label)
        ends[label] = place[mesh.facets[:, facets[behind[facets]]]]
    return ends


def _own_subdomains(mesh, cells):
    return {
        name: np.flatnonzero(np.isin(cells, members)) for name, members in mesh.subdomains.items()
    }


def _shared_vertices(mesh, owner, which):
    """For each other process, the vertices of triangles of both, increasing."""
    own = np.zeros(mesh.number_of_vertices, dtype=bool)
    own[mesh.t[:, owner == which]] = True
    for other in np.unique(owner):
        theirs = np.unique(mesh.t[:, owner == other])
        shared = theirs[own[theirs]]
        if other != which and shared.size:
            yield int(other), shared


def _shared_facets(mesh, owner, which):
    """For each other process, the ends (2, k) of facets between triangles of both, by number."""
    own = np.zeros(mesh.number_of_facets, dtype=bool)
    own[mesh.t2f[:, owner == which]] = True
    for other in np.unique(owner):
        theirs = np.unique(mesh.t2f[:, owner == other])
        shared = theirs[own[theirs]]
        if other != which and shared.size:
            yield int(other), mesh.facets[:, shared]


def facets_along(mesh, chain):
    """The facets of a mesh between the vertices that follow one another in the rows of a chain.

    Parameters
    ----------
    mesh : Triangulation
    chain : ndarray of int, shape (k, m)
        Rows of vertices.

    Returns
    -------
    ndarray of int, shape (k, m - 1)

    Examples
    --------
    >>> from signorini.mesh.triangulation import Triangulation
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> mesh = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
    >>> facets_along(mesh, np.array([[0, 1, 2]])).tolist()
    [[0, 2]]
    """
    keys = pair_keys(mesh.facets, mesh.number_of_vertices)
    ends = np.stack([chain[:, :-1].ravel(), chain[:, 1:].ravel()])
    wanted = pair_keys(ends, mesh.number_of_vertices)
    return np.searchsorted(keys, wanted).reshape(len(chain), -1)


def _refined_chains(mesh, chain):
    """The chains in the refinement of a mesh: the midpoint of each facet between its ends."""
    finer = np.empty((len(chain), 2 * chain.shape[1] - 1), dtype=chain.dtype)
    finer[:, ::2] = chain
    finer[:, 1::2] = mesh.number_of_vertices + facets_along(mesh, chain)
    return finer
