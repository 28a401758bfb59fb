"""Slopes: of synthetic powers, and of the elements on exact solutions."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import grid, statement
from signorini.errors.rates import rate_rows, reference_note, slopes
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import SignoriniError
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.problem import discretize_on
from signorini.fem.quadrature import triangle_rule
from signorini.formula import Formula
from signorini.solvers import solve


@given(
    st.floats(-3, 5),
    st.floats(1e-100, 1e100),
    st.lists(st.floats(0.1, 0.9), min_size=1, max_size=8),
)
def test_powers_have_their_exponent_for_a_slope(exponent, factor, ratios):
    h = np.cumprod([1.0, *ratios])
    found = slopes(h, factor * h**exponent)
    assert found["mean"] == pytest.approx(exponent, abs=1e-8)
    assert found["fit"] == pytest.approx(exponent, abs=1e-8)


def test_the_mean_of_halved_sizes_is_the_slope_between_the_end_points():
    h, errors = [1, 0.5, 0.25, 0.125], [3.0, 1.1, 0.2, 0.07]
    assert slopes(h, errors)["mean"] == pytest.approx(np.log2(3.0 / 0.07) / 3, rel=1e-14)
    steps = [np.log2(a / b) for a, b in pairwise(errors)]
    assert slopes(h, errors)["mean"] == pytest.approx(np.mean(steps), rel=1e-14)


def test_the_fit_is_the_least_squares_line():
    rng = np.random.default_rng(0)
    h, errors = np.sort(rng.random(6))[::-1], rng.random(6)
    assert slopes(h, errors)["fit"] == pytest.approx(
        np.polyfit(np.log(h), np.log(errors), 1)[0], rel=1e-12
    )


def test_mean_and_fit_differ_where_the_points_are_on_no_line():
    found = slopes([1, 0.5, 0.25], [1.0, 0.9, 0.1])
    assert (
        abs(found["mean"] - found["fit"]) < 1e-12
    )  # symmetric: three halved sizes weigh the ends alone
    found = slopes([1, 0.5, 0.25, 0.125], [1.0, 0.9, 0.1, 0.09])
    assert abs(found["mean"] - found["fit"]) > 0.1


@pytest.mark.parametrize("h", [[], [0.5]])
def test_a_slope_needs_two_levels(h):
    with pytest.raises(SignoriniError, match="a slope needs two levels"):
        slopes(h, [0.1] * len(h))


@pytest.mark.parametrize("bad", [0.0, -1.0, float("nan"), float("inf")])
def test_an_error_without_logarithm_is_named(bad):
    with pytest.raises(
        SignoriniError, match=r"rates: the error at h = 0\.25 is .*, which has no logarithm"
    ):
        slopes([0.5, 0.25], [0.1, bad])


def errors_of(**columns):
    """Rows of errors.csv of P1 by level, with the norms as given."""
    known = {"floor": [""] * 4} | columns
    length = len(next(iter(columns.values())))
    return [
        {"element": "P1", "n": 2**k, "h": 0.5**k}
        | {name: column[k] for name, column in known.items()}
        for k in range(length)
    ]


def test_distances_of_critical_points_have_slopes():
    found = rate_rows(errors_of(critical_points=[0.4, 0.2, 0.1]))
    assert [(row["kind"], row["floor"]) for row in found] == [("mean", "0"), ("fit", "0")]
    assert [row["slope"] for row in found] == pytest.approx([1.0, 1.0])


def test_a_norm_that_is_exactly_zero_beside_round_off_has_no_slope():
    """Also where it was not asked for, so that the column floor does not name it."""
    rows = [
        {"element": "P1", "h": h, "l2": 1e-16, "h1_semi": 0.0, "floor": "l2"} for h in (0.5, 0.25)
    ]
    found = {row["norm"]: row["slope"] for row in rate_rows(rows)}
    assert found == {"l2": pytest.approx(0.0), "h1_semi": None}
    with pytest.raises(SignoriniError, match="has no logarithm"):
        rate_rows([row | {"floor": ""} for row in rows])


@pytest.mark.parametrize("bad", [0.0, float("inf")])
def test_a_zero_or_infinite_distance_has_no_slope_and_takes_none_from_other_norms(bad):
    found = rate_rows(errors_of(l2=[0.4, 0.1, 0.025], critical_points=[0.4, bad, 0.1]))
    slope = {(row["norm"], row["floor"]): row["slope"] for row in found if row["kind"] == "mean"}
    assert slope == {("l2", "0"): pytest.approx(2.0), ("critical_points", "zero"): None}


def test_a_solution_that_is_the_reference_has_no_slope_in_any_norm():
    found = rate_rows(
        errors_of(l2=[0.4, 0.1, 0.0], h1=[4.0, 2.0, 0.0], floor=["", "", "reference"])
    )
    assert {(row["norm"], row["slope"], row["floor"]) for row in found} == {
        ("l2", None, "reference"),
        ("h1", None, "reference"),
    }


def test_a_reference_below_four_times_the_finest_level_is_said_to_bend_the_last_slope():
    twice = reference_note(
        {"kind": "reference", "n": 64, "element": "P1"}, [4, 8, 16, 32], ["P1", "CR"]
    )
    assert "n = 64, is only 2 times as fine as the finest level" in twice
    own = (
        "errors of P1 are about 25 % too small in L2 and 13 % in H1, "
        "and the last slope about 0.32 and 0.16"
    )
    assert own in twice
    assert (
        "the last slope of CR is up to 0.23 too low in L2 and 0.12 in H1; n = 128 or more" in twice
    )
    same = reference_note({"kind": "reference", "n": 32, "element": "CR"}, [16, 32], ["CR"])
    own = (
        "no finer than the finest level: there CR is the reference itself "
        "and has neither error nor slope"
    )
    assert own in same
    assert "P1" not in same
    for truth in (
        {"kind": "reference", "n": 128, "element": "P1"},
        {"kind": "exact"},
        {"kind": "none"},
    ):
        assert reference_note(truth, [16, 32], ["P1"]) is None


@pytest.mark.parametrize("own", ELEMENTS)
def test_what_a_reference_does_to_the_last_slope_is_what_the_note_says(own):
    """On the paper's problem, levels 16 and 32, the last slope against n = 64 less that against n =
    512.
    """
    asked = statement(f="2*pi*sin(2*pi*x)", load_quadrature="centroid")
    solved = {
        (e, n): solve(discretize_on(grid(n), e, asked)).u
        for e in ELEMENTS
        for n in (16, 32, 64, 512)
    }
    last = {}
    for n in (64, 512):
        truth = ReferenceErrors(grid(n), own, solved[own, n], ["l2", "h1_semi"])
        for e in ELEMENTS:
            coarse, fine = (truth.of(grid(m), e, solved[e, m]) for m in (16, 32))
            last[n, e] = [np.log2(coarse[norm] / fine[norm]) for norm in ("l2", "h1_semi")]
    (other,) = set(ELEMENTS) - {own}
    l2, h1 = np.subtract(last[64, own], last[512, own])
    assert 0.1 < l2 < 0.34
    assert h1 == pytest.approx(0.16, abs=0.01)
    l2, h1 = np.subtract(last[64, other], last[512, other])
    assert -0.23 < l2 < -0.03
    assert -0.12 < h1 < -0.03


class Convergence:
    """An exact solution u >= obstacle with its rates; the data follow from u on the unit square of
    Section 5.
    """

    tolerance = 0.1
    levels = (16, 32, 64)  # with no critical point on a vertex or midpoint
    rates = {"l2": 2, "h1_semi": 1}  # noqa: RUF012

    @pytest.mark.parametrize("diagonal", ["falling", "rising"])
    @pytest.mark.parametrize("element", ELEMENTS)
    def test_rates(self, element, diagonal):
        errors = [self.errors(element, grid(n, diagonal=diagonal)) for n in self.levels]
        for norm, rate in self.rates.items():
            found = slopes([1 / n for n in self.levels], [error[norm] for error in errors])
            assert found["mean"] == pytest.approx(rate, abs=self.tolerance)
            assert errors[-1][norm] < self.ceiling[norm]

    def errors(self, element, mesh):
        problem = self.discrete(element, mesh)
        values = find_element(element).vertex_values(mesh, solve(problem).u)
        points, weights = triangle_rule(8)
        x, y = np.einsum("dkt,kq->dqt", mesh.p[:, mesh.t], points)
        u, ux, uy = Formula(self.u).value_and_gradient(x, y)
        gradient = mesh.gradients(values)[:, None]
        squares = {
            "l2": (u - points.T @ values) ** 2,
            "h1_semi": (ux - gradient[0]) ** 2 + (uy - gradient[1]) ** 2,
        }
        return {
            norm: np.sqrt(mesh.area * np.sum(weights @ square)) for norm, square in squares.items()
        }

    def discrete(self, element, mesh):
        u = Formula(self.u)
        plain = statement(obstacle=self.obstacle)
        return discretize_on(
            mesh, element, replace(plain, data=replace(plain.data, f=Load(u), g=Flux(u)))
        )


class Load:
    """-Laplace u, called like a formula."""

    constant = None

    def __init__(self, u):
        self.u = u

    def __call__(self, x, y):
        return -self.u.laplacian(x, y)


class Flux(Load):
    """du/dnu on the left and right sides, called like a formula."""

    def __call__(self, x, y):
        return np.where(x < 0.5, -1.0, 1.0) * self.u.gradient()[0](x, y)


class TestSmooth(Convergence):
    """E4: contact for x > 1/2 is lost where u lifts as a cubic, and pressed as a cubic on the other
    side.
    """

    u = "(0.1*sin(3*x) + 8*pos(x - 0.5)**3)*(1 - y**2) - y*(1 - y)*8*pos(0.5 - x)**3"
    obstacle = "0.1*sin(3*x)"
    levels = (15, 31, 63)
    ceiling = {"l2": 2.5e-4, "h1_semi": 0.05}  # noqa: RUF012


class TestBiactive(Convergence):
    """E4b: between 0.3 and 0.7 there is neither gap nor force."""

    u = "(0.1*sin(3*x) + 20*pos(x - 0.7)**3)*(1 - y**2) - y*(1 - y)*20*pos(0.3 - x)**3"
    obstacle = "0.1*sin(3*x)"
    ceiling = {"l2": 2.5e-4, "h1_semi": 0.05}  # noqa: RUF012


class TestGap(Convergence):
    """E5 away from the obstacle: no contact at all."""

    u = "0.5*(1 - y**2)"
    obstacle = "0.4"
    ceiling = {"l2": 3e-5, "h1_semi": 0.006}  # noqa: RUF012


class TestSingular(Convergence):
    """E1: the generic critical point, du/dnu ~ r^(1/2), here at x = 1/3, in the same place of its
    cell at both ends.

    u is in H^(5/2) up to an epsilon only, and still both rates are whole.
    """

    u = "hypot(x - 1/3, y)**1.5*cos(1.5*atan2(y, 1/3 - x))"
    obstacle = "0"
    ceiling = {"l2": 5e-5, "h1_semi": 0.011}  # noqa: RUF012

    def discrete(self, element, mesh):
        plain = statement(dirichlet=self.u)
        return discretize_on(
            mesh, element, replace(plain, data=replace(plain.data, g=Flux(Formula(self.u))))
        )
