"""The judge of the stability suite: extended precision, contact sets of its own, held against
rational numbers.
"""

from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from rational import exact_solution, rounded
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.problem import discretize, discretize_on
from signorini.generated.bodies import BOUNDARIES, pressed_flat
from signorini.generated.problems import instance
from signorini.judge import EPS, judge
from signorini.judge.couplings import couplings
from signorini.judge.elimination import Elimination
from signorini.mesh.grid import SIDES
from signorini.mesh.labels import labelled
from signorini.solvers import solve

extended_only = pytest.mark.skipif(EPS > 1e-18, reason="this machine's long double has 64 bits")


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize(
    "coefficient", [1, "where(x < y, 1e3, 2 + x)"], ids=["plain", "coefficient"]
)
@pytest.mark.parametrize("mesh", [delaunay(0), grid(5, 4)], ids=["delaunay", "grid"])
def test_the_extended_matrix_is_the_matrix(mesh, element, coefficient):
    problem = discretize_on(mesh, element, statement(coefficient=coefficient))
    A = problem.A.toarray()
    first, second, weight, _ = couplings(mesh, element, problem.coefficient)
    assert weight.dtype == np.longdouble
    off_diagonal = np.zeros_like(A)
    np.add.at(off_diagonal, (first, second), -weight.astype(float))
    extended = off_diagonal + off_diagonal.T
    extended -= np.diag(extended.sum(axis=1))  # rows of a stiffness matrix sum to zero
    np.testing.assert_allclose(extended, A, rtol=0, atol=1e-14 * np.abs(A).max())


@extended_only
@pytest.mark.parametrize(
    ("element", "aspect"), [("P1", 1e-6), ("CR", 1e-2), ("CR", 1e-4), ("CR", 1e-6)]
)
def test_extended_precision_knows_what_double_does_not(element, aspect):
    """The contact patch u = 1 - y / height on shaken cells pressed flat: CR in double loses
    aspect**-2.
    """
    mesh = labelled(pressed_flat(8, aspect, seed=0), dict(zip(SIDES, BOUNDARIES[0], strict=True)))
    problem = discretize_on(mesh, element, statement(obstacle=1))
    truth = (
        1
        - find_element(element).nodes(mesh, np.arange(problem.b.size))[1].astype(np.longdouble)
        / aspect
    )
    solution = solve(problem, "direct")
    found = judge(problem, solution)
    error = float(np.abs(found.u - truth).max())
    assert error <= max(1e-16, 1e-18 * aspect**-2 if element == "CR" else 0)
    assert error <= found.error <= 1e-6
    if element == "CR":
        assert error < 0.1 * np.abs(solution.u - truth).max()


def test_a_contact_set_is_that_of_the_matrix_as_it_is():
    """Refined by another matrix, equal but for round-off, this solution fell below the obstacle by
    5e-8.
    """
    solution = solve(instance("stretched", "degenerate", "CR", 18).problem, "direct")
    assert solution.status == "inaccurate"
    assert solution.residual <= 1e-9


@pytest.mark.parametrize("element", ELEMENTS)
def test_extended_precision_mends_a_wrong_contact_set(element):
    problem = discretize(statement(**DATA), element, 8)
    right = solve(problem, "direct")
    wrong = solve(discretize(statement(**DATA | {"obstacle": -10}), element, 8), "direct")
    found = judge(problem, wrong)
    assert right.active.any()
    assert not wrong.active.any()
    np.testing.assert_array_equal(found.active, right.active)
    np.testing.assert_allclose(found.u.astype(float), right.u, rtol=0, atol=1e-14)


def small(element, towards=None, exponent=10.0, **data):
    """Four or five contact dofs, some of them in contact; rows of cells drawn to sides."""
    grade = {"grade": {"towards": towards, "exponent": exponent}} if towards else {}
    return discretize(statement(domain=grade, **WAVES | data), element, 4)


def pressed(element):
    mesh = labelled(pressed_flat(4, 1e-4, 1), dict(zip(SIDES, BOUNDARIES[0], strict=True)))
    return discretize_on(
        mesh, element, statement(**WAVES | {"f": "1e8*cos(5*x)", "g": 0, "dirichlet": 0.12})
    )


WAVES = DATA | {"f": "40*cos(5*x)", "obstacle": "0.1*cos(6*x)"}
RATIONAL = {
    "graded": lambda element: small(element, ["bottom"]),
    "graded-corner": lambda element: small(element, ["bottom", "left"]),
    "stiff": lambda element: small(element, coefficient="where(hypot(x - 0.3, y) < 0.4, 1e6, 1)"),
    "stiffest": lambda element: small(element, coefficient="where(x > 0.4 and y < 0.6, 1e12, 1)"),
    "soft": lambda element: small(element, coefficient="where(y < 0.3, 1e-6, 1)"),
    "pressed-flat": pressed,
    "graded-side": lambda element: small(
        element, ["left"], f=-8, g=0, dirichlet=-0.3, obstacle="where(x > 0.3, -9, -0.1*x)"
    ),
    "constant": lambda element: small(
        element, dirichlet="1e12 + 0.1*x", obstacle="1e12 + 0.1*cos(6*x)"
    ),
}


@extended_only
@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("case", RATIONAL)
def test_the_judge_is_right_by_rational_numbers(case, element):
    """Without rounding, and by trying every contact set; the judge starts from nothing."""
    problem = RATIONAL[case](element)
    u, multiplier, active = exact_solution(problem)
    assert 0 < sum(active) < len(active)
    found = judge(problem)
    assert tuple(found.active) == active
    assert (found.margin > 1).all()
    shift = Fraction(float(found.shift))
    displacement = rounded([value - shift for value in u])
    error = np.abs(found.displacement - displacement).max() / found.variation
    force_error = np.abs(found.multiplier - rounded(multiplier)).max()
    assert error <= found.error <= 1e-9
    assert force_error <= found.force_error <= 1e-9 * max(found.multiplier)
    assert found.error <= 1e-15 or (element == "CR" and case == "pressed-flat")


@extended_only
@pytest.mark.parametrize("case", ["graded", "stiff", "pressed-flat"])
@pytest.mark.parametrize("element", ELEMENTS)
def test_the_judge_trusts_nobody(case, element):
    """Whatever contact set and u it starts from, it ends at the same."""
    problem = RATIONAL[case](element)
    right = judge(problem)
    rng = np.random.default_rng(0)
    for _ in range(4):
        size = problem.contact.size
        lie = SimpleNamespace(
            u=rng.standard_normal(problem.b.size), active=rng.random(size) < rng.random()
        )
        found = judge(problem, lie)
        np.testing.assert_array_equal(found.active, right.active)
        assert (
            np.abs(found.displacement - right.displacement).max()
            <= 2 * right.error * right.variation
        )


def test_the_judge_is_undecided_where_there_is_neither_gap_nor_force():
    found = judge(discretize_on(grid(4), "P1", statement()))
    assert not (found.margin > 1).any()
    assert found.wrong_side(~found.active, np.zeros(5, dtype=bool)) == 0
    assert found.needless(np.ones(5, dtype=bool), 1e3) == 0


@extended_only
@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("element", ELEMENTS)
def test_the_judge_is_undecided_where_it_would_change_its_mind(element, seed):
    """On degenerate loads what it is sure of does not depend on where it starts."""
    problem = instance("perturbed", "degenerate", element, seed).problem
    one, other = judge(problem), judge(problem, solve(problem))
    sure = (one.margin > 1) & (other.margin > 1)
    np.testing.assert_array_equal(one.active[sure], other.active[sure])
    assert sure.mean() > 0.5


def test_a_wrong_side_counts_where_both_are_decided():
    problem = discretize(statement(**DATA), "P1", 8)
    found, none = judge(problem), np.zeros(9, dtype=bool)
    flipped = found.active.copy()
    flipped[3] ^= True
    assert found.wrong_side(found.active, none) == 0
    assert found.wrong_side(flipped, none) == 1
    assert found.wrong_side(flipped, np.arange(9) == 3) == 0
    assert found.needless(np.arange(9) == 3, 1e3) == 1


def test_errors_are_relative_to_variation_and_force():
    problem = discretize(
        statement(**DATA | {"dirichlet": 1000, "obstacle": "1000 + 0.1*cos(6*x)"}), "P1", 8
    )
    found = judge(problem)
    variation, none = np.ptp(found.u.astype(float)), np.zeros(9, dtype=bool)
    assert found.distance(found.u.astype(float) + 1e-3) == pytest.approx(1e-3 / variation, rel=1e-9)
    lifted = found.multiplier.astype(float) + 1e-3
    largest = float(found.multiplier.max())
    assert found.multiplier_distance(lifted, found.active) == pytest.approx(
        1e-3 / largest, rel=1e-9
    )
    expected = pytest.approx(1e-3 / found.force_scale, rel=1e-9)
    assert found.multiplier_distance(lifted, none) == expected


def test_what_double_precision_cannot_is_told_from_what_it_can():
    easy = judge(discretize(statement(**DATA), "CR", 8))
    assert max(easy.limit, easy.multiplier_limit(easy.active)) < 1e-12
    flat = labelled(pressed_flat(8, 1e-8, seed=0), dict(zip(SIDES, BOUNDARIES[0], strict=True)))
    assert judge(discretize_on(flat, "CR", statement(obstacle=1))).limit > 1e-2
    constant = judge(discretize(statement(**DATA | {"dirichlet": 1e12, "obstacle": 1e12}), "P1", 8))
    assert (
        constant.limit
        == constant.stored
        > 1e-6
        > 1e-12
        > constant.multiplier_limit(constant.active)
    )
    graded = judge(small("P1", ["bottom"]))
    assert max(graded.limit, graded.multiplier_limit(graded.active)) < 1e-12


def test_elimination_is_that_of_the_matrix():
    rng = np.random.default_rng(0)
    weights = np.triu(rng.random((6, 6)), 1).astype(np.longdouble)
    border = rng.random((4, 2)).astype(np.longdouble)
    first, second = np.triu_indices(4, 1)
    found = Elimination(first, second, weights[:4, :4][first, second], border)
    inner = -(weights[:4, :4] + weights[:4, :4].T)
    np.fill_diagonal(inner, -inner.sum(axis=1) + border.sum(axis=1))
    inner, border = inner.astype(float), border.astype(float)
    block = border.T @ np.linalg.solve(inner, border)
    np.testing.assert_allclose(found.block[0, 1].astype(float), block[0, 1], rtol=1e-14)
    load, kept = rng.random((4, 3)), rng.random((2, 3))
    parts, reduced = found.condense(load.astype(np.longdouble))
    np.testing.assert_allclose(
        reduced.astype(float), border.T @ np.linalg.solve(inner, load), rtol=1e-13
    )
    values = found.back_substitute(parts, kept.astype(np.longdouble)).astype(float)
    np.testing.assert_allclose(values, np.linalg.solve(inner, load + border @ kept), rtol=1e-13)


@extended_only
def test_elimination_keeps_what_a_matrix_loses():
    """A chain held to the ground by 1e-30 at one end, loaded at the other by 1: a matrix would have
    lost the ground.
    """
    n, ground = 5, np.longdouble("1e-30")
    border = np.zeros((n, 1), dtype=np.longdouble)
    border[0] = ground
    chain = Elimination(
        np.arange(n - 1), np.arange(1, n), np.ones(n - 1, dtype=np.longdouble), border
    )
    load = np.zeros((n, 1), dtype=np.longdouble)
    load[-1] = 1
    parts, _ = chain.condense(load)
    values = chain.back_substitute(parts, np.zeros((1, 1), dtype=np.longdouble))[:, 0]
    np.testing.assert_allclose((values * ground).astype(float), np.ones(n), rtol=1e-15)
