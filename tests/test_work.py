"""What a solve reports of its work, and to whom."""

from threading import Thread

import pytest

from builders import DATA, grid, statement
from signorini.fem.problem import discretize_on
from signorini.solvers import solve
from signorini.work import Work, count, counting

PROBLEM = discretize_on(grid(8), "P1", statement(**DATA))


def work_of(method, problem=PROBLEM, guess=None):
    with counting() as work:
        solution = solve(problem, method, guess)
    return work, solution


@pytest.mark.parametrize(("method", "eliminations"), [("direct", 1), ("fourier", 2)])
def test_a_solve_reports_its_steps_and_factorisations(method, eliminations):
    """The fourier route keeps no factors: refinement sweeps again."""
    work, solution = work_of(method)
    assert work.steps == solution.iterations
    assert work.factorisations == eliminations
    assert work.cycles == 0
    assert (
        work.inner >= work.steps
    )  # each active set is judged by one product with the condensed matrix


def test_products_are_those_of_the_residuals_and_of_the_proof():
    assert work_of("fourier")[0].products == 3  # load less Dirichlet values, residual, proof
    assert work_of("direct")[0].products == 5  # and two residuals, rounding


def test_the_same_solve_does_the_same_work():
    assert work_of("direct")[0] == work_of("direct")[0]


def test_a_guess_saves_steps():
    cold, solution = work_of("direct")
    warm, _ = work_of("direct", guess=solution.active)
    assert warm.steps == 1 < cold.steps


def test_blocks_nest_and_do_not_share():
    with counting() as outer:
        count(products=1)
        with counting() as inner:
            count(cycles=2)
        count(products=1)
    count(products=100)
    assert (outer, inner) == (Work(products=2), Work(cycles=2))


def test_a_block_left_by_an_error_counts_no_more():
    with pytest.raises(ZeroDivisionError), counting() as work:
        raise ZeroDivisionError
    count(steps=1)
    assert work == Work()


def test_another_thread_is_not_counted():
    with counting() as work:
        thread = Thread(target=count, kwargs={"steps": 1})
        thread.start()
        thread.join()
    assert work == Work()


def test_an_unknown_name_is_refused():
    with pytest.raises(AttributeError, match="flops"), counting():
        count(flops=1)
