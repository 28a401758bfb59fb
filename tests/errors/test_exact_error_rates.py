"""Errors against exact solutions fall at the expected orders."""

import pytest

from held_grids import elements, grid, problem_of
from signorini.errors.contact import contact_errors
from signorini.errors.exact import ExactErrors
from signorini.errors.rates import slopes
from signorini.exact import family
from signorini.solvers import solve


class Rates:
    """Expected orders, over four halvings of h: with a critical point off the nodes single ones
    swing by 0.2.
    """

    levels = (8, 16, 32, 64, 128)
    orders = {"l2": (2.0, 0.1), "h1_semi": (1.0, 0.1), "h1": (1.0, 0.1)}  # noqa: RUF012
    on_contact = {"trace_l2": (2.0, 0.2), "multiplier_l2": (1.0, 0.2)}  # noqa: RUF012
    ceiling: float  # of the H1 error on the finest level
    origin, width = (0.0, 0.0), 1

    def errors(self, element, diagonal):
        for n in self.levels:
            mesh = grid(self.width * n, n, self.origin, (float(self.width), 1.0), diagonal=diagonal)
            solution = solve(problem_of(self.exact, mesh, element))
            assert solution.status == "solved"
            yield ExactErrors(self.exact).of(mesh, element, solution.u) | contact_errors(
                mesh, element, solution, self.exact
            )

    @elements
    @pytest.mark.parametrize("diagonal", ["falling", "rising"])
    def test_orders(self, element, diagonal):
        rows = list(self.errors(element, diagonal))
        for norm, (order, tolerance) in (self.orders | self.on_contact).items():
            found = slopes([1 / n for n in self.levels], [row[norm] for row in rows])["mean"]
            assert found == pytest.approx(order, abs=tolerance), norm
        assert rows[-1]["h1"] < self.ceiling


class TestCorner(Rates):
    exact, origin, ceiling = family("corner"), (-1 / 3, 0.0), 0.005

    @elements
    def test_critical_point_within_half_a_cell(self, element):
        """Half a cell for P1; CR knows it to a cell."""
        for n, row in zip(self.levels, self.errors(element, "falling"), strict=True):
            assert row["critical_points"] * n <= (0.5 if element == "P1" else 1.0)


class TestPunch(Rates):
    exact, origin, width, ceiling = family("punch", {"half_width": "1/3"}), (-1.0, 0.0), 2, 0.007


class TestSmooth(Rates):
    exact, origin, ceiling = family("smooth"), (1 / 6, 0.0), 0.04


class TestBiactive(Rates):
    exact, ceiling = family("biactive", {"left": "1/3", "right": "2/3"}), 0.03
