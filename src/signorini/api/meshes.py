"""Domains with named parts of the boundary, triangulated, and refined uniformly at will."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from signorini.api.arguments import described
from signorini.api.types import Floats, Integers
from signorini.exceptions import MeshError
from signorini.mesh.boundary import SIDES, part_key
from signorini.mesh.domain import longest_edge, make_domain, root_mesh
from signorini.mesh.lattice import CORNERS

_REMEDY = (
    "give signorini.rectangle(...), signorini.polygon(...), a scikit-fem MeshTri, a meshio.Mesh, "
    "arrays (p, t), or the path of a mesh file"
)


@dataclass(frozen=True, eq=False, repr=False)
class Mesh:
    """A triangulated domain whose boundary has named parts.

    Make one by `rectangle`, `polygon` or `triangulation`.

    Parameters
    ----------
    domain : dict
        What `mesh.domain.make_domain` makes it from, but for the boundary's labels.
    n : int
        Its level. Of a rectangle or polygon the mesh width is 1/n; any other mesh has n = 1 before
        it is refined, and each refinement doubles n.
    coarsest : int
        The level of the mesh that it is refined from.
    """

    domain: dict[str, Any]
    n: int
    coarsest: int = 1

    @property
    def boundaries(self) -> tuple[str, ...]:
        """The names of the parts of the boundary."""
        return SIDES if self._is_rectangle else tuple(self.domain["mesh"].parts)

    @property
    def subdomains(self) -> tuple[str, ...]:
        """The names of the subdomains."""
        return () if self._is_rectangle else tuple(self.domain["mesh"].regions)

    @property
    def h(self) -> float:
        """Mesh width, unit of length."""
        return float(self._unlabelled.mesh_size(self.n))

    @property
    def p(self) -> Floats:
        """Vertices, shape (2, nv), unit of length."""
        return self._triangulation.p

    @property
    def t(self) -> Integers:
        """Vertices of each triangle, shape (3, nt)."""
        return self._triangulation.t

    @property
    def number_of_triangles(self) -> int:
        """Number of triangles."""
        return int(self._unlabelled.count_triangles(self.n))

    def refined(self, times: int = 1) -> "Mesh":
        """Every triangle cut into four by the midpoints of its sides, so many times.

        Multigrid takes the meshes in between for its levels, and a solution on one of them can be
        held against one on a finer one.

        Parameters
        ----------
        times : int, optional

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            If `times` is no whole number, or negative.

        Examples
        --------
        >>> rectangle(4).refined(2).n
        16
        """
        if not _is_whole(times) or times < 0:
            raise MeshError(
                f"times: {described(times)} is not valid; give a whole number, 0 or more"
            )
        return replace(self, n=self.n * 2 ** int(times))

    def level(self, n: int) -> "Mesh":
        """The mesh of the same domain at another level.

        Parameters
        ----------
        n : int
            Of a rectangle any whole number; else the coarsest level times a power of two.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            If there is no such level.
        """
        _check_n(n)
        self._unlabelled.count_triangles(int(n))
        return replace(self, n=int(n))

    def labelled(self, labels: Mapping[str, str], rest: str | None) -> tuple[dict, dict]:
        """The sections ``domain`` and ``boundary`` of a statement.

        Parameters
        ----------
        labels : dict
            Name of a part -> ``"dirichlet"``, ``"contact"`` or ``"neumann"``.
        rest : str or None
            The label of all else; None to refuse facets in no part that is named.

        Returns
        -------
        domain, boundary : dict

        Raises
        ------
        MeshError
            If there is no label for a side of a rectangle.
        """
        if not self._is_rectangle:
            return self.domain | {"rest": rest}, dict(labels)
        missing = [side for side in SIDES if side not in labels]
        if missing and rest is None:
            raise MeshError(
                f"neumann: the side {missing[0]} has no condition; name it in dirichlet, contact "
                "or neumann, or leave neumann out to have all that is left"
            )
        return self.domain, {side: labels.get(side, rest) for side in SIDES}

    def to_skfem(self) -> Any:
        """The mesh as a `skfem.MeshTri`, numbered alike, its boundaries and subdomains named."""
        mesh = self._triangulation
        names = {name: mesh.boundary_facets(part_key(name)) for name in self.boundaries}
        regions = {name: mesh.subdomains[name] for name in self.subdomains}
        return mesh.skfem.with_boundaries(names).with_subdomains(regions)

    def __repr__(self) -> str:
        parts = ", ".join(self.boundaries)
        return (
            f"<Mesh of level {self.n}: {self.number_of_triangles} triangles; boundaries: {parts}>"
        )

    @property
    def _is_rectangle(self) -> bool:
        return bool(self.domain["kind"] == "rectangle")

    @cached_property
    def _unlabelled(self) -> Any:
        """Every level, the whole boundary under one label."""
        labels = dict.fromkeys(self.boundaries, "neumann")
        return make_domain(*self.labelled(labels, "neumann"), self.coarsest)

    @property
    def _triangulation(self) -> Any:
        return self._unlabelled.level(self.n)


def rectangle(
    n: int,
    origin: Sequence[float] = (0.0, 0.0),
    size: Sequence[float] = (1.0, 1.0),
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
    corners: Sequence[Sequence[float]],
    n: int,
    sides: Sequence[str] | None = None,
    holes: Sequence[Sequence[Sequence[float]]] = (),
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
    given = {"corners": corners, "holes": holes} | ({} if sides is None else {"sides": sides})
    numbered = [f"side-{k}" for k in range(_length(corners))]
    names = [*(sides or numbered or ["side-0"]), *(f"hole-{k}" for k in range(_length(holes)))]
    section = _validated(n, {"kind": "polygon"} | given, names)
    return _given(root_mesh(section, int(n)), 1.0 / n, int(n))


def triangulation(
    mesh: Any,
    boundaries: Mapping[str, Any] | None = None,
    subdomains: Mapping[str, Any] | None = None,
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

    root, times = coarsest(_named(mesh, boundaries or {}, subdomains or {}))
    return replace(_given(root, longest_edge(root)), n=2**times)


def as_mesh(mesh: Any) -> Mesh:
    """Whatever stands for a mesh, as one.

    Raises
    ------
    MeshError
        Listing what does.
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


def _given(root: Any, width: float, n: int = 1) -> Mesh:
    return Mesh({"kind": "given", "mesh": root, "width": float(width)}, n, n)


def _validated(n: int, domain: dict[str, Any], parts: Sequence[str]) -> dict[str, Any]:
    """The section ``domain`` of a scene, checked as one."""
    from signorini.scene.read import read_mapping

    _check_n(n)
    boundary = dict.fromkeys(parts, "neumann")
    scene = {"domain": domain, "boundary": boundary, "data": {"f": 0}, "levels": [int(n)]}
    section: dict[str, Any] = read_mapping(scene, str(domain["kind"]), ".").document["domain"]
    return section


def _check_n(n: object) -> None:
    if not _is_whole(n) or n < 1:  # type: ignore[operator]
        raise MeshError(f"n: {described(n)} is not valid; n is 1/h, a whole number, for instance 8")


def _is_whole(value: object) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def _length(values: object) -> int:
    return len(values) if hasattr(values, "__len__") else 0
