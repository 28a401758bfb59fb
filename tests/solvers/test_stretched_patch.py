"""The patch test on stretched cells, and poles that quadrature misses."""

import numpy as np
import pytest

from builders import grid, nodes, statement
from signorini.exceptions import FormulaError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import solve

elements = pytest.mark.parametrize("element", ELEMENTS)


def contact_patch(element, size, method="auto"):
    """The solution of the contact patch test u = 1 - y/height, and its error."""
    problem = discretize_on(
        Triangulation.from_skfem(grid(8, size=size).skfem), element, statement(obstacle=1)
    )
    solution = solve(problem, method)
    return solution, np.abs(solution.u - (1 - nodes(problem)[1] / size[1])).max()


@elements
@pytest.mark.parametrize("size", [(1.0, 1e-2), (1e-2, 1.0)], ids=["flat", "tall"])
def test_a_patch_of_aspect_one_hundredth_is_solved(element, size):
    solution, error = contact_patch(element, size)
    assert error < 1e-10
    assert solution.status == "solved"


@elements
def test_a_tall_patch_of_aspect_one_millionth_is_as_accurate_as_it_says(element):
    """Its matrix loses ten digits to rounding; with residuals by differences the solution loses
    none of them.
    """
    solution, error = contact_patch(element, (1e-6, 1.0))
    assert error <= 10 * solution.accuracy
    assert error < 1e-13
    assert solution.status == "solved"


@elements
def test_a_flat_patch_of_aspect_one_hundred_millionth_is_solved(element):
    """Along the strong direction no digit is lost."""
    solution, error = contact_patch(element, (1.0, 1e-8))
    assert error < 1e-12
    assert solution.status == "solved"


@elements
@pytest.mark.parametrize("pole", ["0.5", "0.25"], ids=["at vertices", "at edge midpoints"])
@pytest.mark.parametrize("rule", ["centroid", "exact"])
def test_a_pole_that_quadrature_misses_is_named(element, pole, rule):
    asked = statement(load_quadrature=rule, f=f"1/(x - {pole})")
    with pytest.raises(
        FormulaError, match=rf"data\.f: value is -?inf at \(x, y\) = \({pole}, 0\.\d+\)"
    ):
        discretize(asked, element, 2)
