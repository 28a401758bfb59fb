"""Errors on the common refinement of two cuts of a rectangle: by looking up every point, by counts,
and by nesting.
"""

import numpy as np
import pytest
from skfem import Basis, ElementTriP0, MeshTri
from test_errors import evaluate

from builders import grid, perturbed
from signorini.errors.overlay import Overlay
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import MeshError
from signorini.fem.elements import ELEMENTS, find_element
from signorini.mesh.domain import Rectangle
from signorini.mesh.patterns import PATTERNS, criss_cross

DIAGONALS = ("falling", "rising", *PATTERNS)
RULES = ("exact", "midpoints", "centroid", "vertices")
NESTING = {"falling", "rising", "alternating-rising", "criss-cross"}
SIDES = {"top": "dirichlet", "bottom": "contact", "left": "neumann", "right": "neumann"}
BOX = ((-1.0, 2.0), (1.5, 1.0))


def level(diagonal, n):
    return Rectangle(*BOX, diagonal, "per-side", SIDES).level(n)


def random_function(mesh, name, seed):
    return name, np.random.default_rng(seed).standard_normal(find_element(name).size(mesh))


def brute_force(fine, reference, coarse, solution, n):
    """Exact norms on all quarters of n by n cells, both functions evaluated by looking every point
    up.
    """
    cut = criss_cross(n, n, *BOX)
    basis = Basis(MeshTri(cut.p, cut.t), ElementTriP0(), intorder=2)
    x, y = np.asarray(basis.global_coordinates()).reshape(2, -1)
    (u, du), (v, dv) = (evaluate(m, *f, x, y) for m, f in ((fine, reference), (coarse, solution)))
    dx = basis.dx.ravel()
    l2, semi = np.sum(dx * (u - v) ** 2), np.sum(dx * (du - dv) ** 2)
    return {"l2": np.sqrt(l2), "h1_semi": np.sqrt(semi), "h1": np.sqrt(l2 + semi)}


@pytest.mark.parametrize(("fine", "coarse"), [(4, 2), (4, 4), (6, 2), (3, 1)])
@pytest.mark.parametrize("of_coarse", DIAGONALS)
@pytest.mark.parametrize("of_fine", DIAGONALS)
def test_brute_force_agrees_for_every_pair_of_diagonals(of_fine, of_coarse, fine, coarse):
    meshes = level(of_fine, fine), level(of_coarse, coarse)
    for k, name in enumerate(ELEMENTS):
        reference, solution = (
            random_function(meshes[0], "P1", 1 + k),
            random_function(meshes[1], name, 3 + k),
        )
        expected = brute_force(meshes[0], reference, meshes[1], solution, fine)
        found = Overlay(*meshes).errors(reference, solution)["exact"]
        assert found == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("diagonal", DIAGONALS)
@pytest.mark.parametrize(("n", "ratio"), [(1, 2), (2, 4), (3, 2), (4, 8)])
def test_which_families_nest(diagonal, n, ratio):
    """Under doubling, all but the alternating one whose even cells fall: there all coarse diagonals
    cut triangles.
    """
    fine, m = level(diagonal, ratio * n), ratio * n
    count = Overlay(fine, level(diagonal, n)).area.size
    assert count - fine.number_of_triangles == (0 if diagonal in NESTING else 2 * n * m)


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
@pytest.mark.parametrize("name", ELEMENTS)
@pytest.mark.parametrize("rule", RULES)
def test_on_nested_grids_it_is_the_error_against_a_reference(diagonal, name, rule):
    fine, coarse = level(diagonal, 8), level(diagonal, 2)
    reference, solution = random_function(fine, "P1", 1), random_function(coarse, name, 2)
    expected = ReferenceErrors(fine, *reference, quadrature=rule).of(coarse, *solution)
    assert Overlay(fine, coarse).errors(reference, solution, RULES)[rule] == pytest.approx(
        expected, rel=1e-13
    )


@pytest.mark.parametrize("of_coarse", DIAGONALS)
@pytest.mark.parametrize("of_fine", DIAGONALS)
def test_midpoints_are_exact_and_the_other_rules_are_not(of_fine, of_coarse):
    fine, coarse = level(of_fine, 4), level(of_coarse, 2)
    found = Overlay(fine, coarse).errors(
        random_function(fine, "P1", 1), random_function(coarse, "CR", 2), RULES
    )
    l2 = {rule: norms["l2"] for rule, norms in found.items()}
    assert l2["midpoints"] == pytest.approx(l2["exact"], rel=1e-14)
    assert l2["centroid"] < 0.99 * l2["exact"] < 1.01 * l2["exact"] < l2["vertices"]
    assert len({norms["h1_semi"] for norms in found.values()}) == 1


def test_a_rule_sees_the_pieces_of_a_triangle_that_is_cut():
    """u = 0 on a rising cell, v the hat of a criss-cross one: four quarters, with 0, 0 and 1 at
    their corners.
    """
    sides = dict.fromkeys(SIDES, "dirichlet")
    fine, coarse = (
        Rectangle((0, 0), (1, 1), d, "per-side", sides).level(1) for d in ("rising", "criss-cross")
    )
    overlay = Overlay(fine, coarse)
    found = overlay.errors(("P1", np.zeros(4)), ("P1", np.array([0.0, 0, 0, 0, 1])), RULES)
    assert overlay.area == pytest.approx([0.25] * 4)
    squares = {rule: norms["l2"] ** 2 for rule, norms in found.items()}
    assert squares == pytest.approx(
        {"exact": 1 / 6, "midpoints": 1 / 6, "centroid": 1 / 9, "vertices": 1 / 3}
    )
    assert found["exact"]["h1_semi"] == pytest.approx(2.0)


@pytest.mark.parametrize("power", [-900, -1, 500])
def test_powers_of_two_pass_through_unrounded(power):
    fine, coarse = level("alternating", 4), level("alternating", 2)
    (name, u), (other, v) = random_function(fine, "P1", 1), random_function(coarse, "CR", 2)
    overlay = Overlay(fine, coarse)
    plain = overlay.errors((name, u), (other, v), RULES)
    scaled = overlay.errors((name, np.ldexp(u, power)), (other, np.ldexp(v, power)), RULES)
    assert all(scaled[rule]["l2"] == np.ldexp(plain[rule]["l2"], power) for rule in RULES)


@pytest.mark.parametrize(
    ("fine", "coarse", "message"),
    [
        (
            lambda: level("falling", 4),
            lambda: level("falling", 3),
            "4 by 4 cells do not refine 3 by 3",
        ),
        (
            lambda: level("falling", 2),
            lambda: level("rising", 4),
            "2 by 2 cells do not refine 4 by 4",
        ),
        (lambda: grid(4), lambda: level("falling", 2), "4 by 4 cells do not refine 2 by 2"),
        (lambda: perturbed(4), lambda: grid(2), "32 triangles are not 4 by 4 cells"),
    ],
)
def test_meshes_that_do_not_fit_are_refused(fine, coarse, message):
    with pytest.raises(MeshError, match=message):
        Overlay(fine(), coarse())
