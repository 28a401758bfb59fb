"""What a picture of a mesh shows: its triangles, and the parts of boundary and body with names."""

import re

import numpy as np

# The sides of a hole one by one, beside the hole as a whole.
_SIDE_OF_A_HOLE = re.compile(r"hole-\d+-side-\d+")


def named_parts(mesh, boundaries, subdomains):
    """Return the numbers and names that a picture of a mesh shows.

    Parameters
    ----------
    mesh : Grid or Triangulation
        With the whole boundary under the label ``neumann``.
    boundaries : dict of str to ndarray of int
        Name of a part of the boundary -> its facets.
    subdomains : dict of str to ndarray of int
        Name of a subdomain -> its triangles.

    Returns
    -------
    dict
        ``p`` (2, nv), unit of length, and ``t`` (3, nt), the triangulation; ``nameless`` (2, k),
        the ends of boundary facets in no part; ``parts``, a list of ``(name, ends, middle,
        inside)``: ends of facets (2, k), those of the most central facet (2,), and a vertex across
        from it; ``regions``, a list of ``(name, triangles, place)``, where the name goes (2,).
        Names of the same facets or triangles are one, joined by an equals sign.

    Examples
    --------
    >>> import signorini
    >>> mesh = signorini.problem(signorini.rectangle(1), f=0, contact=[]).mesh
    >>> lid, *_ = named_parts(mesh, {"lid": mesh.boundary_facets("part top")}, {})["parts"]
    >>> lid[0], lid[2].tolist(), int(lid[3])
    ('lid', [2, 3], 1)
    """
    own = {name: facets for name, facets in boundaries.items() if not _is_side_of_a_hole(name)}
    named = np.concatenate([np.zeros(0, dtype=int), *own.values()])
    nameless = np.setdiff1d(mesh.boundary_facets("neumann"), named)
    across = _across(mesh)
    return {
        "p": mesh.p,
        "t": mesh.t,
        "nameless": mesh.facets[:, nameless],
        "parts": [_part(mesh, across, *part) for part in _joined(own)],
        "regions": [_region(mesh, *region) for region in _joined(subdomains)],
    }


def _is_side_of_a_hole(name):
    return _SIDE_OF_A_HOLE.fullmatch(name) is not None


def _joined(groups):
    """Names and numbers, those of the same numbers once, without those that have none."""
    names = {}
    for name, numbers in groups.items():
        names.setdefault(tuple(np.sort(numbers).tolist()), []).append(name)
    return [(" = ".join(same), np.array(key)) for key, same in names.items() if key]


def _across(mesh):
    """Facet -> the vertex across from it, of a triangle beside it, (nf,)."""
    across = np.zeros(mesh.facets.shape[1], dtype=int)
    across[mesh.t2f] = mesh.t.sum(axis=0) - mesh.facets.sum(axis=0)[mesh.t2f]
    return across


def _part(mesh, across, name, facets):
    k = facets[_most_central(mesh.p[:, mesh.facets[:, facets]].mean(axis=1))]
    return name, mesh.facets[:, facets], mesh.facets[:, k], across[k]


def _region(mesh, name, triangles):
    centroids = mesh.p[:, mesh.t[:, triangles]].mean(axis=1)
    return name, triangles, centroids[:, _most_central(centroids)]


def _most_central(points):
    """The point that is nearest to the mean of all."""
    distances = np.linalg.norm(points - points.mean(axis=1, keepdims=True), axis=0)
    return int(np.argmin(distances.round(12)))
