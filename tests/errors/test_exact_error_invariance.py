"""Errors against exact solutions under renumbering, powers of two and other units of length."""

from types import SimpleNamespace

import numpy as np
import pytest

from held_grids import elements, grid, nodes, problem_of
from signorini.errors.contact import contact_errors
from signorini.errors.exact import ExactErrors
from signorini.exact import family
from signorini.fem.elements import find_element
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import solve


def renumbered(mesh, seed=0):
    """The same triangles in another order, their vertices numbered and listed anew."""
    from skfem import MeshTri

    rng = np.random.default_rng(seed)
    old = rng.permutation(mesh.number_of_vertices)
    t = np.argsort(old)[mesh.t[:, rng.permutation(mesh.number_of_triangles)]]
    shuffled = MeshTri(mesh.p[:, old], rng.permuted(t, axis=0), sort_t=False)
    boundary, bottom = (
        shuffled.boundary_facets(),
        np.flatnonzero((shuffled.p[1, shuffled.facets] == 0.0).all(axis=0)),
    )
    return Triangulation.from_skfem(
        shuffled.with_boundaries({"contact": bottom, "dirichlet": np.setdiff1d(boundary, bottom)})
    )


@elements
@pytest.mark.parametrize("name", ["corner", "smooth"])
def test_numbering_does_not_matter(element, name):
    exact, mesh = family(name), grid(6)
    found = []
    for one in (mesh, renumbered(mesh)):
        x, y = nodes(one, element)
        contact = find_element(element)
        dofs = np.setdiff1d(
            contact.boundary_dofs(one, "contact"), contact.boundary_dofs(one, "dirichlet")
        )
        at = contact.nodes(one, dofs)[0]
        solution = SimpleNamespace(u=np.sin(x + 2 * y), force=np.cos(at), active=at < 0.2)
        found.append(
            ExactErrors(exact).of(one, element, solution.u)
            | contact_errors(one, element, solution, exact)
        )
    assert found[1] == pytest.approx(found[0], rel=1e-12)


@elements
@pytest.mark.parametrize("k", [-900, 900])
def test_powers_of_two_change_no_bit(element, k):
    mesh, found = grid(8), []
    for amplitude in (1.0, 2.0**k):
        exact = family("corner", {"amplitude": amplitude})
        solution = solve(problem_of(exact, mesh, element))
        found.append(
            ExactErrors(exact).of(mesh, element, solution.u)
            | contact_errors(mesh, element, solution, exact)
        )
    point = found[0].pop("critical_points")
    assert found[1].pop("critical_points") == point
    assert found[1] == {key: np.ldexp(value, k) for key, value in found[0].items()}


# Powers of the length that each error has, u itself having 3/2.
LENGTHS = {"l2": 2.5, "h1_semi": 1.5, "trace_l2": 2.0, "multiplier_l2": 1.0, "critical_points": 1.0}


@elements
@pytest.mark.parametrize("scale", [1e-9, 1e9])
def test_errors_scale_with_the_domain(element, scale):
    found = []
    for length in (1.0, scale):
        exact, mesh = family("corner"), grid(8, origin=(-length / 3, 0.0), size=(length, length))
        solution = solve(problem_of(exact, mesh, element))
        found.append(
            ExactErrors(exact).of(mesh, element, solution.u)
            | contact_errors(mesh, element, solution, exact)
        )
    for name, power in LENGTHS.items():
        assert found[1][name] == pytest.approx(found[0][name] * scale**power, rel=1e-10), name
