"""Facets on a part of the boundary, each with the triangle behind it."""

from dataclasses import dataclass, fields

import numpy as np

from signorini.certificate.pieces import NEXT
from signorini.fem.by_part import ByPart
from signorini.mesh.boundary import part_key
from signorini.mesh.boundary_trace import outward_normals


@dataclass(frozen=True, eq=False)
class Trace:
    """m boundary facets, each walked from the corner of its triangle's own number to the next.

    Attributes
    ----------
    facets, cells : ndarray of int, shape (m,)
        The facets, and the triangles behind them.
    local : ndarray of int, shape (m,)
        Which of the triangle's facets each is.
    vertices : ndarray of int, shape (2, m)
        Start and end.
    start, end, normal : ndarray, shape (2, m)
        Coordinates, and the outward unit normal.
    length : ndarray, shape (m,)
    area : ndarray, shape (m,)
        Of the triangles.
    slopes : ndarray, shape (2, 2, m)
        Gradients of the barycentric coordinates of start and end.
    sense : ndarray, shape (m,)
        1 where the triangle lies to the left of the way, else -1.
    coefficient : ndarray, shape (m,)
        Of the triangles.
    """

    facets: np.ndarray
    cells: np.ndarray
    local: np.ndarray
    vertices: np.ndarray
    start: np.ndarray
    end: np.ndarray
    normal: np.ndarray
    length: np.ndarray
    area: np.ndarray
    slopes: np.ndarray
    sense: np.ndarray
    coefficient: np.ndarray

    @property
    def middle(self):
        """Their midpoints, shape (2, m).

        Examples
        --------
        >>> from signorini.certificate.pieces import Topology
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> trace(Topology(grid), "contact").middle.ravel().tolist()
        [0.5, 0.0]
        """
        return 0.5 * (self.start + self.end)

    @property
    def outward(self):
        """1 where the outward normal is the facet's own, see `Piece.signs`, else -1, shape (m,)."""
        return np.where(self.vertices[1] > self.vertices[0], self.sense, -self.sense)

    def only(self, chosen):
        """Some of the facets, by their places or a mask.

        Examples
        --------
        >>> from signorini.certificate.pieces import Topology
        >>> from signorini.mesh.grid import Grid
        >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
        >>> trace(Topology(grid), "contact").only([0, 1]).length.tolist()
        [0.5, 0.5]
        """
        parts = {field.name: getattr(self, field.name)[..., chosen] for field in fields(self)}
        return Trace(**parts)

    def points(self, s):
        """Coordinates x and y at the fractions `s`, shape (q,), of the way: both (m, q).

        Examples
        --------
        >>> from signorini.certificate.pieces import Topology
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> trace(Topology(grid), "contact").points(np.array([0.25, 0.75])).tolist()
        [[[0.25, 0.75]], [[0.0, 0.0]]]
        """
        along = self.end - self.start
        return self.start[:, :, None] + along[:, :, None] * s

    def at(self, datum, s):
        """A datum at the fractions `s`, shape (q,), of each facet: (m, q).

        Parameters
        ----------
        datum : Formula or Function
        s : ndarray, shape (q,)
            Fractions of the way along a facet.

        Returns
        -------
        ndarray, shape (m, q)
            Unit of the datum.

        Examples
        --------
        >>> from signorini.certificate.pieces import Topology
        >>> from signorini.formula import Formula
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> trace(Topology(grid), "contact").at(Formula("4*x"), np.array([0.25, 0.5])).tolist()
        [[1.0, 2.0]]
        """
        normal = ()
        if getattr(datum, "needs_normal", False):
            normal = self.normal[:, :, None]
        return datum(*self.points(s), *normal)


def trace(topology, label):
    """The `Trace` of a mesh on the facets that carry a label, or the key of a part.

    Parameters
    ----------
    topology : Topology
    label : str
        ``"dirichlet"``, ``"contact"``, ``"neumann"``, or a `part_key`.

    Returns
    -------
    Trace

    Examples
    --------
    >>> from signorini.certificate.pieces import Topology
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> found = trace(Topology(Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)), "contact")
    >>> found.middle.tolist(), found.normal[1].tolist()
    ([[0.25, 0.75], [0.0, 0.0]], [-1.0, -1.0])
    """
    mesh = topology.mesh
    labelled = np.zeros(mesh.number_of_facets, dtype=bool)
    labelled[mesh.boundary_facets(label)] = True
    local, cells = topology.boundary[:, labelled[topology.t2f[tuple(topology.boundary)]]]
    t = topology.t[:, cells]
    columns = np.arange(cells.size)
    first, second = t[local, columns], t[np.array(NEXT)[local], columns]
    third = t[(local + 2) % 3, columns]
    start, end, opposite = (mesh.points(vertices) for vertices in (first, second, third))
    along, length = end - start, np.hypot(*(end - start))
    inward = opposite - start
    doubled = along[0] * inward[1] - along[1] * inward[0]
    back = opposite - end
    slopes = np.stack([[-back[1], back[0]], [inward[1], -inward[0]]]) / doubled
    k = topology.coefficient
    return Trace(
        facets=topology.t2f[local, cells],
        cells=cells,
        local=local,
        vertices=np.stack([first, second]),
        start=start,
        end=end,
        normal=outward_normals(along, length, inward),
        length=length,
        area=0.5 * np.abs(doubled),
        slopes=slopes,
        sense=np.sign(doubled),
        coefficient=np.ones(cells.size) if k is None else k[cells],
    )


def given_on(topology, trace, datum):
    """A datum on a trace, part by part where it is given so.

    Parameters
    ----------
    topology : Topology
    trace : Trace
    datum : Formula, Function or ByPart

    Returns
    -------
    list of (ndarray of bool or slice, datum)
        Which facets, and the datum there; facets in no part have none.

    Examples
    --------
    >>> from signorini.certificate.pieces import Topology
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", ("contact",) * 4)
    >>> topology, zero = Topology(grid), Formula("0")
    >>> given_on(topology, trace(topology, "contact"), zero) == [(slice(None), zero)]
    True
    """
    if not isinstance(datum, ByPart):
        return [(slice(None), datum)]
    facets = topology.mesh.boundary_facets
    return [
        (np.isin(trace.facets, facets(part_key(name))), own) for name, own in datum.parts.items()
    ]


def sampled(topology, trace, datum, s):
    """A datum at the fractions `s`, shape (q,), of each facet; zero where none is given: (m, q).

    Parameters
    ----------
    topology : Topology
    trace : Trace
    datum : Formula, Function or ByPart
    s : ndarray, shape (q,)
        Fractions of the way along a facet.

    Returns
    -------
    ndarray, shape (m, q)
        Unit of the datum.

    Examples
    --------
    >>> from signorini.certificate.pieces import Topology
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> topology = Topology(Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    >>> sampled(topology, trace(topology, "contact"), Formula("4*x"), np.array([0.25])).tolist()
    [[1.0]]
    """
    values = np.zeros((trace.facets.size, s.size))
    for chosen, own in given_on(topology, trace, datum):
        values[chosen] = own.constant if own.constant is not None else trace.only(chosen).at(own, s)
    return values


def is_constant(datum):
    """Whether a datum is known to be constant on each of its parts.

    Examples
    --------
    >>> from signorini.formula import Formula
    >>> parts = ByPart({"left": Formula("1"), "right": Formula("x")}, "g")
    >>> is_constant(Formula("2*pi")), is_constant(parts)
    (True, False)
    """
    parts = datum.parts.values() if isinstance(datum, ByPart) else [datum]
    return all(part.constant is not None for part in parts)
