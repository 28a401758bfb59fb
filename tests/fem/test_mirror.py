"""Constraints from above are mirror images of those from below, to the bit."""

import numpy as np
import pytest

from builders import DATA, delaunay, grid, perturbed, statement
from signorini.exceptions import SceneError, SolverError
from signorini.fem import mirror
from signorini.fem.contact_line import contact_rows
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.judge import judge
from signorini.rivals import RIVALS
from signorini.solvers import kkt_residual, solve
from signorini.solvers.attempts import attempts
from signorini.solvers.stored import read_solution, stored, write_solution

FROM_BELOW = DATA | {"contact_flux": "0.6*sin(9*x) - 0.2"}
FROM_ABOVE = {name: f"-({text})" for name, text in FROM_BELOW.items()}
MESHES = {"grid": lambda: grid(16), "delaunay": lambda: delaunay(0), "moved": lambda: perturbed(4)}
LOOSE = ("contact", "neumann", "neumann", "neumann")


@pytest.fixture(params=MESHES)
def mesh(request):
    return MESHES[request.param]()


@pytest.fixture(params=ELEMENTS)
def pair(request, mesh):
    """A problem bounded from below, and its mirror image as a scene states it."""
    below = discretize_on(mesh, request.param, statement(**FROM_BELOW))
    above = discretize_on(mesh, request.param, statement(constraint="upper", **FROM_ABOVE))
    return below, above


def test_the_mirror_image_is_what_a_scene_states(pair):
    below, above = pair
    image = mirror.mirrored(below)
    assert image.upper
    assert not mirror.mirrored(image).upper
    for name in ("b", "lower", "fixed_values", "contact_load"):
        np.testing.assert_array_equal(getattr(image, name), getattr(above, name))


def test_solutions_of_every_route_are_mirror_images_to_the_bit(pair):
    below, above = pair
    routes = [found.method for found in attempts(below)]
    for ours, theirs in zip(attempts(below), attempts(above), strict=True):
        one, other = ours.result(), theirs.result()
        assert 0 < one.active.sum() < one.active.size
        np.testing.assert_array_equal(other.u, -one.u)
        np.testing.assert_array_equal(other.multiplier, -one.multiplier)
        np.testing.assert_array_equal(other.flux, -one.flux)
        np.testing.assert_array_equal(other.active, one.active)
        assert (other.residual, other.accuracy) == (one.residual, one.accuracy)
    assert "direct" in routes


def test_signorinis_conditions_from_above(pair):
    _, problem = pair
    solution = solve(problem)
    gap = problem.lower - solution.u[problem.contact]
    density = problem.threshold / problem.contact_lengths
    assert np.all(gap >= 0)
    assert np.all(solution.flux <= density)
    assert np.all(gap[solution.active] == 0)
    np.testing.assert_array_equal(solution.flux[~solution.active], density[~solution.active])
    assert kkt_residual(problem, solution.u)[0] < 1e-12


def test_a_solution_from_below_is_none_from_above(pair):
    below, above = pair
    u = solve(below).u
    assert kkt_residual(below, u)[0] < 1e-12
    assert kkt_residual(mirror.mirrored(below), u)[0] > 1e-3
    assert kkt_residual(above, -u)[0] < 1e-12


def test_scaling_by_powers_of_two_changes_no_bit(pair):
    for problem in pair:
        solution = solve(problem)
        for power in (-40, 1, 200):
            scaled = solve(problem.scaled(power))
            np.testing.assert_array_equal(scaled.u, np.ldexp(solution.u, power))
            np.testing.assert_array_equal(scaled.flux, np.ldexp(solution.flux, power))


def test_rivals_and_the_judge_look_into_the_same_mirror(pair):
    _, problem = pair
    solution = solve(problem)
    answer = RIVALS["spsolve"].solve(problem)
    np.testing.assert_allclose(answer.u, solution.u, rtol=0, atol=1e-12)
    truth = judge(problem, solution)
    assert truth.distance(solution.u) < 1e-13
    decided = ~solution.undecided
    assert truth.multiplier_distance(solution.multiplier, decided) < 1e-11
    assert truth.wrong_side(solution.active, solution.undecided) == 0


def test_a_solution_bounded_from_above_comes_back_from_its_file(tmp_path, pair, mesh):
    _, problem = pair
    solution = solve(problem)
    write_solution(tmp_path / "s.npz", problem, solution, 4, 0.25)
    found = read_solution(tmp_path / "s.npz")
    assert found.upper is True
    np.testing.assert_array_equal(found.u, solution.u)
    np.testing.assert_array_equal(found.threshold, problem.threshold)
    np.testing.assert_array_equal(found.force, solution.force)
    kept, fresh = (contact_rows(mesh, one) for one in (found, stored(problem, solution, 4, 0.25)))
    assert kept == fresh


def test_a_plain_solution_is_stored_without_a_threshold_and_a_side(tmp_path):
    problem = discretize_on(grid(4), "P1", statement(**DATA))
    write_solution(tmp_path / "s.npz", problem, solve(problem), 4, 0.25)
    with np.load(tmp_path / "s.npz") as arrays:
        assert not {"threshold", "upper"} & set(arrays.files)
    assert read_solution(tmp_path / "s.npz").upper is False


def test_an_obstacle_below_the_dirichlet_values_is_refused_from_above():
    data = {"obstacle": 0.5, "dirichlet": 1}
    labels = ("contact", "dirichlet", "neumann", "neumann")
    corner = statement(labels, constraint="upper", **data)
    message = (
        r"at \(1, 0\), where contact and dirichlet parts meet: obstacle 0\.5 lies below dirichlet 1"
        r"; raise the obstacle or lower dirichlet there"
    )
    with pytest.raises(SceneError, match=message):
        discretize_on(grid(4, labels=labels), "P1", corner)


@pytest.mark.parametrize("side", ["lower", "upper"])
def test_a_loose_body_needs_a_load_towards_its_obstacle(side):
    sign = {"lower": 1, "upper": -1}[side]
    words = {"lower": "> 0 lifts u off", "upper": "< 0 draws u down from"}[side]
    message = rf"int f \+ int g = -?1\.000e\+00 {words} the obstacle"

    def solved(**data):
        loose = statement(LOOSE, constraint=side, **data)
        return solve(discretize_on(grid(4, labels=LOOSE), "P1", loose))

    with pytest.raises(SolverError, match=message):
        solved(f=sign)
    assert solved(f=-sign).active.any()
    with pytest.raises(SolverError, match=r"int f \+ int g \+ int contact_flux"):
        solved(f=-sign, contact_flux=2 * sign)
