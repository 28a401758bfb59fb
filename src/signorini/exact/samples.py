"""Where an exact solution is examined: triangles that cover the domain, and points on its sides.

How many there are does not depend on the levels of a scene. The triangles are perturbed, so that a
line along which a formula changes does not run along their edges. They keep a small distance from
the boundary, where a solution may be singular.
"""

from dataclasses import dataclass

import numpy as np

from signorini.fem.quadrature import triangle_rule
from signorini.formula import Formula
from signorini.mesh.boundary import LABELS, SIDES, by_formula
from signorini.mesh.boundary_trace import find_boundary_trace
from signorini.mesh.curved import true_places
from signorini.mesh.domain import Rectangle
from signorini.mesh.grid import Grid
from signorini.mesh.named_mesh import NamedMesh
from signorini.mesh.patterns import perturbed

FEWEST = 2**11  # triangles; a line across a square meets some 60 of them
MOST = 2**15
ON_SIDES = 2**12  # points on the facets of one label: four or more in any 1/1000 of them
_PERTURBATION = 0.7  # in units of `perturbed`
_GAP = 1e-3  # between neighbouring triangles, in units of a triangle


@dataclass(frozen=True, eq=False)
class Samples:
    """Where data and an exact solution are compared.

    Attributes
    ----------
    cells : ndarray, shape (2, 3, m)
        Coordinates of the corners of triangles, inside the domain and apart from each other.
    dirichlet, neumann, contact : tuple of ndarray
        x, y, nx, ny: points on the sides and outward unit normals.
    """

    cells: np.ndarray
    dirichlet: tuple
    neumann: tuple
    contact: tuple

    @property
    def inside(self):
        """x and y of points inside the triangles, nine in each."""
        return np.einsum("dkm,kq->dmq", self.cells, triangle_rule(4)[0]).reshape(2, -1)

    @classmethod
    def of(cls, mesh, boundary=None):
        """Samples of the domain of a mesh.

        Parameters
        ----------
        mesh : Grid or Triangulation
        boundary : dict, optional
            The section ``boundary`` of a scene where it is by formula: then points have a label
            rather than facets.

        Returns
        -------
        Samples

        Examples
        --------
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> samples = Samples.of(Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels))
        >>> samples.cells.shape
        (2, 3, 2048)
        """
        while mesh.number_of_triangles < FEWEST:
            mesh = _finer(mesh)
        sides = {label: _on_side(mesh, label) for label in LABELS}
        if boundary:
            sides = _labelled(sides.values(), boundary)
        return cls(_cells(mesh), **sides)

    @classmethod
    def of_domain(cls, domain, coarsest):
        """Samples of a domain, which do not depend on the levels of a scene.

        Parameters
        ----------
        domain : Rectangle or Refined
            Of a rectangle the samples are the same for all patterns.
        coarsest : int
            The coarsest level, from which domains other than rectangles are refined.

        Returns
        -------
        Samples

        Examples
        --------
        >>> from signorini.mesh.rectangle import Rectangle
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> square = Rectangle((0.0, 0.0), (1.0, 1.0), "falling", "per-unit", sides)
        >>> samples = Samples.of_domain(square, 2)
        >>> samples.cells.shape
        (2, 3, 2048)
        """
        boundary = domain.boundary if domain.boundary and by_formula(domain.boundary) else None
        if not isinstance(domain, Rectangle):
            return cls.of(domain.level(coarsest), boundary)
        origin, size = tuple(map(float, domain.origin)), tuple(map(float, domain.size))
        # Where the boundary is by formula, points get labels of their own, and any will do here.
        labels = ("neumann",) * 4 if boundary else tuple(domain.boundary[side] for side in SIDES)
        return cls.of(Grid(*_counts(*size), origin, size, "falling", labels), boundary)


def _counts(width, height):
    """Cells along x and y, nearly squares, of which there are enough."""
    columns = round(float(np.clip((FEWEST / 2 * width / height) ** 0.5, 4, FEWEST / 8)))
    return columns, -(-FEWEST // (2 * columns))


def _finer(mesh):
    if isinstance(mesh, Grid):
        return Grid(2 * mesh.nx, 2 * mesh.ny, mesh.origin, mesh.size, mesh.diagonal, mesh.labels)
    return mesh.refined()


def _cells(mesh):
    """Corners of the perturbed triangles, every second, third, ... one where there are too many."""
    ends = {label: mesh.facets[:, mesh.boundary_facets(label)] for label in LABELS}
    t = _counterclockwise(mesh)
    p = perturbed(NamedMesh(mesh.p, t, ends), _PERTURBATION, seed=0).p
    stride = -(-t.shape[1] // MOST)
    corners = p[:, t[:, ::stride]]
    centroids = corners.mean(axis=1, keepdims=True)
    return corners + _GAP * (centroids - corners)


def _counterclockwise(mesh):
    a, b, c = mesh.p[:, mesh.t].transpose(1, 0, 2)
    (abx, aby), (acx, acy) = b - a, c - a
    return np.where(abx * acy > aby * acx, mesh.t, mesh.t[[1, 0, 2]])


def _on_side(mesh, label):
    """x, y, nx, ny of evenly spaced points on the facets with a label, three on each at least."""
    trace = find_boundary_trace(mesh, label)
    total = max(trace.length.sum(), np.finfo(float).tiny)  # zero where no facet has the label
    counts = np.maximum(3, np.ceil(ON_SIDES * trace.length / total)).astype(int)
    points, facets = trace.evenly_spaced(counts)
    points, normals = true_places(mesh, trace.facets[facets], points, trace.normal[:, facets])
    return (*points, *normals)


def _labelled(sides, boundary):
    """The points of all sides together, sorted by the formula that is positive at them."""
    points = np.concatenate(list(sides), axis=1)
    x, y = points[:2]
    nowhere = np.zeros(x.shape, dtype=bool)
    carries = dict.fromkeys(LABELS, nowhere)
    for label, text in boundary.items():
        if text != "rest":
            carries[label] = Formula(text, f"boundary.{label}")(x, y) > 0.0
    rest = ~np.any(list(carries.values()), axis=0)
    for label, text in boundary.items():
        if text == "rest":
            carries[label] = rest
    return {label: tuple(points[:, at]) for label, at in carries.items()}
