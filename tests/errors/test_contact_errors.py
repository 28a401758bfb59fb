"""Errors on the contact side against exact solutions: traces, forces, critical points."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad

from held_grids import FREE, HELD, elements, grid, problem_of
from signorini.errors.contact import contact_errors
from signorini.errors.measure import against_exact
from signorini.exact import family, read_exact
from signorini.exceptions import SceneError
from signorini.fem.elements import find_element
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve


@elements
@pytest.mark.parametrize("labels", [HELD, FREE])
def test_contact_norms_against_adaptive_quadrature(element, labels):
    mesh, exact, rng = grid(3, labels=labels), family("corner"), np.random.default_rng(5)
    held, h = labels is HELD, 1 / 3
    x = mesh.x if element == "P1" else mesh.x[:-1] + h / 2
    x = x[1:-1] if element == "P1" and held else x
    force = rng.standard_normal(x.size)
    u = rng.standard_normal(find_element(element).size(mesh))
    solution = SimpleNamespace(u=u, force=force, active=x < 0.1)
    found = contact_errors(mesh, element, solution, exact)
    # The bottom row of triangles has its corners 0 and 1 on the contact side.
    trace = find_element(element).vertex_values(mesh, u)[:2, :3]
    total = 0.0
    for left, (a, b) in zip(mesh.x, trace.T, strict=False):
        total += (
            quad(
                lambda s, l=left, a=a, b=b: (max(l + h * s, 0) ** 1.5 - a - (b - a) * s) ** 2, 0, 1
            )[0]
            * h
        )
    assert found["trace_l2"] == pytest.approx(np.sqrt(total), rel=1e-7)
    total = 0.0
    for center, lam in zip(x, force, strict=True):
        low, high = max(center - h / 2, mesh.x[0]), min(center + h / 2, mesh.x[-1])
        density = lam / (high - low)
        total += quad(
            lambda s, c=density: (1.5 * max(-s, 0) ** 0.5 - c) ** 2,
            low,
            high,
            points=[0],
            limit=200,
        )[0]
    assert found["multiplier_l2"] == pytest.approx(np.sqrt(total), rel=1e-7)
    assert found["critical_points"] == pytest.approx(1 / 6 if element == "P1" else 0.0, abs=1e-15)


@elements
def test_distance_of_critical_points(element):
    mesh = grid(12)
    kind = find_element(element)
    dofs = np.setdiff1d(kind.boundary_dofs(mesh, "contact"), kind.boundary_dofs(mesh, "dirichlet"))
    x = kind.nodes(mesh, dofs)[0]

    def distance(active, *points):
        exact = read_exact(
            {"u": "x", "critical_points": [(p, 0.0) for p in points], "singular_points": [[9, 9]]}
        )
        solution = SimpleNamespace(
            u=np.zeros(kind.size(mesh)), force=np.zeros(x.size), active=active
        )
        return contact_errors(mesh, element, solution, exact)["critical_points"]

    cell, left = 1 / 12, x < -0.02
    assert distance(left) is None
    assert distance(x < -9, 0.0) == np.inf
    assert distance(left, 0.0) <= cell
    assert distance(left, 0.3) == pytest.approx(0.3, abs=cell)
    assert distance(left, 0.0, 0.3) == pytest.approx(0.3, abs=cell)
    assert distance((x > -0.1) & (x < 0.27), 0.27) == pytest.approx(0.37, abs=cell)
    assert distance(left, 0.0, 7.0) <= cell  # one that is not on the contact side does not count


@elements
def test_a_single_cell(element):
    mesh, exact = grid(1), family("corner")
    found = contact_errors(mesh, element, solve(problem_of(exact, mesh, element)), exact)
    assert found["critical_points"] == np.inf
    assert (found["multiplier_l2"] == 0.0) == (
        element == "P1"
    )  # both vertices are Dirichlet: no multiplier


def test_no_contact_side():
    mesh = grid(4, labels=("dirichlet",) * 4)
    solution = SimpleNamespace(u=np.zeros(25), force=np.zeros(0), active=np.zeros(0, dtype=bool))
    found = contact_errors(mesh, "P1", solution, family("corner"))
    assert found == {"trace_l2": 0.0, "multiplier_l2": 0.0, "critical_points": None}


@elements
@pytest.mark.parametrize(
    ("point", "refused"), [([0.2, 0.0], False), ([0.2, 0.5], True), ([7.0, 0.0], True)]
)
def test_critical_points_off_the_contact_part_are_no_silent_dash(element, point, refused):
    mesh, truth = grid(4, labels=FREE), {"kind": "exact", "u": "1 - y", "critical_points": [point]}
    mapping = {"domain": {}, "boundary": {}, "data": {}, "load_quadrature": "exact", "truth": truth}
    kind = find_element(element)
    contact = kind.boundary_dofs(mesh, "contact")
    proof = {"accuracy": 0.0, "multiplier_accuracy": 0.0, "residual": 0.0}
    u, active = np.ones(kind.size(mesh)), kind.nodes(mesh, contact)[0] < 0.1
    found = SimpleNamespace(
        element=element,
        n=4,
        u=u,
        multiplier=1.0 * active,
        force=1.0 * active,
        active=active,
        **proof,
    )
    errors = against_exact(
        ProblemStatement.from_mapping(mapping),
        SimpleNamespace(level=lambda n: mesh),
        ["l2", "critical_points"],
    )
    if refused:
        with pytest.raises(
            SceneError,
            match=r"critical_points needs exact ones on the contact part, but \(.*\) lie off",
        ):
            errors(found)
    else:
        assert errors(found)["critical_points"] <= 0.25
