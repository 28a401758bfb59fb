"""A uniform triangulation of a rectangle, known by arithmetic: nothing is searched, sorted or
stored.

Vertices, triangles and facets are numbered as scikit-fem numbers them, so a vector of degrees of
freedom means the same on ``grid.skfem`` (tests hold the two together).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from signorini.mesh.boundary import SIDES

_CELLS_AT_ONCE = 2**15

# Corners (in units of a cell) of the two triangles of a cell, counterclockwise, the right angle
# first.
CORNERS = {
    "falling": (((0, 0), (1, 0), (0, 1)), ((1, 1), (0, 1), (1, 0))),
    "rising": (((1, 0), (1, 1), (0, 0)), ((0, 1), (0, 0), (1, 1))),
}


class Triangles(NamedTuple):
    """Vertices and facets, both (3, k), of k triangles of a mesh."""

    t: np.ndarray
    t2f: np.ndarray


@dataclass(frozen=True)
class Grid:
    """Rectangle of ``nx`` by ``ny`` cells, each cut into two triangles by one diagonal.

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    origin, size : tuple of float
        Lower left corner and side lengths, in the user's unit of length.
    diagonal : {"falling", "rising"}
        From top left to bottom right (the line x + y = const), or from bottom left to top right.
    labels : tuple of str
        ``"dirichlet"``, ``"contact"`` or ``"neumann"`` for each of `SIDES`.
    """

    nx: int
    ny: int
    origin: tuple[float, float]
    size: tuple[float, float]
    diagonal: str
    labels: tuple[str, str, str, str]

    @property
    def corners(self):
        """Corners of the two triangles of a cell, (2, 3, 2) nested tuples of 0 and 1."""
        return CORNERS[self.diagonal]

    @property
    def spacing(self):
        """Side lengths (hx, hy) of a cell, unit of length."""
        return self.size[0] / self.nx, self.size[1] / self.ny

    @property
    def area(self):
        """Area of each triangle, a number, unit of length squared."""
        hx, hy = self.spacing
        return 0.5 * hx * hy

    @property
    def stretch(self):
        """The ratio of a triangle's longest edge to the height on it, dimensionless."""
        hx, hy = self.spacing
        return hx / hy + hy / hx

    def forget_facets(self):
        """Nothing to do, for they are not stored; see `Triangulation.forget_facets`."""

    @property
    def number_of_vertices(self):
        """Number of vertices."""
        return (self.nx + 1) * (self.ny + 1)

    @property
    def number_of_facets(self):
        """Number of edges."""
        return self.ny * (3 * self.nx + 1) + self.nx

    @property
    def number_of_triangles(self):
        """Number of triangles."""
        return 2 * self.nx * self.ny

    @cached_property
    def x(self):
        """Abscissae of the vertex columns, shape (nx + 1,)."""
        return self.origin[0] + self.size[0] * (np.arange(self.nx + 1) / self.nx)

    @cached_property
    def y(self):
        """Ordinates of the vertex rows, shape (ny + 1,)."""
        return self.origin[1] + self.size[1] * (np.arange(self.ny + 1) / self.ny)

    @property
    def p(self):
        """Vertices, shape (2, number_of_vertices), x running fastest."""
        return np.stack(np.meshgrid(self.x, self.y)).reshape(2, -1)

    def points(self, vertices):
        """Coordinates of vertices given by their numbers, shape (2, len(vertices))."""
        j, i = np.divmod(vertices, self.nx + 1)
        return np.stack([self.x[i], self.y[j]])

    @property
    def vertex_numbers(self):
        """Vertex numbers as an array of rows, shape (ny + 1, nx + 1)."""
        return np.arange(self.number_of_vertices, dtype=np.int32).reshape(self.ny + 1, self.nx + 1)

    @property
    def t(self):
        """Vertices of each triangle, shape (3, nt): all first triangles of the cells, then all
        second.
        """
        v = self.vertex_numbers
        return np.stack(
            [
                np.concatenate([self.window(v, kind[k]).ravel() for kind in self.corners])
                for k in range(3)
            ]
        )

    def window(self, rows, corner):
        """The values of a vertex array at one corner of every cell, shape (ny, nx), a view."""
        i, j = corner
        return rows[j : j + self.ny, i : i + self.nx]

    @cached_property
    def _places(self):
        """Where the horizontal, vertical and diagonal edges leaving a vertex row stand in it: pairs
        (places, edges).
        """
        end = 3 * self.nx
        v = (slice(1, end, 3), slice(0, -1)), (slice(end, None), slice(-1, None))
        if self.diagonal == "rising":
            return ((slice(0, end, 3), slice(None)),), v, ((slice(2, end, 3), slice(None)),)
        h = (slice(0, 1), slice(0, 1)), (slice(2, end - 1, 3), slice(1, None))
        return h, v, ((slice(3, end, 3), slice(0, -1)), (slice(end - 1, end), slice(-1, None)))

    @cached_property
    def _positions(self):
        """The same as numbers: of each horizontal, vertical, diagonal edge."""
        row = np.arange(3 * self.nx + 1, dtype=np.int32)
        return tuple(np.concatenate([row[places] for places, _ in pairs]) for pairs in self._places)

    def row_blocks(self):
        """Ranges (first, last) of rows of cells, some `_CELLS_AT_ONCE` in each, so that temporaries
        stay in a cache.
        """
        step = max(_CELLS_AT_ONCE // self.nx, 1)
        return [(first, min(first + step, self.ny)) for first in range(0, self.ny, step)]

    def _edge_rows(self, u):
        """A vector over the facets as the edges leaving each vertex row, (ny, 3 nx + 1), and the
        top side's, (nx,).
        """
        width = 3 * self.nx + 1
        return u[: self.ny * width].reshape(self.ny, width), u[self.ny * width :]

    def split_edges(self, u, first=0, last=None):
        """Sort a vector over the facets by direction.

        Parameters
        ----------
        u : ndarray, shape (number_of_facets,)
        first, last : int, optional
            Rows of cells, from `first` to before `last`: their m rows of edges alone. By default
            all, m = ny.

        Returns
        -------
        horizontal, vertical, diagonal : ndarray
            Shapes (m + 1, nx), (m, nx + 1) and (m, nx).
        """
        last = self.ny if last is None else last
        rows, top = self._edge_rows(u)
        shapes = (last - first + 1, self.nx), (last - first, self.nx + 1), (last - first, self.nx)
        edges = tuple(np.empty(shape, dtype=u.dtype) for shape in shapes)
        for pairs, values in zip(self._places, edges, strict=True):
            part = rows[first : first + len(values)]
            for places, of in pairs:
                values[: len(part), of] = part[:, places]
        if last == self.ny:
            edges[0][-1] = top
        return edges

    def join_edges(self, horizontal, vertical, diagonal):
        """Undo `split_edges`."""
        u = np.empty(self.number_of_facets, dtype=horizontal.dtype)
        rows, top = self._edge_rows(u)
        top[:] = horizontal[-1]
        for pairs, values in zip(self._places, (horizontal[:-1], vertical, diagonal), strict=True):
            for places, of in pairs:
                rows[:, places] = values[:, of]
        return u

    def add_edges(self, u, first, horizontal, vertical, diagonal):
        """Add to a vector over the facets, in place, values at the edges of the rows of cells from
        `first` on.
        """
        rows, top = self._edge_rows(u)
        for pairs, values in zip(self._places, (horizontal, vertical, diagonal), strict=True):
            part = rows[first : first + len(values)]
            for places, of in pairs:
                part[:, places] += values[: len(part), of]
        if first + len(diagonal) == self.ny:
            top += horizontal[-1]

    def facet_ends(self, facets):
        """End vertices of facets given by their numbers, the smaller number first, shape (2,
        len(facets)).
        """
        i = np.concatenate([np.arange(self.nx + 1)[: len(k)] for k in self._positions])
        table = np.empty((2, 3 * self.nx + 1), dtype=int)
        table[:, np.concatenate(self._positions)] = (
            i,
            np.repeat(np.arange(3), [len(k) for k in self._positions]),
        )
        row, position = np.divmod(facets, 3 * self.nx + 1)
        i, kind = table[:, position]
        i, kind = np.where(row < self.ny, i, position), np.where(row < self.ny, kind, 0)
        up = self.nx + 1
        start, step = (1, up - 1) if self.diagonal == "falling" else (0, up + 1)
        first = row * up + i + np.where(kind == 2, start, 0)
        return np.stack([first, first + np.array([1, up, step])[kind]])

    @property
    def t2f(self):
        """Facets of each triangle, shape (3, nt), in scikit-fem's order (01, 12, 02)."""
        h, v, d = self.split_edges(np.arange(self.number_of_facets, dtype=np.int32))
        first, second = (h[:-1], v[:, :-1]), (h[1:], v[:, 1:])
        if self.diagonal == "rising":
            first, second = (v[:, 1:], h[:-1]), (v[:, :-1], h[1:])
        pairs = zip((first[0], d, first[1]), (second[0], d, second[1]), strict=True)
        return np.stack([np.concatenate([a.ravel(), b.ravel()]) for a, b in pairs])

    def triangles(self, numbers):
        """Vertices and facets of triangles given by their numbers, as `Triangles`."""
        kind, cell = np.divmod(numbers, self.nx * self.ny)
        j, i = np.divmod(cell, self.nx)
        offsets = np.array(self.corners, dtype=np.int32)[kind].transpose(1, 2, 0)
        t = (j + offsets[:, 1]) * (self.nx + 1) + i + offsets[:, 0]
        h, v, d = self._positions
        row = 3 * self.nx + 1
        horizontal = (j + kind) * row + np.where(j + kind < self.ny, h[i], i)
        vertical = j * row + v[i + (kind if self.diagonal == "falling" else 1 - kind)]
        legs = (horizontal, vertical) if self.diagonal == "falling" else (vertical, horizontal)
        return Triangles(t, np.stack([legs[0], j * row + d[i], legs[1]]))

    def triangles_at(self, label):
        """The triangles with a facet on the sides that carry `label`, each once, as `Triangles`."""
        along, up = np.arange(self.nx, dtype=np.int32), np.arange(self.ny, dtype=np.int32) * self.nx
        cells = self.nx * self.ny
        left, right = (0, cells) if self.diagonal == "falling" else (cells, 0)
        found = {
            "bottom": along,
            "right": right + up + self.nx - 1,
            "top": cells + up[-1] + along,
            "left": left + up,
        }
        return self.triangles(
            np.unique(np.concatenate([found[side] for side in self.sides(label)]))
        )

    @property
    def facets(self):
        """End vertices of each facet, the smaller number first, shape (2, number_of_facets)."""
        v = self.vertex_numbers
        a, b = (v[:-1, 1:], v[1:, :-1]) if self.diagonal == "falling" else (v[:-1, :-1], v[1:, 1:])
        ends = ((v[:, :-1], v[:-1], a), (v[:, 1:], v[1:], b))
        return np.stack([self.join_edges(*end) for end in ends])

    def side_vertices(self, side):
        """Vertex numbers along a side, by increasing coordinate."""
        along, up = (
            np.arange(self.nx + 1, dtype=np.int32),
            np.arange(self.ny + 1, dtype=np.int32) * (self.nx + 1),
        )
        return {"bottom": along, "top": up[-1] + along, "left": up, "right": up + self.nx}[side]

    def side_facets(self, side):
        """Facet numbers along a side, by increasing coordinate."""
        h, v, _ = self._positions
        rows = np.arange(self.ny + 1, dtype=np.int32) * (3 * self.nx + 1)
        top = rows[-1] + np.arange(self.nx, dtype=np.int32)
        return {"bottom": h, "top": top, "left": rows[:-1] + v[0], "right": rows[:-1] + v[-1]}[side]

    def sides(self, label):
        """The sides that carry `label`, a tuple of names."""
        return tuple(side for side, name in zip(SIDES, self.labels, strict=True) if name == label)

    def boundary_vertices(self, label):
        """Vertices on the closed sides that carry `label`, increasing, each once."""
        found = [self.side_vertices(side) for side in self.sides(label)]
        return np.unique(np.concatenate(found)) if found else np.zeros(0, dtype=np.int32)

    def boundary_facets(self, label):
        """Facets on the sides that carry `label`, increasing."""
        found = [self.side_facets(side) for side in self.sides(label)]
        return np.sort(np.concatenate(found)) if found else np.zeros(0, dtype=np.int32)

    @cached_property
    def skfem(self):
        """The same triangulation as a scikit-fem mesh, its boundaries named."""
        from skfem import MeshTri

        names = {label: self.boundary_facets(label) for label in sorted(set(self.labels))}
        return MeshTri(self.p, self.t, sort_t=False).with_boundaries(names)

    def same_as(self, other):
        """Whether `other` is the same triangulation, numbered alike."""
        return self == other

    def corner_values(self, u):
        """Values of a vector over the vertices at the corners of each triangle, shape (3, nt)."""
        rows = u.reshape(self.ny + 1, self.nx + 1)
        values = np.empty((3, 2, self.ny, self.nx), dtype=u.dtype)
        for kind, corners in enumerate(self.corners):
            for k, corner in enumerate(corners):
                values[k, kind] = self.window(rows, corner)
        return values.reshape(3, -1)

    in_one_part = True  # all triangles hang together by facets

    def edge_vectors(self, cells):
        """The edges 01, 12 and 20 of a slice of the triangles as vectors, shape (3, 2, length),
        unit of length.
        """
        corners = np.array(self.corners).transpose(1, 2, 0) * np.array(self.spacing)[:, None]
        kind = np.arange(*cells.indices(self.number_of_triangles)) // (self.nx * self.ny)
        return (np.roll(corners, -1, axis=0) - corners)[:, :, kind]

    def vertex_parents(self):
        """Two vertices of `coarser()` for each vertex, shape (2, nv): it is their midpoint, or both
        of them.
        """
        i, j = np.arange(self.nx + 1), np.arange(self.ny + 1)[:, None]
        along = i % 2 * np.where(j % 2 == 1, -1 if self.diagonal == "falling" else 1, 1)
        ends = [
            (j + up * (j % 2)) // 2 * (self.nx // 2 + 1) + (i + up * along) // 2 for up in (-1, 1)
        ]
        return np.stack([end.ravel() for end in ends]).astype(np.int32)

    def gradients(self, values):
        """Gradients of a piecewise affine function given by its values at the corners; see
        `Triangulation`.

        The legs at corner 0 lie along the axes, so each derivative is one difference.
        """
        values = values.reshape(3, 2, -1)
        result = np.empty((2, *values.shape[1:]))
        for kind, (origin, *ends) in enumerate(self.corners):
            for k, end in enumerate(ends, start=1):
                axis = 0 if end[0] != origin[0] else 1
                step = (end[axis] - origin[axis]) * self.spacing[axis]
                np.subtract(values[k, kind], values[0, kind], out=result[axis, kind])
                result[axis, kind] /= step
        return result.reshape(2, -1)

    def coarser(self):
        """The grid of half as many cells along each side, or None where a count is odd."""
        if self.nx % 2 or self.ny % 2:
            return None
        return Grid(self.nx // 2, self.ny // 2, self.origin, self.size, self.diagonal, self.labels)

    def children(self, values):
        """Values on the four children of every triangle of `coarser()`.

        Parameters
        ----------
        values : ndarray, shape (m, nt)
            Numbers of this grid's triangles, m each.

        Returns
        -------
        ndarray, shape (4, m, nt / 4)
            Children 0 to 2 hold the parent's vertices, child 3 is the middle one.
        """
        cells = values.reshape(-1, 2, self.ny, self.nx)
        family = np.empty((4, values.shape[0], 2, self.ny // 2, self.nx // 2), dtype=values.dtype)
        for kind, corners in enumerate(self.corners):
            for child, (i, j) in enumerate((*corners, corners[0])):
                family[child, :, kind] = cells[:, 1 - kind if child == 3 else kind, j::2, i::2]
        return family.reshape(4, values.shape[0], -1)

    def vertex_children(self, values):
        """Values at the vertices of the four children of every triangle of `coarser()`.

        Parameters
        ----------
        values : ndarray, shape (3, nt)
            Values at the vertices of this grid's triangles.

        Returns
        -------
        ndarray, shape (4, 3, nt / 4)
            Local vertex i of child k is the midpoint of the parent's vertices i and k; of child 3,
            that of the two others than i.
        """
        return self.children(values)

    def from_vertex_children(self, family):
        """Undo `vertex_children`: values at the vertices of this grid's triangles, shape (3, nt)."""
        cells = np.empty((3, 2, self.ny, self.nx), dtype=family.dtype)
        family = family.reshape(4, 3, 2, self.ny // 2, self.nx // 2)
        for kind, corners in enumerate(self.corners):
            for child, (i, j) in enumerate((*corners, corners[0])):
                cells[:, 1 - kind if child == 3 else kind, j::2, i::2] = family[child, :, kind]
        return cells.reshape(3, -1)
