"""`solve` on stretched cells: digits that are kept, and answers that are not called solved."""

import numpy as np
import pytest

from builders import grid, nodes, statement
from signorini.exceptions import SolverError
from signorini.fem.problem import discretize_on
from signorini.solvers import solve


@pytest.mark.parametrize("aspect", [1e-2, 1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize(
    ("near", "beside", "far"),
    [
        ("neumann", "dirichlet", "neumann"),
        ("contact", "dirichlet", "neumann"),
        ("dirichlet", "neumann", "neumann"),
        ("contact", "neumann", "dirichlet"),
    ],
)
def test_stretched_cells_cost_the_fourier_route_no_digits(element, aspect, near, beside, far):
    """Patch test u = 1 + x; held at the ends of a flat strip, the weak direction decides."""
    flux = "where(x < 0.001, -1, where(x > 0.999, 1, 0))"
    mesh = grid(8, labels=(near, beside, far, beside), size=(1.0, aspect))
    problem = discretize_on(mesh, element, statement(dirichlet="1 + x", g=flux))
    np.testing.assert_allclose(
        solve(problem, "fourier").u, 1 + nodes(problem)[0], rtol=0, atol=1e-14
    )


@pytest.mark.parametrize(
    "aspect", [1, 1e-2, 2**-7, 1e-3, 2**-10, 1e-4, 2**-16, 1e-5, 2**-20, 1e-6, 2**-27, 1e-8]
)
@pytest.mark.parametrize("beside", ["contact", "dirichlet", "neumann"])
@pytest.mark.parametrize("near", ["contact", "neumann"])
def test_the_direct_route_never_calls_a_wrong_answer_solved(element, aspect, near, beside):
    """The same patch test: the matrix rounds the weak direction away, or with powers of two its
    factors do.

    No residual shows it (it stays below 1e-15); the accuracy does.
    """
    flux = "where(x < 0.001, -1, where(x > 0.999, 1, 0))"
    mesh = grid(8, labels=(near, beside, "neumann", "dirichlet"), size=(1.0, aspect))
    problem = discretize_on(
        mesh, element, statement(dirichlet="1 + x", g=flux, obstacle="where(x > 0.999, 2, 0)")
    )
    try:
        solution = solve(problem, "direct")
    except SolverError:
        assert aspect <= 2**-20
        return
    error = np.abs(solution.u - 1 - nodes(problem)[0]).max() / 2
    assert error <= 4 * solution.accuracy
    assert error <= 1e-9 or solution.status == "inaccurate"
    if aspect >= 1e-2:
        assert solution.status == "solved"
