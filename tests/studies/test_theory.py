"""The theory study: its two sides are computed apart, and known identities tie them together."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import signorini
from builders import grid
from signorini.errors.exact import ExactErrors
from signorini.exact import family
from signorini.fem.problem import discretize
from signorini.solvers import solve
from signorini.studies.theory import page
from signorini.studies.theory.contact_terms import contact_terms
from signorini.studies.theory.estimates import ESTIMATES, estimates_of, measure_level
from signorini.studies.theory.exact_parts import (
    edge_integrals,
    interpolate,
    second_derivatives,
    sobolev_norms,
)
from signorini.studies.theory.traces import (
    counterexample,
    half_trace,
    point_trace,
    trace_rows,
    triangle_trace,
)

SCENES = ("corner", "punch", "smooth", "biactive")
LEVELS = (4, 8, 16, 32)


@pytest.fixture(scope="module", params=SCENES)
def scene(request):
    return signorini.load_scene(f"config/scenes/{request.param}.yaml")


@pytest.fixture(scope="module")
def measured(scene):
    return estimates_of(scene, LEVELS)


def constants(estimates, name):
    return np.array([row["constant"] for row in estimates if row["statement"] == name])


def test_the_gradient_of_the_interpolant_is_the_mean_of_the_gradient(scene):
    """So |u - u_h|^2 = |u - Pi u|^2 + |Pi u - u_h|^2 for every u_h of the space."""
    statement = scene.problem_statement
    problem = discretize(statement, "CR", 8)
    u_h, interpolant = solve(problem).u, interpolate(statement.exact, problem.mesh)
    seminorm = ExactErrors(statement.exact, ["h1_semi"])
    error, approximation = (
        seminorm.of(problem.mesh, "CR", u)["h1_semi"] ** 2 for u in (u_h, interpolant)
    )
    rest = (interpolant - u_h) @ problem.apply(interpolant - u_h)
    assert error == pytest.approx(approximation + rest, rel=1e-5)


def test_lemma_2_1_holds_with_a_constant_near_one(measured):
    """With v_h = Pi u and homogeneous Dirichlet data it holds with C = 1."""
    found = constants(measured[0], "Lemma 2.1")
    assert np.all((found > 0.98) & (found < 1.01))


@pytest.mark.parametrize("name", ["Lemma 4.1", "Theorem 4.2", "Theorem 4.3"])
def test_constants_stay_bounded(measured, name):
    found = constants(measured[0], name)
    assert np.all(found < 0.4)
    assert found[-1] < 1.01 * found[-2]


def test_contact_terms_are_of_higher_order_than_the_squared_error(measured):
    _, terms = measured
    for term in ("D1", "D2", "A"):
        shares = [abs(row[term]) / row["error"] ** 2 for row in terms]
        assert shares[-1] <= 0.7 * shares[0]


def test_every_contact_edge_is_of_one_kind(measured):
    for row in measured[1]:
        assert row["binding"] + row["mixed"] + row["free"] == row["n"] * contact_length(row)
        assert row["mixed"] <= 2


def contact_length(row):
    """Of the scenes' contact sides: 1 or 2 units; all edges have width h."""
    return round((row["binding"] + row["mixed"] + row["free"]) * row["h"])


def test_terms_add_up_to_the_sum_over_all_edges(scene):
    statement = scene.problem_statement
    problem = discretize(statement, "CR", 8)
    u_h, interpolant = solve(problem).u, interpolate(statement.exact, problem.mesh)
    obstacle = statement.data.obstacle
    terms = contact_terms(statement.exact, obstacle, problem.mesh, u_h, interpolant)
    swapped = contact_terms(statement.exact, obstacle, problem.mesh, interpolant, u_h)
    assert swapped.total == pytest.approx(-terms.total, abs=1e-12)


def test_what_a_level_knows_does_not_depend_on_the_others(scene):
    statement = scene.problem_statement
    norms = sobolev_norms(statement.exact, statement.triangulations.level(64))
    level = measure_level(statement, 8, norms)
    (row,) = estimates_of(scene, [8])[1]
    assert (row["error"], row["A"]) == (level.error, level.terms.A)
    assert len(ESTIMATES) == len(estimates_of(scene, [8])[0])


def test_second_derivatives_of_a_known_solution():
    """Of r**(3/2) cos(3 theta/2): |D^2 u|^2 = 2 (3/4)^2 / r."""
    x, y = np.random.default_rng(0).uniform(-1, 1, (2, 50))
    y = np.abs(y)
    uxx, uxy, uyy = second_derivatives(family("corner"), x, y)
    assert_allclose(uxx**2 + 2 * uxy**2 + uyy**2, 2 * 0.75**2 / np.hypot(x, y), rtol=1e-9)
    assert_allclose(uxx + uyy, 0.0, atol=1e-6)


def test_norms_of_a_known_solution():
    """Of alpha (1 - y) on the unit square: 1/3, 1 and 0, squared; slope 1 along the sides."""
    norms = sobolev_norms(family("patch"), grid(8))
    assert_allclose([norms.l2**2, norms.h1_semi, norms.boundary_lipschitz], [1 / 3, 1, 1])
    assert norms.h2_semi < 1e-6


def test_edge_integrals_are_exact_beside_a_singularity():
    """Of sqrt(x) over edges of which one starts at zero."""
    ends = np.array([[[0.0, 0.25], [0.25, 1.0]], [[0.0, 0.0], [0.0, 0.0]]])
    found = edge_integrals(lambda x, y, s, which: np.sqrt(x), ends, [(0.0, 0.0)])
    assert_allclose(found, [0.25**1.5 / 1.5, (1 - 0.25**1.5) / 1.5], rtol=1e-7)


def test_the_interpolant_takes_means_over_edges():
    mesh = grid(3)
    exact = signorini.load_scene("config/scenes/smooth.yaml").problem_statement.exact
    s = (np.arange(2000) + 0.5) / 2000
    start, end = (np.asarray(mesh.p)[:, ends][:, :, None] for ends in np.asarray(mesh.facets))
    means = exact.value(*(start + s * (end - start))).mean(axis=1)
    assert_allclose(interpolate(exact, mesh), means, atol=1e-6)


def test_trace_constants_rise_with_the_space_to_their_limits():
    found = [triangle_trace(d) for d in (0, 1, 2, 4, 8)]
    assert found == sorted(found)
    assert found[0] ** 2 == pytest.approx(4 + 2 * np.sqrt(2))  # perimeter over area
    assert found[-1] == pytest.approx(found[-2], rel=1e-7)
    assert point_trace(10) == pytest.approx(2 / np.pi, rel=1e-12)


@pytest.mark.parametrize("width", [1 / 4, 1 / 64])
def test_half_trace_is_the_greatest_quotient(width):
    """Held against an eigenvalue problem on the functions that vanish at the end."""
    modes = 40
    k = np.arange(modes + 1)
    a = np.where(k == 0, width, width / 2)
    b = a * (1 + k * np.pi / width)
    basis = np.vstack([np.ones(modes), -np.eye(modes)])  # 1 - cos(k pi s / h)
    first, second = (basis.T @ (w[:, None] * basis) for w in (a, b))
    greatest = np.linalg.eigvals(np.linalg.solve(second, first)).real.max()
    assert half_trace(modes, width) == pytest.approx(np.sqrt(greatest / width), rel=1e-9)


def test_the_norms_of_the_counterexample_by_quadrature():
    m, width = 12, 0.5
    s = (np.arange(200_000) + 0.5) / 200_000 * width
    k = np.arange(1, m + 1)
    harmonic = np.sum(1 / k)
    v = 1 - (np.cos(np.outer(s, k) * np.pi / width) / k).sum(axis=1) / harmonic
    squared = width * np.mean(v**2)
    half = squared + np.pi / (2 * harmonic)
    assert counterexample(m, width) == pytest.approx(np.sqrt(squared / (width * half)), rel=1e-8)


def test_the_constant_of_3_6_grows_without_a_bound_that_serves_every_width():
    by_modes = [half_trace(m, 1 / 256) for m in (16, 256, 4096)]
    assert by_modes == sorted(by_modes)
    assert [counterexample(10**6, h) for h in (1 / 4, 1 / 16, 1 / 64)] == sorted(
        counterexample(10**6, h) for h in (1 / 4, 1 / 16, 1 / 64)
    )
    assert all(half_trace(64, h) < h**-0.5 for h in (1 / 4, 1 / 64))


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([1.0, 0.5, 0.25], "better"),
        ([1.0, 1.01, 1.0], "bounded"),
        ([1.0, 0.85, 0.7], "falls"),
        ([1.0, 1.5, 2.0], "grows"),
        ([0.0, 0.0], "better"),
    ],
)
def test_verdicts(values, expected):
    assert page.verdict({"scene": values}) == expected


@pytest.mark.parametrize("layout", ["markdown", "latex"])
def test_the_page_says_what_the_rows_say(measured, scene, layout):
    estimates, terms = ([{"scene": scene.name} | row for row in rows] for rows in measured)
    text = page.page(layout, estimates, terms, trace_rows())
    first = constants(measured[0], "Theorem 4.3")[0]
    assert f"{first:.2g}" in text
    assert "NOT confirmed" not in text
    grown = [row | {"constant": row["constant"] * row["n"]} for row in estimates]
    assert "NOT confirmed" in page.page(layout, grown, terms, trace_rows())
