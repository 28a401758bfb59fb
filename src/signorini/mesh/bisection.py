r"""Local refinement by newest-vertex bisection (Mitchell 1991), conforming, of bounded shape.

The facet between local vertices 0 and 1 of a triangle is the one that its next bisection halves.
The two halves of a triangle 012, cut at the middle m of that facet, are 20m and 12m: their own
first facets are those that the middle is opposite to::

          2                     2
         / \                   /|\
        /   \       ->        / | \
       /     \               /  |  \
      0 ----- 1             0 --m-- 1

A triangle that is marked has all its three facets halved: it becomes four, by bisecting its halves
too. Triangles of at most four similarity classes come from each triangle of the first mesh.
"""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.boundary import LABELS, SIDES, part_key
from signorini.mesh.curved import curves_of, followed
from signorini.mesh.triangulation import Triangulation


@dataclass(frozen=True, eq=False)
class Bisected(Triangulation):
    """A triangulation that was bisected from a coarser one; its vertices come first, in order.

    Parameters
    ----------
    p, t, ends, subdomains
        As of a `Triangulation`.
    origin : Grid or Triangulation
        The coarser mesh.
    pairs : ndarray of int, shape (2, nv)
        Two vertices of it for each vertex: twice the same where the vertex was there already,
        otherwise those that it lies between.
    ancestor : ndarray of int, shape (nt,)
        The triangle of it that each triangle lies in.
    """

    origin: object = None
    pairs: np.ndarray = None
    ancestor: np.ndarray = None

    def coarser(self):
        """The mesh this one was bisected from."""
        return self.origin

    def vertex_parents(self):
        """Two vertices of `coarser()` for each vertex; see `Grid.vertex_parents`."""
        return self.pairs

    @property
    def in_one_part(self):
        """Whether all triangles hang together by facets."""
        return self.origin.in_one_part

    def children(self, values):
        """Refused: a triangle of `coarser()` has no fixed number of children.

        Raises
        ------
        MeshError
            In any case.
        """
        raise MeshError(
            "mesh: errors against a finer mesh need uniform refinements; "
            "this mesh is locally refined: use an exact truth or a certificate"
        )

    from_children = children


def bisectable(mesh):
    """A mesh in which each triangle's longest edge is the first to be halved.

    Parameters
    ----------
    mesh : Grid or Triangulation

    Returns
    -------
    Triangulation
        The mesh itself where it is bisected already. Otherwise the same vertices and triangles,
        these turned; the meshes that it was refined from remain its coarser ones.

    Examples
    --------
    In each triangle the longest edge, here the diagonal, is the first one:

    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = bisectable(Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    >>> (mesh.p[:, mesh.t[0]] - mesh.p[:, mesh.t[1]]).T.tolist()
    [[1.0, -1.0], [-1.0, 1.0]]
    """
    if isinstance(mesh, Bisected):
        return mesh
    p, t = np.asarray(mesh.p), np.asarray(mesh.t)
    labels = getattr(mesh, "ends", (*LABELS, *map(part_key, SIDES)))
    ends = {label: mesh.facet_ends(mesh.boundary_facets(label)) for label in labels}
    turned = _longest_first(p, t)
    subdomains = getattr(mesh, "subdomains", {})
    parts = p, turned, ends, subdomains, None, curves_of(mesh)
    coarser = mesh.coarser()
    if coarser is None:
        return Triangulation(*parts)
    ancestor = np.empty(t.shape[1], dtype=np.int32)
    ancestor[mesh.children(np.arange(t.shape[1])[None])[:, 0]] = np.arange(
        coarser.number_of_triangles
    )
    return Bisected(*parts, coarser, mesh.vertex_parents(), ancestor)


def bisect(mesh, marked):
    """Refine a mesh where it is marked.

    Parameters
    ----------
    mesh : Grid or Triangulation
    marked : ndarray of bool, shape (nt,)
        Triangles to cut into four. Others are bisected only where the mesh must stay conforming.

    Returns
    -------
    Bisected
        Labels of the boundary and subdomains are inherited.

    Raises
    ------
    MeshError
        If a facet is too short to have a middle between its ends.

    Examples
    --------
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> mesh = Triangulation([[0, 1, 0, ], [0, 0, 1]], [[0], [1], [2]], ends)
    >>> finer = bisect(mesh, np.array([True]))
    >>> finer.number_of_vertices, finer.number_of_triangles
    (6, 4)
    """
    mesh = bisectable(mesh)
    count = mesh.number_of_vertices
    halved = _closed(mesh.t2f, np.asarray(marked, dtype=bool), mesh.number_of_facets)
    middle = np.where(halved, count + np.cumsum(halved) - 1, -1)
    t, ancestor = _cut_twice(mesh.t, middle[mesh.t2f])
    cut_facets = mesh.facets[:, halved]
    own = np.arange(count, dtype=np.int32)
    ends = {label: _halves(mesh, label, middle) for label in mesh.ends}
    p = np.hstack([mesh.p, _middles(mesh.p, cut_facets)])
    return Bisected(
        p=followed(p, t, mesh.curves, ends, first=count),
        t=t,
        ends=ends,
        curves=mesh.curves,
        subdomains={name: _within(ancestor, cells) for name, cells in mesh.subdomains.items()},
        origin=mesh,
        pairs=np.hstack([np.stack([own, own]), cut_facets]),
        ancestor=ancestor,
    )


def over_ancestors(mesh, values):
    """Least, mean and greatest value on each triangle of a mesh's coarser one.

    Parameters
    ----------
    mesh : Grid or Triangulation
        With a coarser mesh, of whatever refinement.
    values : ndarray, shape (nt,)

    Returns
    -------
    least, mean, greatest : ndarray, shape (nt of mesh.coarser(),)
        The mean by area; unit of the values.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> fine = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> least, mean, greatest = over_ancestors(fine, np.arange(8.0))
    >>> least.tolist(), mean.tolist(), greatest.tolist()
    ([0.0, 3.0], [1.75, 5.25], [4.0, 7.0])
    """
    if not isinstance(mesh, Bisected):
        family = mesh.children(values[None])[:, 0]
        return family.min(axis=0), family.mean(axis=0), family.max(axis=0)
    count = mesh.origin.number_of_triangles
    least, greatest = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(least, mesh.ancestor, values)
    np.maximum.at(greatest, mesh.ancestor, values)
    integrals = np.bincount(mesh.ancestor, values * mesh.area, minlength=count)
    areas = np.bincount(mesh.ancestor, mesh.area, minlength=count)
    return least, np.clip(integrals / areas, least, greatest), greatest


def _longest_first(p, t):
    """The triangles, turned so that the longest edge joins local vertices 0 and 1.

    Among edges that rounding alone tells apart, the first is taken.
    """
    sides = [p[:, t[(i + 1) % 3]] - p[:, t[i]] for i in range(3)]
    squares = np.array([(side**2).sum(axis=0) for side in sides])
    first = np.argmax(squares > (1 - 1e-9) * squares.max(axis=0), axis=0)
    return np.take_along_axis(t, (first + np.arange(3)[:, None]) % 3, axis=0)


def _closed(t2f, marked, count):
    """The facets to halve, a mask of shape (count,).

    Those of marked triangles, and the first of every triangle that has one of them.
    """
    halved = np.zeros(count, dtype=bool)
    halved[t2f[:, marked]] = True
    late = np.ones(1, dtype=bool)
    while late.any():
        late = halved[t2f].any(axis=0) & ~halved[t2f[0]]
        halved[t2f[0, late]] = True
    return halved


def _middles(p, facets):
    middles = p[:, facets].mean(axis=1)
    for end in facets:
        stuck = np.all(middles == p[:, end], axis=0)
        if stuck.any():
            x, y = p[:, end[np.argmax(stuck)]]
            raise MeshError(
                f"mesh: a facet at ({x:.6g}, {y:.6g}) has no point between its ends in double "
                "precision; ask for a larger bound, or move the domain nearer to the origin"
            )
    return middles


def _cut_twice(t, middles):
    """The triangles after both bisections, and which one each lies in.

    Parameters
    ----------
    t : ndarray of int, shape (3, nt)
    middles : ndarray of int, shape (3, nt)
        The new vertices amid the facets 01, 12 and 02; -1 where there is none.
    """
    number = np.arange(t.shape[1])
    t, number, later = _cut(t, number, middles[0], middles[[2, 1]])
    t, number, _ = _cut(t, number, later, np.full((2, later.size), -1))
    return t.astype(np.int32), number


def _cut(t, number, middle, others):
    """Bisect each triangle abc with a vertex m amid ab into cam and bcm.

    Their own first facets are ca and bc, whose new vertices `others` gives, shape (2, nt).
    """
    cut = middle >= 0
    (a, b, c), m = t[:, cut], middle[cut]
    whole = t[:, ~cut]
    later = np.concatenate([np.full(whole.shape[1], -1), *others[:, cut]])
    numbers = np.concatenate([number[~cut], number[cut], number[cut]])
    return np.hstack([whole, [c, a, m], [b, c, m]]), numbers, later


def _halves(mesh, label, middle):
    """The ends of the facets that carry a label, those with a vertex amid them cut in two."""
    facets = mesh.boundary_facets(label)
    start, end = mesh.facets[:, facets]
    m = middle[facets]
    cut = m >= 0
    whole = np.stack([start, end])[:, ~cut]
    return np.hstack([whole, [start[cut], m[cut]], [m[cut], end[cut]]])


def _within(ancestor, cells):
    """The triangles that lie in some triangles of the coarser mesh, increasing."""
    member = np.zeros(ancestor.max(initial=-1) + 1, dtype=bool)
    member[cells] = True
    return np.flatnonzero(member[ancestor])
