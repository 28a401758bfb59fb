"""What happens on each facet of the contact part, for programs that draw facets."""

import numpy as np

from signorini.fem.contact_line import contact_flux
from signorini.fem.elements import find_element
from signorini.mesh.paths import boundary_paths


def contact_facets(mesh, solution):
    """Force, obstacle and contact of each facet of the contact part.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution

    Returns
    -------
    dict
        ``facets`` (m,), numbers of facets; ``contact_force`` (m,), its mean density, unit of k u
        per length: times the lengths it adds up to the force on all contact dofs; ``obstacle``
        (m,), at the midpoint, unit of u, NaN where a facet has no contact dof; ``binding`` (m,),
        the share of the facet that binds: 0, 0.5 or 1. A dof under a Dirichlet condition leaves its
        half to the other, without a force.

    Examples
    --------
    >>> import signorini
    >>> from signorini.api.solving import solve_level
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> solution = solve_level(scene, "CR", 4)
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> contact_facets(mesh, solution)["binding"].tolist()
    [0.0, 0.0, 1.0, 1.0]
    """
    element = find_element(solution.element)
    flux = contact_flux(mesh, element, solution.contact, solution.force)
    given = {"contact_force": flux, "obstacle": solution.lower, "binding": solution.active}
    paths = boundary_paths(mesh, "contact")
    halves = [element.half_facet_dofs(path) for path in paths]
    found = {"facets": _joined([path.facets for path in paths], int)}
    for name, values in given.items():
        of_dofs = np.full(element.size(mesh), np.nan)
        of_dofs[solution.contact] = values
        mean = _sum_of_halves if name == "contact_force" else _mean_of_halves
        pairs = [mean(of_dofs[first], of_dofs[second]) for first, second in halves]
        found[name] = _joined(pairs, float)
    found["binding"] = np.nan_to_num(found["binding"])
    return found


def _joined(parts, kind):
    return np.concatenate([np.zeros(0, kind), *parts])


def _sum_of_halves(first, second):
    return 0.5 * (np.nan_to_num(first) + np.nan_to_num(second))


def _mean_of_halves(first, second):
    """The mean of what there is of two halves."""
    first, second = (
        np.where(np.isnan(first), second, first),
        np.where(np.isnan(second), first, second),
    )
    return 0.5 * (first + second)
