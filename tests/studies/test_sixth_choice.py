"""Last digits: hypotheses against independent computations, and what they give for the paper."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from sixth_choices import SCENE, rows

from builders import DATA, PAPER, grid, statement
from signorini import solve
from signorini.errors.norms import PAPER_NORMS
from signorini.errors.reference import ReferenceErrors
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.publication.published import Published
from signorini.studies.sensitivity import hypotheses
from signorini.studies.sensitivity.chance import chance, rounded_loads
from signorini.studies.sensitivity.relaxation import natural_order, relax
from signorini.studies.sensitivity.response import Responses
from signorini.studies.sensitivity.slowest_mode import slowest_mode

COARSE = list(itertools.product(ELEMENTS, (2, 4, 8)))
FINE = 32


def solved(element, n, **changes):
    asked = replace(SCENE.problem_statement, **changes)
    problem = discretize_on(asked.triangulations.level(n), element, asked)
    return problem, solve(problem)


# Projected SOR.


def one_after_the_other(problem, omega, tolerance):
    """Projected SOR as it is written in books."""
    A, u = problem.A.toarray(), np.zeros(problem.b.size)
    lower = dict(zip(problem.contact.tolist(), problem.lower, strict=True))
    u[problem.fixed] = problem.fixed_values
    for sweep in itertools.count(1):
        largest = 0.0
        for i in natural_order(problem):
            new = u[i] + omega * (problem.b[i] - A[i] @ u) / A[i, i]
            new = max(new, lower.get(int(i), -np.inf))
            largest, u[i] = max(largest, abs(new - u[i])), new
        if largest < tolerance:
            return u, sweep


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize(("omega", "tolerance"), [(1.0, 1e-3), (1.5, 1e-6), (1.9, 1e-9)])
def test_overlapping_sweeps_are_those_of_the_natural_order(element, omega, tolerance):
    problem = discretize_on(grid(5, 3), element, statement(**DATA))
    u, sweeps = one_after_the_other(problem, omega, tolerance)
    relaxed = relax(problem, omega, tolerance)
    assert relaxed.sweeps == sweeps
    np.testing.assert_allclose(relaxed.u, u, rtol=0, atol=1e-14)


@pytest.mark.parametrize("element", ELEMENTS)
def test_the_natural_order_goes_up_from_the_contact_side(element):
    problem, _ = solved(element, 4)
    x, y = problem.finite_element.nodes(problem.mesh, natural_order(problem))
    assert np.all((np.diff(y) > 0) | ((np.diff(y) == 0) & (np.diff(x) > 0)))
    assert y[0] == 0.0


def test_an_early_stop_leaves_the_solution_low_in_its_slowest_mode():
    problem, solution = solved("P1", 16)
    short = solution.u - relax(problem, 1.0, 1e-6).u
    mode = slowest_mode(problem)
    assert short.max() > 1e-5
    assert short @ mode > 0.99 * np.linalg.norm(short) * np.linalg.norm(mode)


def test_the_slowest_mode_of_a_square_is_a_cosine():
    """Without contact: zero above, natural elsewhere; to second order."""
    off = []
    for n in (8, 16, 32):
        mesh = grid(n, labels=("neumann", *PAPER[1:]))
        mode = slowest_mode(discretize_on(mesh, "P1", statement(f=1)))
        cosine = np.cos(np.pi * mesh.p[1] / 2)
        cosine *= (mode @ cosine) / (cosine @ cosine)
        off.append(np.linalg.norm(mode - cosine) / n)
    assert off[0] / off[1] > 3.5
    assert off[1] / off[2] > 3.5


# Hypotheses.


def hypothesis(name):
    (found,) = [one for one in hypotheses.HYPOTHESES if one.name == name]
    return found


def test_every_hypothesis_has_a_name_of_its_own():
    names = [one.name for one in hypotheses.HYPOTHESES]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("element", ELEMENTS)
def test_the_penalised_solution_balances_its_penalty(element):
    """A u + p min(u, 0) = b on the contact part, as a program with a penalty has it."""
    _, u = hypothesis("contact by a penalty of 1e6").solution(SCENE.problem_statement, element, 8)
    problem, solution = solved(element, 8)
    c = problem.contact
    force = (problem.apply(u) - problem.b)[c]
    np.testing.assert_allclose(force, -1e6 * np.minimum(u[c], 0.0), rtol=0, atol=1e-9)
    assert u[c].min() < 0.0
    np.testing.assert_allclose(u, solution.u, rtol=0, atol=1e-5)


@pytest.mark.parametrize("element", ELEMENTS)
def test_sums_in_single_precision_are_within_their_rounding(element):
    asked = SCENE.problem_statement
    problem, _ = solved(element, 8)
    b = hypotheses._added_in_single(asked, problem)
    np.testing.assert_array_equal(b, b.astype(np.float32))
    assert 0 < np.abs(b - problem.b).max() <= 8 * 2.0**-24 * np.abs(problem.b).max()


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("kind", ["weight", "abscissae"])
def test_a_third_with_fewer_digits_moves_the_solution_by_that(element, kind):
    _, six = hypothesis(f"{kind} .333333").solution(SCENE.problem_statement, element, 8)
    _, eight = hypothesis(f"{kind} .33333333").solution(SCENE.problem_statement, element, 8)
    exact = solved(element, 8)[1].u
    assert np.abs(six - exact).max() == pytest.approx(100 * np.abs(eight - exact).max(), rel=1e-2)
    if kind == "weight":  # the problem is homogeneous
        np.testing.assert_allclose(six, 0.999999 * exact, rtol=0, atol=1e-14)


DIGITS = {
    # hypothesis: digits with it in the reference alone, and in all solutions
    "none": (19, 19),
    "load in single precision": (20, 24),
    "load in single precision: f alone": (19, 22),
    "pi = 3.1415927": (22, 20),
}


@pytest.mark.parametrize("name", DIGITS)
def test_how_many_digits_of_the_paper_are_met(name):
    """Found before this study, by other programs."""
    found = {row["of"]: row for row in rows(*DIGITS) if row["hypothesis"] == name}
    assert (found["reference"]["digits"], found["all"]["digits"]) == DIGITS[name]


# Chance.


def test_the_response_is_what_single_precision_does():
    """To first order; the second is below 1e-12."""
    reference, truth = solved("P1", FINE)
    rounded_reference, rounded_truth = solved("P1", FINE, load_precision="single")
    responses = Responses(reference, truth)
    before, after = (
        ReferenceErrors(reference.mesh, "P1", found.u, PAPER_NORMS)
        for found in (truth, rounded_truth)
    )
    for pair in COARSE:
        problem, solution = solved(*pair)
        rounded, rounded_solution = solved(*pair, load_precision="single")
        response = responses.of(problem, solution)
        expected = response.to_reference @ (rounded_reference.b - reference.b)
        expected += response.to_own @ (rounded.b - problem.b)
        errors = before.of(problem.mesh, problem.element, solution.u)
        moved = after.of(problem.mesh, problem.element, rounded_solution.u)
        for norm, error, change in zip(PAPER_NORMS, response.errors, expected, strict=True):
            assert error == pytest.approx(errors[norm], rel=1e-13)
            assert moved[norm] - errors[norm] == pytest.approx(change, rel=1e-3, abs=1e-12)


def printed(decimals):
    """Our own errors, as a table with so many decimals has them."""
    errors, _ = rounded_loads(SCENE.problem_statement, COARSE, FINE)
    places = itertools.product(COARSE, PAPER_NORMS)
    return [
        Published(norm, element, str(n), f"{error:.{decimals}f}", "1")
        for ((element, n), norm), error in zip(places, errors, strict=True)
    ]


@pytest.mark.parametrize(("decimals", "digits"), [(6, {12}), (14, {0})])
def test_rounding_at_random_moves_digits_of_its_own_size_alone(decimals, digits):
    """It moves errors by some 1e-9: of six decimals all stay, of fourteen none."""
    asked = SCENE.problem_statement, ELEMENTS, (2, 4, 8), FINE, printed(decimals)
    counts = chance(*asked, draws=50)
    assert sum(row["draws"] for row in counts) == 50
    assert {row["digits"] for row in counts if row["draws"]} == digits


@pytest.mark.parametrize("changes", [{"load_quadrature": "exact"}, {}])
def test_nothing_is_drawn_where_it_is_not_asked_for_or_shares_differ(changes):
    asked = replace(SCENE.problem_statement, **changes), ELEMENTS, (2, 4, 8), FINE, printed(8)
    counts = chance(*asked, draws=len(changes))
    assert [row["draws"] for row in counts] == [0] * 13
