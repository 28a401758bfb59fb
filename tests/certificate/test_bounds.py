"""Certificates on scenes whose solution is known."""

import numpy as np
import pytest

from signorini.certificate.bubbles import TOLERANCE
from signorini.certificate.certify import certify_level
from signorini.solvers import solve

EXACT = (
    *("corner", "punch", "smooth", "biactive", "uniform-load"),
    *("cascavita-chouly-ern", "hansbo-larson", "hansbo-larson-corner"),
)
SLACK = 1e-9  # uniform-load's bound of P1 is the error itself


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("n", [8, 16, 64])
def test_bounds_enclose_the_error(name, element, n, level, certificates):
    certificate, error = certificates(name, n)[0][element], level(name, n).errors[element]
    assert certificate.lower <= error["energy"] * (1.0 + SLACK)
    assert certificate.upper >= error["energy"] * (1.0 - SLACK)
    assert certificate.l2 >= error["l2"]


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize(("element", "most"), [("P1", 1.08), ("CR", 1.04)])
def test_bounds_are_near_the_error(name, element, most, level, certificates):
    """At n = 16; measured: at most 1.070 and 1.032."""
    certificate, error = certificates(name, 16)[0][element], level(name, 16).errors[element]
    assert certificate.upper <= most * error["energy"]
    assert certificate.lower >= 0.95 * error["energy"]


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_bounds_are_nearer_on_finer_meshes(name, element, level, certificates):
    """At n = 64; measured: at most 1.020 from above, at least .966 from below."""
    certificate, error = certificates(name, 64)[0][element], level(name, 64).errors[element]
    assert certificate.upper <= 1.025 * error["energy"]
    assert certificate.lower >= 0.96 * error["energy"]


@pytest.mark.parametrize("n", [4, 16, 64])
def test_of_p1_under_a_uniform_load_the_bound_is_the_error(n, level, certificates):
    certificate, error = certificates("uniform-load", n)[0]["P1"], level("uniform-load", n).errors
    assert certificate.upper == pytest.approx(error["P1"]["energy"], rel=TOLERANCE**2)


def test_what_is_exact_has_an_error_of_rounding(certificates):
    for certificate in certificates("patch", 16)[0].values():
        assert certificate.lower == 0.0
        assert certificate.upper < 1e-10


@pytest.mark.parametrize("name", [*EXACT, "patch"])
def test_energies_enclose_one_another(name, certificates):
    """J(u) lies in the intervals of all levels."""
    found = [certificates(name, n)[0]["P1"] for n in (8, 16, 64)]
    assert all(one.dual <= one.primal for one in found)
    assert max(one.dual for one in found) <= min(one.primal for one in found) + 1e-13


def test_the_energy_under_a_uniform_load_is_minus_a_sixth(certificates):
    """u = (1 - y^2) / 2."""
    certificate = certificates("uniform-load", 16)[0]["CR"]
    assert certificate.dual <= -1 / 6 <= certificate.primal
    assert certificate.primal - certificate.dual < 1e-5


def test_the_gap_is_the_difference_of_the_energies_of_the_affine_load(certificates):
    """Without a load there is nothing else."""
    for name in ("corner", "punch"):
        certificate = certificates(name, 16)[0]["P1"]
        assert certificate.primal - certificate.dual == pytest.approx(certificate.gap, rel=1e-9)


def test_contributions_add_up_to_the_bound(certificates):
    """But for what the contact term and the ball add."""
    for certificate in certificates("smooth", 16)[0].values():
        assert certificate.contributions.min() >= 0.0
        total = np.sqrt(certificate.contributions.sum())
        assert total == pytest.approx(certificate.upper, rel=0.02)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_what_lies_outside_the_ball_of_the_middle_is_told_by_it(element, level, certificates):
    """The middle of a pair is nearer to grad u than either solution: its radius is certified."""
    _, enclosure = certificates("smooth", 64)
    assert enclosure.radius < 0.1 * level("smooth", 64).errors[element]["energy"]


def test_another_conforming_function_is_certified_too(level):
    """u_P1 + 1 % misses its Dirichlet values, which counts from there."""
    from signorini.errors.exact import ExactErrors
    from signorini.exact import family

    found, exact = level("corner", 16), family("corner", {"x0": "1/3"})
    u = 1.01 * found.u["P1"]
    certificate = certify_level(found.mesh, found.data, u, found.u["CR"])[0]["P1"]
    error = ExactErrors(exact, ["energy"]).of(found.mesh, "P1", u)["energy"]
    assert certificate.lower <= error <= certificate.upper <= 2.0 * error


def test_a_mirrored_problem_has_the_same_bounds(level, certificates):
    from dataclasses import replace

    from signorini.certificate.mirror import mirrored

    found = level("smooth", 8)
    data = mirrored(found.data)
    assert data.constraint == "upper"
    mirror = certify_level(found.mesh, data, -found.u["P1"], -found.u["CR"])[0]
    for element, certificate in certificates("smooth", 8)[0].items():
        plain, found = (
            vars(replace(one, contributions=None)) for one in (certificate, mirror[element])
        )
        assert found == plain


def test_scaled_data_scale_the_bounds(level, certificates):
    """u is linear in all data but for the constraint, which is scaled with it."""
    from signorini.fem.problem import discretize_on
    from signorini.formula import Formula
    from signorini.scene.statement import ProblemStatement

    texts = {"f": "-9 + 20*x", "g": "y", "dirichlet": "0.1*x**2", "obstacle": "-0.1*x"}
    found = level("paper-exact", 8)
    bounds = []
    for factor in ("", "8*"):
        section = {name: f"{factor}({text})" for name, text in texts.items()}
        statement = ProblemStatement.from_mapping(
            {"domain": {}, "boundary": {}, "data": section, "load_quadrature": "exact"}
        )
        assert isinstance(statement.data.f, Formula)
        u = [solve(discretize_on(found.mesh, name, statement)).u for name in ("P1", "CR")]
        bounds.append(certify_level(found.mesh, statement.data, *u)[0])
    for element, certificate in bounds[0].items():
        assert bounds[1][element].upper == pytest.approx(8.0 * certificate.upper, rel=1e-12)
        assert bounds[1][element].lower == pytest.approx(8.0 * certificate.lower, rel=1e-9)
        assert bounds[1][element].gap == pytest.approx(64.0 * certificate.gap, rel=1e-12)
