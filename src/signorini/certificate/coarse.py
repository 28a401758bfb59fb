"""Solutions of coarse levels, certified by one enclosure on a refinement of their meshes.

With the middle m of the enclosure, |grad u - grad u_h| lies within its radius of |m - grad u_h|. On
a coarse triangle grad u_h is constant, so that with the mean of m over it

    |m - grad u_h|^2 = |m - mean|^2 + |T| |mean - grad u_h|^2,

and |m - mean|^2 adds up over the meshes between, as in `errors.reference`.
"""

from typing import NamedTuple

import numpy as np

from signorini.certificate.l2 import mean_square
from signorini.exceptions import MeshError, SceneError
from signorini.fem.elements import find_element


class Interval(NamedTuple):
    """lower <= error <= upper, in the energy norm."""

    lower: float
    upper: float


class CoarseErrors:
    """Energy errors of solutions on the coarser meshes of an enclosure.

    Parameters
    ----------
    enclosure : Enclosure
        Of -u where the constraint is from above.

    Raises
    ------
    SceneError
        If the diffusion coefficient is not 1.
    """

    def __init__(self, enclosure):
        topology = enclosure.topology
        if topology.coefficient is not None:
            raise SceneError(
                "data.coefficient: coarse solutions are certified by a fine mesh only where it is "
                "1; certify each level on its own mesh"
            )
        self.mesh, self.radius = topology.mesh, enclosure.radius
        self._sign = -1.0 if enclosure.data.constraint == "upper" else 1.0
        self._lost, self._means = _means(enclosure)
        self._rest = float(np.sqrt(np.sum(enclosure.admissible.rest**2)))

    def of(self, mesh, element, u):
        """The `Interval` of the energy error of a discrete solution.

        Parameters
        ----------
        mesh : Grid or Triangulation
            That of the enclosure, or one that it was refined from.
        element : {"P1", "CR"} or Element
        u : ndarray, shape (ndof,)

        Returns
        -------
        Interval

        Raises
        ------
        MeshError
            If the fine mesh is no refinement of `mesh`.
        """
        lost, means = self._down_to(mesh)
        slopes = mesh.gradients(find_element(element).vertex_values(mesh, u))
        away = ((means - self._sign * slopes) ** 2).sum(axis=0)
        distance = float(np.sqrt(lost + np.sum(mesh.area * away)))
        margin = self.radius + 0.5 * self._rest
        return Interval(max(distance - margin, 0.0), distance + margin)

    def _down_to(self, mesh):
        """|m - mean|^2 over the body, and the means on each triangle of a coarser mesh."""
        own, lost, means = self.mesh, self._lost, self._means
        while not own.same_as(mesh):
            coarse = own.coarser()
            if coarse is None or coarse.number_of_triangles < mesh.number_of_triangles:
                raise MeshError("mesh: the fine mesh was not refined from this one")
            family = own.children(means)
            means = family.mean(axis=0)
            area = np.broadcast_to(coarse.area, coarse.number_of_triangles) / 4.0
            lost += float((area * ((family - means) ** 2).sum(axis=(0, 1))).sum())
            own = coarse
        return lost, means


def _means(enclosure):
    """|m - mean|^2 over the body, and the mean of m on each triangle, (2, nt)."""
    topology = enclosure.topology
    means, lost = np.empty((2, topology.count)), 0.0
    for piece in topology.pieces():
        V, Q = enclosure.middle_on(piece).vectors(piece)
        mean = V.mean(axis=0) + Q.sum(axis=0) / 12.0
        means[:, piece.cells] = mean
        lost += float((piece.area * _mean_square(V - mean, Q)).sum())
    return lost, means


def _mean_square(V, Q):
    """That of sum V_i lambda_i + sum Q_i lambda_i lambda_(i+1), as in `l2`, of vectors."""
    return sum(mean_square(V[:, axis], Q[:, axis]) for axis in (0, 1))
