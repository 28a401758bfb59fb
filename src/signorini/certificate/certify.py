"""Certificates of both elements on one mesh."""

import numpy as np

from signorini.certificate.bounds import certify_cr, certify_p1
from signorini.certificate.enclosure import enclose
from signorini.certificate.mirror import mirrored
from signorini.certificate.pieces import Topology
from signorini.exceptions import FormulaError, MeshError, SolverError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import BySubdomain
from signorini.fem.elements import find_element

# Barycentric coordinates: near the corners and the middles of the sides, where a line first cuts a
# triangle, but not so near that the last digits of a vertex count; and in between.
_NEAR = 1e-3
_SAMPLES = np.concatenate(
    [
        np.full((3, 3), near) + (1.0 - 3.0 * near) * inner
        for near in (_NEAR, 0.1)
        for inner in (np.eye(3), 0.5 - 0.5 * np.eye(3))
    ]
)
_ROUNDING = 1e-12


def certify_level(mesh, data, u_p1, u_cr, rule="exact", published=None, A=None, friedrichs=None):
    """Bound the errors of both elements on one mesh; no truth is needed.

    Parameters
    ----------
    mesh : Grid or Triangulation
    data : Data
    u_p1 : ndarray, shape (nv,)
        The P1 solution, by whatever load quadrature.
    u_cr : ndarray, shape (nf,)
        The CR solution, its load integrated by `rule`.
    rule : str or int, optional
        Exact for f: the bounds hold for f as far as this rule integrates it.
    published : ndarray, shape (nf,), optional
        The CR function to be certified where it is not `u_cr`: a solution by another quadrature.
    A : scipy.sparse.csr_array, optional
        CR's stiffness matrix, where it is there already.
    friedrichs : float, optional
        `friedrichs_constant` of the body, where it is known from another mesh of it.

    Returns
    -------
    certificates : dict of str to Certificate
        By element.
    enclosure : Enclosure
        Where the constraint is from above, of -u.

    Raises
    ------
    SolverError
        If `u_cr` is no solution, or a vector belongs to another mesh.
    SceneError, FormulaError
        If the data admit no bound.

    Examples
    --------
    >>> import signorini
    >>> from signorini.solvers import solve
    >>> scene = signorini.load_scene("config/scenes/corner.yaml")
    >>> problems = [scene.problem(element, 8) for element in ("P1", "CR")]
    >>> u_p1, u_cr = (solve(problem).u for problem in problems)
    >>> found, _ = certify_level(problems[0].mesh, problems[0].data, u_p1, u_cr)
    >>> found["P1"].lower < 0.08825 < found["P1"].upper  # the exact solution's error is .088244
    True
    """
    for element, u in (("P1", u_p1), ("CR", u_cr), ("CR", published)):
        _check_size(mesh, element, u)
    _check_straight(mesh)
    if data.constraint == "upper":
        minus = None if published is None else -published
        return certify_level(mesh, mirrored(data), -u_p1, -u_cr, rule, minus, A, friedrichs)
    coefficient = coefficient_on(mesh, data.coefficient)
    _check_coefficient(mesh, data.coefficient, coefficient)
    topology = Topology(mesh, coefficient)
    enclosure = enclose(topology, data, rule, u_p1, u_cr, A, friedrichs)
    certificates = {
        "P1": certify_p1(enclosure, u_p1),
        "CR": certify_cr(enclosure, u_cr if published is None else published),
    }
    return certificates, enclosure


def _check_size(mesh, element, u):
    size = find_element(element).size(mesh)
    if u is not None and np.shape(u) != (size,):
        raise SolverError(
            f"certificate: {element} has {size} degrees of freedom on this mesh, and u has shape "
            f"{np.shape(u)}; give the solution of this level"
        )


def _check_straight(mesh):
    if getattr(mesh, "curves", None):
        raise MeshError(
            "domain.boundary_shape: the triangles do not fill a curved body, so that nothing of it "
            "is certified; drop the curves to certify the polygon"
        )


def _check_coefficient(mesh, given, coefficient):
    """Refuse a coefficient that varies within a triangle: the flux would be in no equilibrium."""
    if isinstance(given, BySubdomain) or given.constant is not None:
        return
    corners = mesh.p[:, mesh.t]
    x, y = np.einsum("qi,aim->aqm", _SAMPLES, corners)
    k = 1.0 if coefficient is None else coefficient
    off = np.abs(given(x, y) - k) > _ROUNDING * k
    if off.any():
        at = np.unravel_index(np.argmax(off), off.shape)
        raise FormulaError(
            f"{given.field}: {given.text} varies within the triangle at ({x[at]:.6g}, "
            f"{y[at]:.6g}); a certificate needs a coefficient that is constant on each triangle: "
            "give a number, or one for each subdomain; or let the mesh follow the lines at "
            "which it jumps"
        )
