"""Nested dissection: every row once, and little fill."""

import numpy as np
import pytest
import scipy.sparse.linalg

from builders import grid, nodes, statement
from signorini.fem.problem import discretize_on
from signorini.solvers.schur_complement import dissection_order


@pytest.mark.parametrize("n", [1, 3, 20])
def test_dissection_keeps_every_row_once_and_fill_low(element, n):
    problem = discretize_on(grid(n), element, statement())
    order = dissection_order(problem.A, nodes(problem))
    np.testing.assert_array_equal(np.sort(order), np.arange(problem.b.size))


def test_dissection_fills_less_than_the_natural_order():
    problem = discretize_on(grid(48), "CR", statement())
    order = dissection_order(problem.A, nodes(problem))
    shifted = problem.A + scipy.sparse.eye_array(problem.b.size)
    options = {
        "permc_spec": "NATURAL",
        "diag_pivot_thresh": 0.0,
        "options": {"SymmetricMode": True},
    }
    natural, dissected = (
        scipy.sparse.linalg.splu(shifted[rows][:, rows].tocsc(), **options).L.nnz
        for rows in (np.arange(order.size), order)
    )
    assert dissected < 0.6 * natural
