"""Forces that do not balance the load of a body are known to be wrong, whatever a route says."""

import pytest

import signorini
from signorini.solvers import select, solve


def two_pieces():
    """One is held on its top, and one by the inequality alone."""
    points = [[0.0, 1.0, 0.0, 3.0, 4.0, 3.0], [0.0, 0.0, 1.0, 0.0, 0.0, 1.0]]
    sides = {
        "held": lambda x, y: (y > 0.0) & (x < 2.0),
        "bottom": lambda x, y: y == 0.0,
        "rest": lambda x, y: (y > 0.0) & (x > 2.0),
    }
    mesh = signorini.triangulation((points, [[0, 3], [1, 4], [2, 5]]), sides).refined().refined()
    data = {"dirichlet": {"held": 0}, "contact": "bottom", "neumann": "rest"}
    return signorini.problem(mesh, "P1", f=-1, **data)


def one_piece():
    return signorini.problem(signorini.rectangle(4), "CR", f=-1, contact="bottom")


@pytest.fixture
def overstated(monkeypatch):
    """A route whose forces are all a hundred millionth too large, and called exact."""
    run = select._run_route

    def run_and_overstate(*arguments):
        found = run(*arguments)
        return found._replace(multiplier=found.multiplier * (1.0 + 1e-8), multiplier_accuracy=0.0)

    monkeypatch.setattr(select, "_run_route", run_and_overstate)


@pytest.mark.parametrize("body", [one_piece, two_pieces])
@pytest.mark.parametrize("method", ["direct", "multigrid"])
def test_what_is_left_of_the_balance_is_an_error_of_the_forces(overstated, body, method):
    solution = solve(body(), method=method)
    assert solution.status == "inaccurate"
    assert solution.multiplier_accuracy > 1e-8


@pytest.mark.parametrize("body", [one_piece, two_pieces])
@pytest.mark.parametrize("method", ["direct", "multigrid"])
def test_forces_that_balance_the_load_keep_their_accuracy(body, method):
    solution = solve(body(), method=method)
    assert solution.status == "solved"
    assert solution.multiplier_accuracy < 1e-13
