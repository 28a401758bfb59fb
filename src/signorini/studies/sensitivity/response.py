"""How errors respond to small changes of the loads that both solutions were computed with.

While the contact set stays as it is, a solution is linear in its load. So is an error to first
order: with d = u - u_h for a reference u, and (.,.) the inner product of the norm,

    e de = (d, du - du_h) = w . db - w_h . db_h,

where A w = (d, phi) with the reference's shape functions, and the same for w_h with those of u_h.
One solve for each error and side then tells what every change of a load does to it.
"""

from dataclasses import dataclass

import numpy as np

from signorini.fem.stiffness import facet_couplings
from signorini.mesh.locate import locate


@dataclass(frozen=True)
class Response:
    """The errors of a solution, and what changes of the loads do to them.

    Parameters
    ----------
    errors : ndarray, shape (2,)
        In L2, and in H1 by its full norm.
    to_reference, to_own : ndarray, shape (2, ndof)
        Derivatives by the load of the reference, and by that of the solution itself.
    """

    errors: np.ndarray
    to_reference: np.ndarray
    to_own: np.ndarray


class Responses:
    """Responses of errors against one reference.

    Parameters
    ----------
    problem : Problem
        Of the reference, on a `Grid` with coefficient 1.
    solution : Solution
    """

    def __init__(self, problem, solution):
        self._mesh = problem.mesh
        self._inverse = _inverse(problem, solution)
        self._traces = _values_in(problem, self._mesh)
        self._values = self._traces @ solution.u

    def of(self, problem, solution):
        """The response of the errors of a solution on a coarser mesh that nests; a `Response`.

        Parameters
        ----------
        problem : Problem
            On the coarser mesh.
        solution : Solution

        Returns
        -------
        Response
        """
        traces = _values_in(problem, self._mesh)
        d = (self._values - traces @ solution.u).reshape(3, -1)
        moments = self._moments(d)
        errors = np.sqrt([np.vdot(d, moment) for moment in moments])
        right = np.stack([moment.ravel() for moment in moments], axis=1) / errors
        own = _inverse(problem, solution)
        return Response(
            errors=errors,
            to_reference=self._inverse(self._traces.T @ right).T,
            to_own=-own(traces.T @ right).T,
        )

    def _moments(self, d):
        """(d, lambda_i) on each triangle in the inner products of L2 and of H1, (3, nt) each."""
        l2 = self._mesh.area / 12.0 * (d + d.sum(axis=0))
        return {"l2": l2, "h1": l2 + _gradient_moments(self._mesh, d)}.values()


def _gradient_moments(mesh, d):
    moments = np.zeros_like(d)
    for (i, j), coupling in zip(((0, 1), (1, 2), (0, 2)), facet_couplings(mesh), strict=True):
        flux = coupling * (d[j] - d[i])
        moments[i] += flux
        moments[j] -= flux
    return moments


def _values_in(problem, mesh):
    """The matrix from dofs to values at the vertices of each triangle of a finer mesh."""
    from scipy.sparse import csr_array

    corners = mesh.p[:, mesh.t]
    behind, _ = locate(problem.mesh, corners.mean(axis=1))
    own = problem.mesh.p[:, problem.mesh.t[:, behind]]
    shapes = np.stack(
        [problem.finite_element.shape(_barycentric(own, corners[:, i])) for i in range(3)]
    )
    dofs = problem.finite_element.triangle_dofs(problem.mesh)[:, behind]
    columns = np.broadcast_to(dofs, shapes.shape)
    per_row = columns.transpose(0, 2, 1), shapes.transpose(0, 2, 1)
    starts = np.arange(0, columns.size + 1, 3)
    columns, values = (part.ravel() for part in per_row)
    return csr_array((values, columns, starts), shape=(starts.size - 1, problem.b.size))


def _barycentric(corners, points):
    """Of points (2, k) in triangles with corners (2, 3, k)."""
    (ax, bx, cx), (ay, by, cy) = corners
    x, y = points
    doubled = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    second = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / doubled
    third = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / doubled
    return np.stack([1.0 - second - third, second, third])


def _inverse(problem, solution):
    """From right sides (ndof, k) to solutions, zero on the fixed dofs and those that bind."""
    from scipy.sparse.linalg import splu

    free = np.setdiff1d(problem.free, problem.contact[solution.active])
    factors = splu(problem.A[free][:, free].tocsc())

    def apply(right):
        found = np.zeros_like(right)
        found[free] = factors.solve(np.ascontiguousarray(right[free]))
        return found

    return apply
