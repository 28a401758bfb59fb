"""Rates on curved domains: L2 2 and H1 1, where a polygon of fixed chords stalls."""

import numpy as np
import pytest

from curved import UNIT
from signorini.errors.measure import against_exact
from signorini.errors.rates import slopes
from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import MeshError, SceneError
from signorini.scene.scene import Scene
from signorini.solvers import solve
from signorini.solvers.stored import stored

SQUARE = [[1, 0], [0, 1], [-1, 0], [0, -1]]


def disc(shape):
    """The mode r**3 cos(3 theta): its flux is given on the lower arc, its values above."""
    return Scene.from_dict(
        {
            "domain": {
                "kind": "polygon",
                "corners": SQUARE,
                "sides": ["upper", "upper", "lower", "lower"],
                "boundary_shape": dict.fromkeys(("upper", "lower"), shape),
            },
            "boundary": {"upper": "dirichlet", "lower": "neumann"},
            "levels": [4, 8, 16, 32],
            "truth": {"kind": "exact", "u": "r**3*cos(3*theta)"},
        }
    )


def ring(shapes=True, **data):
    """Contact on the whole inner circle, held at the outer one: u = (r**2 - 1)/4 - a log(r), which
    is radial.
    """
    curves = {"rim": UNIT, "hole-0": {"center": [0, 0], "radius": 0.5}}
    domain = {
        "kind": "polygon",
        "corners": SQUARE,
        "sides": ["rim"] * 4,
        "holes": [[[0.5 * x, 0.5 * y] for x, y in SQUARE]],
    }
    return Scene.from_dict(
        {
            "domain": domain | ({"boundary_shape": curves} if shapes else {}),
            "boundary": {"rim": "dirichlet", "hole-0": "contact"},
            "data": {"f": -1, "obstacle": "-3/16 + 0.5*log(2)"} | data,
            "levels": [4, 8, 16, 32],
            "truth": {"kind": "exact", "u": "(r**2 - 1)/4 - 0.5*log(r)"},
            "norms": ["l2", "h1", "trace_l2", "multiplier_l2"],
        }
    )


def errors(scene, element):
    """Rows of errors, level by level."""
    found = against_exact(
        scene.problem_statement, scene.problem_statement.triangulations, scene.document["norms"]
    )
    for n in scene.levels:
        problem = scene.problem(element, n)
        solution = solve(problem)
        assert solution.status == "solved"
        yield found(stored(problem, solution, n, 1 / n)), solution


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("shape", [UNIT, "x**2 + y**2 - 1"])
def test_a_disc_converges(element, shape):
    rows = [row for row, _ in errors(disc(shape), element)]
    widths = [1 / n for n in (4, 8, 16, 32)]
    for norm, rate in (("l2", 2), ("h1", 1)):
        found = slopes(widths, [row[norm] for row in rows])["mean"]
        assert found == pytest.approx(rate, abs=0.1)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_full_contact_on_a_circle_converges_with_its_force(element):
    """du/dnu = -u' (1/2) = 3/4 at all points of the inner circle."""
    found = list(errors(ring(), element))
    assert all(solution.active.all() for _, solution in found)
    rows = [row for row, _ in found]
    widths = [1 / n for n in (4, 8, 16, 32)]
    for norm, rate in (("l2", 2), ("h1", 1), ("trace_l2", 2), ("multiplier_l2", 1)):
        slope = slopes(widths, [row[norm] for row in rows])["fit"]
        assert slope > rate - 0.15, norm


def test_without_its_curve_the_same_problem_is_refused_for_its_truth_does_not_fit():
    with pytest.raises(SceneError, match="fails"):
        ring(shapes=False).check()


def test_a_reference_is_refused_with_the_reason():
    scene = disc(UNIT)
    mesh = scene.problem_statement.triangulations.level(8)
    with pytest.raises(MeshError, match="levels of a curved side do not nest"):
        ReferenceErrors(mesh, "P1", np.zeros(mesh.number_of_vertices))
    document = {key: scene.document[key] for key in ("domain", "boundary")}
    document |= {"data": {"f": 1}, "levels": [4, 8], "truth": {"kind": "reference", "n": 32}}
    with pytest.raises(
        SceneError, match=r"domain.boundary_shape: the levels .* use an exact truth"
    ):
        Scene.from_dict(document)
