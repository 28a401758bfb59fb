"""Meshes to start from: rectangles, polygons, and those that are there already."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from signorini.api.arguments import described
from signorini.api.meshes import Mesh, check_level
from signorini.exceptions import MeshError
from signorini.mesh.boundary import SIDES
from signorini.mesh.domain import longest_edge, read_curves, root_mesh
from signorini.mesh.lattice import CORNERS

_REMEDY = (
    "give signorini.rectangle(...), signorini.polygon(...), a scikit-fem MeshTri, a meshio.Mesh, "
    "arrays (p, t), or the path of a mesh file"
)


def rectangle(
    n: int,
    origin: ArrayLike = (0.0, 0.0),
    size: ArrayLike = (1.0, 1.0),
    diagonal: str = "falling",
    cells: str = "per-unit",
) -> Mesh:
    """A rectangle, cut into equal cells; its sides are bottom, right, top and left.

    Parameters
    ----------
    n : int
        Cells per unit of length, n = 1/h; or along each side.
    origin, size : pair of float
        Lower left corner and side lengths, in any unit of length.
    diagonal : {"falling", "rising", "alternating", "alternating-rising", "criss-cross"}
        How each cell is cut into two triangles, or four.
    cells : {"per-unit", "per-side"}
        What n counts.

    Returns
    -------
    Mesh

    Raises
    ------
    SceneError, MeshError
        Naming the argument, its value and the remedy, as for the section ``domain`` of a scene.

    Examples
    --------
    >>> rectangle(4, size=(2, 1))
    <Mesh of level 4: 64 triangles; boundaries: bottom, right, top, left>
    """
    given = {"origin": origin, "size": size, "diagonal": diagonal, "cells": cells}
    section = _validated(n, {"kind": "rectangle"} | given, SIDES)
    if diagonal in CORNERS:
        return Mesh(section, int(n), int(n))
    width = 1.0 / n if cells == "per-unit" else max(section["size"]) / n
    return _given(_cut(section, int(n)), width, int(n))


def _cut(section: dict[str, Any], n: int) -> Any:
    """The `NamedMesh` of a rectangle whose cells are cut in another way than those of a grid."""
    from signorini.mesh.cell_counts import count_cells
    from signorini.mesh.patterns import PATTERNS

    counts = count_cells(section["size"], section["cells"], n)
    pattern: Any = PATTERNS[section["diagonal"]]
    return pattern(*counts, section["origin"], section["size"])


def polygon(
    corners: ArrayLike,
    n: int,
    sides: Sequence[str] | None = None,
    holes: Sequence[ArrayLike] = (),
    boundary_shape: Mapping[str, Any] | None = None,
) -> Mesh:
    """A polygon, triangulated by Netgen.

    Parameters
    ----------
    corners : array_like, shape (m, 2)
        In order, either way round, in any unit of length.
    n : int
        Edges are about 1/n long.
    sides : sequence of str, optional
        The name of the side that starts at each corner; several may share one. They are also named
        side-0, side-1, ... by their numbers.
    holes : sequence of array_like, shape (k, 2)
        Likewise; the sides of each are hole-0, hole-1, ... as a whole.
    boundary_shape : dict, optional
        Name of a curved part of the boundary -> its curve: a circle, ``{"center": (x, y),
        "radius": r}``, or the formula phi of the curve phi(x, y) = 0. Vertices there are put onto
        it on every level, which then do not nest.

    Returns
    -------
    Mesh

    Raises
    ------
    SceneError, MeshError
        Naming the argument, its value and the remedy, as for the section ``domain`` of a scene; or
        if netgen-mesher is not installed.

    Examples
    --------
    >>> triangle = polygon([(0, 0), (1, 0), (0, 1)], 4, sides=["floor", "slope", "wall"])
    >>> triangle.boundaries
    ('side-0', 'floor', 'side-1', 'slope', 'side-2', 'wall')
    """
    given: dict[str, Any] = {"corners": corners, "holes": holes}
    optional = {"sides": sides, "boundary_shape": boundary_shape}
    given |= {key: value for key, value in optional.items() if value is not None}
    numbered = [f"side-{k}" for k in range(_length(corners))]
    names = [*(sides or numbered or ["side-0"]), *(f"hole-{k}" for k in range(_length(holes)))]
    section = _validated(n, {"kind": "polygon"} | given, names)
    curves = read_curves(section.get("boundary_shape", {}))
    return _given(root_mesh(section, int(n), curves), 1.0 / n, int(n), curves)


def triangulation(
    mesh: Any,
    boundaries: Mapping[str, Any] | None = None,
    subdomains: Mapping[str, Any] | None = None,
    boundary_shape: Mapping[str, Any] | None = None,
) -> Mesh:
    """A mesh that is there already.

    Parameters
    ----------
    mesh : skfem.MeshTri, meshio.Mesh, path, or pair of arrays
        Named boundaries and subdomains, or physical groups, are kept. Arrays are vertices p, shape
        (2, nv), and vertices of triangles t, shape (3, nt). A file is whatever meshio reads.
    boundaries : dict, optional
        Name of a part of the boundary -> the end vertices of its facets, shape (2, k); or a
        function of x and y, which takes the boundary facets at whose midpoints it is true. Where
        the mesh itself has no names, facets on the sides of its bounding box are bottom, right, top
        and left.
    subdomains : dict, optional
        Name of a subdomain -> numbers of its triangles, or a mask (nt,); or a function of x and y,
        which takes the triangles at whose centroids it is true.
    boundary_shape : dict, optional
        The curves of parts of the boundary, see `polygon`.

    Returns
    -------
    Mesh
        Vertices and facets are numbered as in `mesh`. Where that shows by its numbers that it was
        refined, as a MeshTri does, it is known what from.

    Raises
    ------
    MeshError
        Naming the argument, its value and the remedy.

    Examples
    --------
    >>> import skfem
    >>> mesh = triangulation(skfem.MeshTri().refined(3), {"floor": lambda x, y: y == 0})
    >>> mesh.boundaries, mesh.n
    (('bottom', 'right', 'top', 'left', 'floor'), 8)
    """
    from signorini.mesh.coarsening import coarsest

    named = _named(mesh, boundaries or {}, subdomains or {})
    if boundary_shape:
        return _curved(named, boundary_shape)
    root, times = coarsest(named)
    return replace(_given(root, longest_edge(root)), n=2**times)


def _curved(named: Any, boundary_shape: Mapping[str, Any]) -> Mesh:
    """A mesh whose boundary follows curves."""
    from signorini.mesh.curved import with_curved_sides

    for name, curve in boundary_shape.items():
        is_circle = isinstance(curve, Mapping) and set(curve) == {"center", "radius"}
        if not (is_circle or isinstance(curve, str)):
            raise MeshError(
                f"boundary_shape.{name}: {described(curve)} is no curve; give a formula as text, "
                'or {"center": (x, y), "radius": r}'
            )
    curves = read_curves(dict(boundary_shape))
    root = with_curved_sides(named, curves)
    return _given(root, longest_edge(root), curves=curves)


def as_mesh(mesh: Any) -> Mesh:
    """Whatever stands for a mesh, as one.

    Raises
    ------
    MeshError
        Listing what does.

    Examples
    --------
    Vertices and triangles are a mesh:

    >>> as_mesh(([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]])).number_of_triangles
    1
    """
    return mesh if isinstance(mesh, Mesh) else triangulation(mesh)


def _named(mesh: Any, boundaries: Mapping[str, Any], subdomains: Mapping[str, Any]) -> Any:
    """The `NamedMesh` of a mesh, with further names."""
    from signorini.mesh.given import from_arrays, from_meshio, from_skfem, with_names
    from signorini.mesh.imported import import_mesh

    package = type(mesh).__module__.partition(".")[0]
    if isinstance(mesh, str | Path):
        found = import_mesh(mesh)
    elif package in ("skfem", "meshio"):
        found = {"skfem": from_skfem, "meshio": from_meshio}[package](mesh)
    elif isinstance(mesh, tuple | list) and len(mesh) == 2:
        p, t = mesh
        return from_arrays(p, t, boundaries, subdomains)
    else:
        raise MeshError(f"mesh: {described(mesh)} is no mesh; {_REMEDY}")
    return with_names(found, boundaries, subdomains)


def _given(root: Any, width: float, n: int = 1, curves: Mapping[str, Any] | None = None) -> Mesh:
    domain = {"kind": "given", "mesh": root, "width": float(width), "curves": curves or {}}
    return Mesh(domain, n, n)


def _validated(n: int, domain: dict[str, Any], parts: Sequence[str]) -> dict[str, Any]:
    """The section ``domain`` of a scene, checked as one."""
    from signorini.scene.read import read_mapping

    check_level(n)
    boundary = dict.fromkeys(parts, "neumann")
    scene = {"domain": domain, "boundary": boundary, "data": {"f": 0}, "levels": [int(n)]}
    section: dict[str, Any] = read_mapping(scene, str(domain["kind"]), ".").document["domain"]
    return section


def _length(values: object) -> int:
    return len(values) if hasattr(values, "__len__") else 0
