"""The search for the contact set, on problems that consist of contact dofs alone."""

import numpy as np
import pytest

from signorini.exceptions import SolverError
from signorini.solvers.contact import DenseContact, solve_contact
from signorini.solvers.route_result import ErrorEstimates, assess
from signorini.solvers.signs import Search, settle


class Dense(Search):
    """u >= 0 with A u - b >= 0 at all dofs; errors of gaps and forces are told to be `error`."""

    name, remedy = "dense", "; mend A"

    def __init__(self, A, b, active, error=1e-14):
        super().__init__(np.zeros(b.size), active)
        self.A, self.b, self.error, self.sets = A, b, error, []

    def refine(self):
        free = ~self.active
        self.sets.append(self.active.copy())
        self.u[self.active] = 0.0
        self.u[free] = np.linalg.solve(self.A[np.ix_(free, free)], self.b[free])
        self.gap, self.force = self.u, np.where(self.active, self.A @ self.u - self.b, 0.0)
        bounds = np.full(self.b.size, self.error)
        return ErrorEstimates(
            u=self.error,
            force=self.error,
            gaps=bounds,
            forces=bounds,
            loads=bounds,
            stiffness=self.A.diagonal(),
            force_scale=np.abs(self.b).max(),
        )

    def result(self, errors):
        return assess(self.u, self.active, self.steps, self.gap, self.force, errors)


def matrix(size, seed):
    """Symmetric, positive definite, with entries of both signs."""
    B = np.random.default_rng(seed).standard_normal((size, size))
    return B @ B.T + np.eye(size)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("binds", [True, False])
def test_any_start_ends_at_the_solution(seed, binds):
    A, b = matrix(12, seed), np.random.default_rng(seed + 100).standard_normal(12)
    found = settle(Dense(A, b, np.full(12, binds)))
    expected = solve_contact(DenseContact(A), b)
    np.testing.assert_array_equal(found.active, expected.active)
    np.testing.assert_allclose(found.u, expected.w, rtol=0, atol=1e-10)


def test_no_set_is_looked_at_twice_where_signs_are_sure():
    search = Dense(
        matrix(12, 3), np.random.default_rng(103).standard_normal(12), np.zeros(12, bool)
    )
    settle(search)
    assert len({active.tobytes() for active in search.sets}) == len(search.sets)


def test_a_gap_of_round_off_is_held_in_a_second_answer():
    A, b = np.eye(3), np.array([1.0, 1e-15, -1.0])
    search = Dense(A, b, np.array([False, False, True]))
    found = settle(search)
    assert [active.tolist() for active in search.sets] == [
        [False, False, True],
        [False, True, True],
    ]
    assert found.active.tolist() == [False, True, True]
    assert found.undecided.tolist() == [False, True, False]


def test_without_a_contact_set_it_ends_and_says_so():
    """Estimates that are no errors: every sign of this matrix is called wrong."""

    class Confused(Dense):
        def wrong_signs(self, errors):
            return np.ones(self.active.size, dtype=bool)

    with pytest.raises(SolverError, match=r"dense: no contact set in 100 steps, .*; mend A"):
        settle(Confused(np.eye(2), np.ones(2), np.zeros(2, dtype=bool)))
