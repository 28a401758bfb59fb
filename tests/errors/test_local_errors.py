"""Errors triangle by triangle add up to the norms, and lie where they must."""

import numpy as np
import pytest

from signorini.errors.exact import ExactErrors
from signorini.errors.local import gradient_errors, gradient_errors_by_reference
from signorini.errors.reference import ReferenceErrors
from signorini.exact import family
from signorini.exceptions import MeshError
from signorini.fem.elements import find_element
from signorini.mesh.grid import Grid

SIDES = ("contact", "neumann", "dirichlet", "neumann")


class Reference:
    """What the errors read of a stored solution."""

    def __init__(self, element, u):
        self.element, self.u = element, u


def grid(n):
    return Grid(n, n, (0.0, 0.0), (1.0, 1.0), "falling", SIDES)


def nodal(mesh, element, function):
    kind = find_element(element)
    return function(*kind.nodes(mesh, np.arange(kind.size(mesh))))


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("name", ["smooth", "corner"])
def test_against_an_exact_solution_they_add_up_to_the_seminorm(name, element):
    mesh, exact = grid(8), family(name)
    u = nodal(mesh, element, exact.value)
    own = gradient_errors(mesh, element, u, exact)
    whole = ExactErrors(exact, ["h1_semi"]).of(mesh, element, u)["h1_semi"]
    assert np.sqrt(np.sum(mesh.area * own**2)) == pytest.approx(whole, rel=1e-6)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_against_a_reference_they_add_up_to_the_seminorm(element):
    fine, coarse = grid(16), grid(4)
    truth = nodal(fine, "P1", lambda x, y: np.sin(3 * x) * np.exp(y))
    u = nodal(coarse, element, lambda x, y: x * y)
    own = gradient_errors_by_reference(coarse, element, u, fine, Reference("P1", truth))
    whole = ReferenceErrors(fine, "P1", truth, ["h1_semi"]).of(coarse, element, u)["h1_semi"]
    assert np.sqrt(np.sum(coarse.area * own**2)) == pytest.approx(whole, rel=1e-12)


def test_a_reference_on_another_mesh_is_refused():
    fine, other = grid(8), grid(3)
    reference = Reference("P1", np.zeros(fine.p.shape[1]))
    with pytest.raises(MeshError, match="no refinement"):
        gradient_errors_by_reference(other, "P1", np.zeros(16), fine, reference)


def test_of_a_singular_solution_the_largest_is_at_the_corner():
    mesh, exact = grid(16), family("corner")
    errors = gradient_errors(mesh, "P1", nodal(mesh, "P1", exact.value), exact)
    corners = mesh.p[:, mesh.t[:, errors.argmax()]].T
    singular = np.array(exact.singular_points)
    distance = np.linalg.norm(corners[:, None] - singular, axis=2).min()
    assert distance < 1 / 16 + 1e-12
