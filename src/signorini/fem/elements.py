"""P1 and CR: the one place that knows how the two elements differ."""

import difflib
from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SceneError


@dataclass(frozen=True)
class Element:
    """A piecewise affine element; its degrees of freedom are its values at the nodes.

    ``basis[i]`` holds the values of local shape function i at the three vertices of a triangle.
    """

    name: str
    title: str
    basis: np.ndarray

    @property
    def nodes_of_triangle(self):
        """Barycentric coordinates of the nodes of the local shape functions, (3, 3): a column each."""
        return np.linalg.inv(self.basis)

    def shape(self, barycentric):
        """Values of the local shape functions, (3, q), at points of barycentric coordinates (3, q)."""
        return self.basis @ barycentric


class _P1(Element):
    def size(self, mesh):
        """Number of degrees of freedom."""
        return mesh.number_of_vertices

    def triangle_dofs(self, mesh):
        """Global numbers of the local degrees of freedom, shape (3, nt)."""
        return mesh.t

    def vertex_values(self, mesh, u):
        """Values of the discrete function at the vertices of each triangle, shape (3, nt)."""
        return mesh.corner_values(u)

    def boundary_dofs(self, mesh, label):
        """Degrees of freedom on the closed part `label` of the boundary, increasing."""
        return mesh.boundary_vertices(label)

    def boundary_lengths(self, mesh, label):
        """What length of the part `label` of the boundary each degree of freedom stands for, shape
        (ndof,).
        """
        ends, lengths = _facets_of(mesh, label)
        return np.bincount(np.ravel(ends), np.tile(0.5 * lengths, 2), minlength=self.size(mesh))

    def nodes(self, mesh, dofs):
        """Coordinates of degrees of freedom, shape (2, len(dofs))."""
        return mesh.points(dofs)

    def skfem(self):
        """The element as scikit-fem knows it."""
        from skfem import ElementTriP1

        return ElementTriP1()


class _CR(Element):
    def size(self, mesh):
        """Number of degrees of freedom."""
        return mesh.number_of_facets

    def triangle_dofs(self, mesh):
        """Global numbers of the local degrees of freedom, shape (3, nt)."""
        return mesh.t2f

    def vertex_values(self, mesh, u):
        """Values of the discrete function at the vertices of each triangle, shape (3, nt)."""
        return self.basis.T @ u[self.triangle_dofs(mesh)]

    def boundary_dofs(self, mesh, label):
        """Degrees of freedom on the part `label` of the boundary, increasing."""
        return mesh.boundary_facets(label)

    def boundary_lengths(self, mesh, label):
        """What length of the part `label` of the boundary each degree of freedom stands for, shape
        (ndof,).
        """
        return np.bincount(
            mesh.boundary_facets(label), _facets_of(mesh, label)[1], minlength=self.size(mesh)
        )

    def nodes(self, mesh, dofs):
        """Coordinates of degrees of freedom, shape (2, len(dofs)): midpoints of facets."""
        start, end = mesh.facet_ends(dofs)
        return 0.5 * (mesh.points(start) + mesh.points(end))

    def skfem(self):
        """The element as scikit-fem knows it."""
        from skfem import ElementTriCR

        return ElementTriCR()


def _facets_of(mesh, label):
    """End vertices of the facets that carry a label, shape (2, k), and their lengths."""
    ends = mesh.facet_ends(mesh.boundary_facets(label))
    start, end = (mesh.points(vertices) for vertices in ends)
    return ends, np.hypot(*(end - start))


# The CR function of the facet (i, j) is 1 at its two ends and -1 at the opposite vertex; facets run
# 01, 12, 02.
ELEMENTS = {
    "P1": _P1("P1", "conforming P1", np.eye(3)),
    "CR": _CR(
        "CR", "Crouzeix-Raviart", np.array([[1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0]])
    ),
}


def element(name):
    """Look an element up by name.

    Raises
    ------
    SceneError
        If there is none of that name.
    """
    if name not in ELEMENTS:
        near = difflib.get_close_matches(str(name).upper(), ELEMENTS, n=1, cutoff=0.3)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise SceneError(f"elements: unknown element {name!r}; known: {', '.join(ELEMENTS)}{hint}")
    return ELEMENTS[name]
