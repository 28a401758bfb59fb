"""Multigrid on curved domains: meshes that do not nest are levels still, by their numbers."""

import numpy as np
import pytest

from builders import statement
from curved import ring
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.solvers import solve
from signorini.work import counting

DATA = {"f": "-1 + 10*x", "obstacle": "-0.02"}


@pytest.mark.parametrize("element", ELEMENTS)
def test_cycles_stay_flat_and_the_answer_is_that_of_the_direct_route(element):
    made, cycles = ring(4), []
    for n in (16, 32, 64):
        problem = discretize_on(made.level(n), element, statement(**DATA))
        with counting() as work:
            solution = solve(problem, "multigrid")
        direct = solve(problem, "direct")
        cycles.append(work.cycles / work.steps)
        np.testing.assert_array_equal(solution.active, direct.active)
        assert np.abs(solution.u - direct.u).max() <= 1e-12 * np.ptp(direct.u)
    assert 0 < np.count_nonzero(solution.active) < solution.active.size
    assert cycles[-1] <= cycles[0] + 2
