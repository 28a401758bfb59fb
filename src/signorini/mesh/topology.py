"""Do triangles fit together? Facets in one triangle or two, and a boundary that encloses once."""

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.facets import unique_facets
from signorini.mesh.geometry import point_text
from signorini.mesh.outline import outline_defect

# Units in the last place within which a vertex lies on a boundary facet.
_ON_FACET = 4


def check_topology(p, q, t, size, source):
    """Refuse triangles that overlap, and vertices inside facets.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.
    q : ndarray, shape (2, nv)
        The same, scaled to the unit square.
    t : ndarray of int, shape (3, nt)
        Triangles, all counterclockwise.
    size : ndarray, shape (2, 1)
        The factors between `p` and `q`.
    source : str
        Where the mesh comes from, for messages.

    Raises
    ------
    MeshError
        A facet in three triangles or with two triangles on one side; a boundary that touches or
        crosses itself, or encloses a part of the plane more than once.
    """
    facets, t2f = unique_facets(t, p.shape[1])
    times = np.bincount(t2f.ravel())
    # The facets 01 and 12 run counterclockwise, 02 against it. A facet counts +1 where its triangle
    # lies on its left and -1 where on its right, so two triangles on either side give 0.
    counterclockwise = np.array([[1], [1], [-1]])
    on_left = np.where(t[[0, 1, 0]] < t[[1, 2, 2]], 1, -1) * counterclockwise
    balance = np.bincount(t2f.ravel(), weights=on_left.ravel())
    _check_facets(p, facets, times, balance, source)
    boundary = times == 1
    edges = np.where(balance[boundary] > 0, facets[:, boundary], facets[::-1, boundary])
    rounding = np.spacing(np.abs(p).max(axis=1)) / size[:, 0]
    defect = outline_defect(q, edges, _ON_FACET * float(rounding.max()))
    if defect:
        raise MeshError(f"{source}: " + _describe(defect, p, edges))


def _check_facets(p, facets, times, balance, source):
    """Each facet must be in at most two triangles, one on either side."""
    one_sided = (times == 2) & (balance != 0)
    for wrong, problem, remedy in (
        (times > 2, "belongs to {} triangles", "a facet has one or two; remove the others"),
        (
            one_sided,
            "has both its triangles on one side: they overlap",
            "unfold the mesh there",
        ),
    ):
        if wrong.any():
            k = int(np.argmax(wrong))
            what = problem.format(times[k])
            raise MeshError(f"{source}: {_facet_text(p, *facets[:, k])} {what}; {remedy}")


def _facet_text(p, a, b):
    return f"the facet from {point_text(p, a)} to {point_text(p, b)} (vertices {a}, {b})"


def _describe(defect, p, edges):
    """What is wrong with the boundary, and the remedy; see `outline_defect`."""
    kind, *where = defect
    if kind == "intricate":
        return (
            "the boundary is too intricate to verify "
            f"({where[0]} loops or pairs of facets); check for torn meshes"
        )
    facet = _facet_text(p, *edges[:, where[-1]])
    if kind == "touch":
        vertex = where[0]
        return (
            f"vertex {vertex} at {point_text(p, vertex)} lies inside {facet}: a hanging node; "
            "split that triangle"
        )
    if kind == "cross":
        a, b = edges[:, where[0]]
        return (
            f"{facet} crosses that from {point_text(p, a)} to {point_text(p, b)}: "
            "triangles overlap; remesh there"
        )
    return f"triangles overlap at {facet}; every point must lie in one triangle"
