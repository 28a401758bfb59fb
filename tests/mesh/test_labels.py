"""Labels of the boundary, by part and by formula: every facet exactly one."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signorini.exceptions import FormulaError, MeshError
from signorini.formula import Formula
from signorini.mesh.boundary import LABELS
from signorini.mesh.labels import label_boundary, labelled
from signorini.mesh.named_mesh import NamedMesh, with_sides
from signorini.mesh.patterns import alternating, criss_cross

MESH = criss_cross(8, 8, (0, 0), (1, 1))
RULES = {"bottom": "contact", "top": "dirichlet", "left": "neumann", "right": "neumann"}


def formula(text):
    return Formula(text, field="boundary")


def midpoints(mesh, facets):
    return 0.5 * mesh.p[:, mesh.facets[:, facets]].sum(axis=1)


def test_facets_have_scikit_fem_numbers_and_labels_survive_refinement():
    from skfem import MeshTri

    found = label_boundary(MESH, RULES)
    mesh = MeshTri(MESH.p, MESH.t)
    assert np.array_equal(mesh.facets, MESH.facets)
    assert np.array_equal(np.sort(np.concatenate(list(found.values()))), mesh.boundary_facets())
    fine = labelled(MESH, RULES).refined().refined()
    for label, facets in found.items():
        assert np.array_equal(labelled(MESH, RULES).boundary_facets(label), facets)
        fine_facets = fine.boundary_facets(label)
        assert fine_facets.size == 4 * facets.size
        from_centre = np.abs(midpoints(fine, fine_facets) - 0.5).max(axis=0)
        assert (from_centre == 0.5).all()
    assert (fine.p[1, fine.boundary_vertices("contact")] == 0).all()


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("offset", [0.0, 1e4, 1e6])
def test_sides_of_the_bounding_box_need_no_tolerance(scale, offset):
    mesh = NamedMesh(scale * (MESH.p + offset), MESH.t)
    named = with_sides(mesh)
    for side, ends in MESH.parts.items():
        assert np.array_equal(np.sort(named.parts[side], axis=0), np.sort(ends, axis=0))
    assert {k: v.tolist() for k, v in label_boundary(named, RULES).items()} == {
        k: v.tolist() for k, v in label_boundary(MESH, RULES).items()
    }


def test_a_part_keeps_its_name_against_a_side():
    mesh = with_sides(NamedMesh(MESH.p, MESH.t, {"top": MESH.parts["left"]}))
    assert np.array_equal(mesh.parts["top"], MESH.parts["left"])


def test_formulas_select_by_their_sign_at_midpoints():
    rules = [
        ("top", "dirichlet"),
        (formula("where(y == 0 and x < 0.4, 1, 0)"), "contact"),
        (formula("where(y == 0 and x > 0.4, 1, -1)"), "neumann"),
        (formula("y * (1 - y)"), "neumann"),
    ]
    found = label_boundary(MESH, rules)
    # 0.4 lies inside the fourth facet, whose midpoint is at 0.4375.
    assert midpoints(MESH, found["contact"])[0].tolist() == [0.0625, 0.1875, 0.3125]
    assert {label: facets.size for label, facets in found.items()} == {
        "dirichlet": 8,
        "contact": 3,
        "neumann": 21,
    }


def test_a_constant_formula_selects_all():
    assert label_boundary(MESH, [(formula("1"), "contact")])["contact"].size == 32


def test_two_rules_may_give_a_facet_the_same_label():
    rules = [*RULES.items(), (formula("0.05 - y"), "contact"), ("bottom", "contact")]
    assert {label: facets.tolist() for label, facets in label_boundary(MESH, rules).items()} == {
        label: facets.tolist() for label, facets in label_boundary(MESH, RULES).items()
    }


REFUSED = {
    # case: (rules, words of the message)
    "no rules": ([], "32 boundary facets of rectangle have no label"),
    "no label": (
        list(RULES.items())[1:],
        "8 boundary facets of rectangle have no label: facet 0 at (0.0625, 0), ",
    ),
    "two labels": (
        [*RULES.items(), (formula("0.1 - x"), "contact")],
        "9 boundary facets of rectangle have more than one label",
    ),
    "unknown label": (
        [("bottom", "free")],
        "unknown label 'free' for part 'bottom'; known: dirichlet, contact, neumann",
    ),
    "unknown part": (
        [("buttom", "contact")],
        "rectangle has no part 'buttom'; its parts: bottom, right, top, left; did",
    ),
    "a formula that selects nothing": (
        [*RULES.items(), (formula("y - 1"), "contact")],
        "the formula 'y - 1' is positive at no boundary facet's midpoint",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case):
    rules, words = REFUSED[case]
    with pytest.raises(MeshError) as caught:
        label_boundary(MESH, rules)
    message = str(caught.value)
    assert message.startswith("boundary: ")
    assert words in message
    assert "\n" not in message
    assert message.count(" at (") <= 5


def test_a_formula_that_is_not_finite_names_itself():
    with pytest.raises(FormulaError, match="boundary: value is nan"):
        label_boundary(MESH, [(formula("sqrt(x - 0.5)"), "contact")])


def test_parts_inside_the_domain_or_across_it_are_refused():
    mesh = alternating(2, 2, (0, 0), (2, 2))
    for ends, words in (
        ((3, 4), "lies inside"),
        ((0, 8), "is no side"),
        ((0, -1), "a vertex to another is no side"),
    ):
        named = NamedMesh(mesh.p, mesh.t, mesh.parts | {"cut": np.array([ends]).T})
        with pytest.raises(MeshError, match=f"part 'cut': the line .*{words}"):
            label_boundary(named, RULES | {"cut": "contact"})


@given(
    parts=st.lists(st.tuples(st.sampled_from(sorted(RULES)), st.sampled_from(LABELS)), max_size=6),
    lines=st.lists(
        st.tuples(
            st.integers(-8, 8), st.integers(-8, 8), st.integers(-9, 9), st.sampled_from(LABELS)
        ),
        max_size=3,
    ),
)
@settings(max_examples=100, deadline=None)
def test_random_rules_label_every_facet_once_or_are_refused(parts, lines):
    rules = [
        *parts,
        *((formula(f"({a})*x + ({b})*y + ({c})/8"), label) for a, b, c, label in lines),
    ]
    x, y = midpoints(MESH, MESH.boundary)
    on = {"bottom": y == 0, "right": x == 1, "top": y == 1, "left": x == 0}
    expected = {}
    for side, label in parts:
        expected[label] = expected.get(label, False) | on[side]
    for a, b, c, label in lines:
        expected[label] = expected.get(label, False) | (a * x + b * y + c / 8 > 0)
    sound = (np.sum([np.zeros(32), *expected.values()], axis=0) == 1).all()
    sound = sound and all((a * x + b * y + c / 8 > 0).any() for a, b, c, _ in lines)
    try:
        found = label_boundary(MESH, rules)
    except MeshError:
        assert not sound
    else:
        assert sound
        assert all(
            np.array_equal(found[label], MESH.boundary[mask]) for label, mask in expected.items()
        )
