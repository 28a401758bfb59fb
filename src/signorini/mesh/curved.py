"""Meshes with curved sides: their vertices there are put onto the curves, level after level.

Only vertices on the boundary move, so that cells beside a curve change a little and others not at
all. The levels of a curved domain are not nested; by their numbers they are refinements still.
"""

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.boundary import offered, part_key
from signorini.mesh.facets import pair_keys
from signorini.mesh.geometry import doubled_areas, point_text
from signorini.wording import nearest

_ON_CURVE = 1e-6  # of the extent: how far from a curve the vertex may lie where it ends
_LEAST = 0.1  # of its area: what a triangle must keep


def followed(p, t, curves, ends, first=0):
    """Vertices of a mesh, those on curved sides put onto the curves.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Unit of length.
    t : ndarray of int, shape (3, nt)
    curves : dict of str to Circle or LevelSet
        Of the named parts of the boundary that are curved.
    ends : dict of str to ndarray of int, shape (2, k)
        End vertices of the facets of each part, by its `part_key`.
    first : int
        Vertices with smaller numbers stay where they are: they lie on the curves.

    Returns
    -------
    ndarray, shape (2, nv)

    Raises
    ------
    MeshError
        Naming the part and the point, where a vertex is too far from its curve, or a triangle would
        lose its area.

    Examples
    --------
    The end of two facets that refinement added is put onto the circle:

    >>> from signorini.mesh.curves import Circle
    >>> p = np.array([[1.0, 0.8, 0.9, 0.5], [0.0, 0.6, 0.3, 0.2]])
    >>> ends, t = {part_key("rim"): np.array([[0, 2], [2, 1]])}, np.array([[0, 2], [2, 1], [3, 3]])
    >>> moved = followed(p, t, {"rim": Circle((0.0, 0.0), 1.0)}, ends)
    >>> np.hypot(*moved[:, :3]).round(12).tolist()
    [1.0, 1.0, 1.0]
    """
    if not curves:
        return p
    moved = p.copy()
    for name, curve in curves.items():
        vertices = np.unique(ends[part_key(name)])
        vertices = vertices[vertices >= first]
        moved[:, vertices] = nearest_on(curve, name, p[:, vertices])
        _check_near(name, p[:, vertices], moved[:, vertices], _longest(p, ends[part_key(name)]))
    _check_areas(p, moved, t)
    return moved


def with_curved_sides(mesh, curves):
    """A mesh whose vertices on curved sides are put onto the curves.

    Parameters
    ----------
    mesh : NamedMesh
    curves : dict of str to Circle or LevelSet
        Of the parts of the boundary that are curved.

    Returns
    -------
    NamedMesh

    Raises
    ------
    MeshError
        If the mesh has no such part, or does not fit to its curve, see `followed`.
    """
    for name in curves:
        if name not in mesh.parts:
            raise MeshError(
                f"domain.boundary_shape.{name}: {mesh.source} has no such part; "
                f"{nearest(name, offered(mesh.parts))}"
            )
    ends = {part_key(name): mesh.parts[name] for name in curves}
    check_ends(mesh.p, mesh.facets[:, mesh.boundary], curves, ends)
    return mesh.with_vertices(followed(mesh.p, mesh.t, curves, ends))


def check_ends(p, boundary, curves, ends):
    """Refuse a curve that misses a vertex where it meets a side that does not follow it.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
    boundary : ndarray of int, shape (2, nb)
        End vertices of all boundary facets.
    curves, ends
        See `followed`.

    Raises
    ------
    MeshError
        Naming the part, the vertex and its distance from the curve.
    """
    extent = float(np.ptp(p, axis=1).max())
    for curve in set(curves.values()):
        names = [name for name, other in curves.items() if other == curve]
        own = np.concatenate([ends[part_key(name)] for name in names], axis=1)
        others = ~np.isin(pair_keys(boundary, p.shape[1]), pair_keys(own, p.shape[1]))
        last = np.intersect1d(own, boundary[:, others])
        away = np.hypot(*(nearest_on(curve, names[0], p[:, last]) - p[:, last]))
        if away.size and away.max() > _ON_CURVE * extent:
            k = int(away.argmax())
            raise MeshError(
                f"domain.boundary_shape.{names[0]}: the vertex at {point_text(p[:, last], k)}, "
                f"where the curve ends, is {away[k]:.3g} away from it; move the vertex onto it, "
                "or correct the curve"
            )


def true_places(mesh, facets, points, normals):
    """Points of boundary facets put onto the curves that these stand for, and the normals there.

    Parameters
    ----------
    mesh : Grid or Triangulation
    facets : ndarray of int, shape (k,)
        The facet of each point.
    points : ndarray, shape (2, k)
        Unit of length.
    normals : ndarray, shape (2, k)
        Outward unit normals of the facets.

    Returns
    -------
    points, normals : ndarray, shape (2, k)
        The same where no side is curved.
    """
    points, normals = points.copy(), normals.copy()
    for name, curve in curves_of(mesh).items():
        of_part = np.zeros(mesh.number_of_facets, dtype=bool)
        of_part[mesh.boundary_facets(part_key(name))] = True
        at = of_part[facets]
        points[:, at] = curve.nearest(points[:, at])
        true = curve.normals(points[:, at])
        outward = (true * normals[:, at]).sum(axis=0) > 0.0
        normals[:, at] = np.where(outward, true, -true)
    return points, normals


def curves_of(mesh):
    """The curved parts of a mesh's boundary, name -> curve.

    Examples
    --------
    >>> from signorini import load_scene
    >>> curves_of(load_scene("config/scenes/paper.yaml").problem_statement.triangulations.level(4))
    {}
    """
    return getattr(mesh, "curves", {})


def curved_vertices(mesh):
    """The vertices on curved parts of a mesh's boundary, increasing."""
    of_parts = [mesh.boundary_vertices(part_key(name)) for name in curves_of(mesh)]
    return np.unique(np.concatenate([np.zeros(0, dtype=np.int32), *of_parts]))


def nearest_on(curve, name, p):
    """The points of a curve nearest to points; an error names the part of the boundary.

    Parameters
    ----------
    curve : Circle or LevelSet
    name : str
        Of the part of the boundary that is curved.
    p : ndarray, shape (2, k)
        Unit of length.

    Returns
    -------
    ndarray, shape (2, k)

    Raises
    ------
    MeshError, FormulaError
        Where there is none.

    Examples
    --------
    >>> from signorini.mesh.curves import Circle
    >>> nearest_on(Circle((0.0, 0.0), 1.0), "rim", np.array([[3.0], [0.0]])).ravel().tolist()
    [1.0, 0.0]
    >>> nearest_on(Circle((0.0, 0.0), 1.0), "rim", np.zeros((2, 1)))
    Traceback (most recent call last):
    signorini.exceptions.MeshError: domain.boundary_shape.rim: a point at the centre ...
    """
    try:
        return curve.nearest(p)
    except MeshError as error:
        raise MeshError(f"domain.boundary_shape.{name}: {error}") from None


def _longest(p, facets):
    return float(np.hypot(*(p[:, facets[0]] - p[:, facets[1]])).max())


def _check_near(name, p, moved, longest):
    """Refuse to move a vertex by more than half the longest facet of its part."""
    away = np.hypot(*(moved - p))
    if away.size and away.max() > 0.5 * longest:
        k = int(away.argmax())
        raise MeshError(
            f"domain.boundary_shape.{name}: the vertex at {point_text(p, k)} is {away[k]:.3g} "
            f"away from the curve, facets are up to {longest:.3g} long; correct the curve, or let "
            "the coarsest mesh follow it more closely"
        )


def _check_areas(p, moved, t):
    """Refuse to turn a triangle over, or to flatten it."""
    touched = np.flatnonzero((moved != p).any(axis=0)[t].any(axis=0))
    before, after = doubled_areas(p, t[:, touched]), doubled_areas(moved, t[:, touched])
    flat = after * np.sign(before) <= _LEAST * np.abs(before)
    if flat.any():
        k = touched[np.argmax(flat)]
        place = point_text(p[:, t[:, k]].mean(axis=1, keepdims=True), 0)
        raise MeshError(
            f"domain.boundary_shape: {flat.sum()} triangles would lose their area where a side "
            f"follows its curve, the first at {place}; start from a finer coarsest mesh"
        )
