"""What figures show of the triangles of a scene's finest level: errors, jumps, parts of bounds."""

import numpy as np

from signorini.errors.local import gradient_errors, gradient_errors_by_reference
from signorini.fem.coefficient import coefficient_on
from signorini.fem.jumps import facet_jumps
from signorini.mesh.boundary import LABELS
from signorini.report.field import edges_of

LINES_SEEN = 6000  # triangles of a mesh whose lines can still be told apart on a page


def details_of(scene, domain, solutions, reference=None, certificate=None):
    """Measure what is local on the level of some solutions.

    Parameters
    ----------
    scene : Scene
        Tells the exact solution, where it has one, and the diffusion coefficient k.
    domain : Rectangle or Refined
        Makes the meshes.
    solutions : sequence of StoredSolution
        Of one level, one of each element.
    reference : StoredSolution, optional
        Where there is no exact solution: what errors are measured against.
    certificate : signorini.certificate.level.Level, optional
        Of the same level.

    Returns
    -------
    dict
        ``p`` (2, nv), unit of length, and ``t`` (3, nt): the mesh; ``n``, its level;
        ``edges_dirichlet``, ``edges_contact`` and ``edges_neumann`` (2, k), ends of its boundary
        facets. For each element, as far as there is a truth, ``error_ELEMENT`` (nt,): the root mean
        square of sqrt(k) grad (u - u_h) on each triangle. With a certificate, ``bound_ELEMENT``
        (nt,): the same of the guaranteed bound. For CR, ``jump_ends`` (2, m) and ``jump`` (m,),
        see `facet_jumps`. The finest mesh whose lines can be told apart, one of its coarser levels
        or itself: ``mesh_p``, ``mesh_t``, ``mesh_n`` and ``mesh_edges_LABEL``.
    """
    n = solutions[0].n
    mesh = domain.level(n)
    found = {"p": mesh.p, "t": mesh.t, "n": np.array(n)} | _edges(mesh)
    for solution in solutions:
        found |= _errors(scene, domain, mesh, solution, reference)
        found |= _bounds(mesh, solution.element, certificate)
        if solution.element == "CR":
            ends, jumps = facet_jumps(mesh, "CR", solution.u)
            found |= {"jump_ends": ends, "jump": jumps}
    return found | _drawable(mesh, n)


def _edges(mesh):
    return {f"edges_{label}": edges_of(mesh, label) for label in LABELS}


def _errors(scene, domain, mesh, solution, reference):
    """The error of a solution on each triangle, weighted as the energy is."""
    statement, element = scene.problem_statement, solution.element
    if statement.exact is not None:
        errors = gradient_errors(mesh, element, solution.u, statement.exact)
    elif reference is not None:
        finer = domain.level(reference.n)
        errors = gradient_errors_by_reference(mesh, element, solution.u, finer, reference)
    else:
        return {}
    weight = coefficient_on(mesh, statement.data.coefficient)
    return {f"error_{element}": errors if weight is None else np.sqrt(weight) * errors}


def _bounds(mesh, element, certificate):
    """The root of the mean, on each triangle, of what the square of the bound adds up."""
    if certificate is None or element not in certificate.elements:
        return {}
    contribution = certificate.of_triangles(element)["contribution"]
    return {f"bound_{element}": np.sqrt(contribution / mesh.area)}


def _drawable(mesh, n):
    """The finest mesh whose lines can be told apart, or the coarsest there is."""
    coarser = mesh.coarser()
    while mesh.number_of_triangles > LINES_SEEN and coarser is not None:
        mesh, n = coarser, n // 2
        coarser = mesh.coarser()
    edges = {f"mesh_{name}": ends for name, ends in _edges(mesh).items()}
    return {"mesh_p": mesh.p, "mesh_t": mesh.t, "mesh_n": np.array(n)} | edges
