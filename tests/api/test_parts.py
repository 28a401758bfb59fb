"""Data of parts of the boundary: a part that is not there, or on which they cannot act, is told."""

import numpy as np
import pytest
import skfem

import signorini
from signorini.exceptions import SceneError, SignoriniError
from signorini.mesh.grid import Grid

NAMES = ["bottom", "right", "top", "left"]
SQUARE = skfem.MeshTri().refined(2)
LABELS = ("contact", "neumann", "dirichlet", "neumann")
GRID = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", LABELS)
POLYGON = signorini.polygon([(0, 0), (1, 0), (1, 1), (0, 1)], 4, sides=NAMES)
MESHES = {
    "rectangle": signorini.rectangle(4),
    "criss-cross": signorini.rectangle(4, diagonal="criss-cross"),
    "scikit-fem": SQUARE,
    "refined": signorini.triangulation(SQUARE).refined(),
    "polygon": POLYGON,
}
LABELLED = {
    "grid": GRID,
    "triangulation": signorini.problem(
        SQUARE, "P1", f=1, dirichlet="top", contact="bottom", neumann=["right", "left"]
    ).mesh,
}
SIDES = {"dirichlet": {"top": 0}, "contact": "bottom"}


def told(mesh, **given):
    with pytest.raises(SignoriniError) as caught:
        signorini.problem(mesh, "P1", f=1, **given)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
@pytest.mark.parametrize("field", ["obstacle", "contact_flux", "g"])
def test_a_part_that_is_misspelt_is_refused(mesh, field):
    message = told(mesh, **SIDES, **{field: {"botom": 1}})
    assert message.startswith(
        f"{field}: the boundary has no part 'botom'; did you mean bottom? known: "
    )


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
@pytest.mark.parametrize("field", ["obstacle", "contact_flux", "g"])
def test_a_part_that_is_a_number_is_refused(mesh, field):
    message = told(mesh, **SIDES, **{field: {1: 1}})
    assert message.startswith(f"{field}: [1] (list) names no part of the boundary; give a name")


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
@pytest.mark.parametrize("field", ["obstacle", "contact_flux"])
@pytest.mark.parametrize("part", ["right", "top"])
def test_a_part_that_is_not_in_contact_is_refused(mesh, field, part):
    message = told(mesh, **SIDES, **{field: {"bottom": 0, part: 0}})
    wanted = f"{field}: {part!r} is not in contact; name it in contact, or leave it out"
    assert message == wanted


@pytest.mark.parametrize("mesh", LABELLED.values(), ids=LABELLED)
@pytest.mark.parametrize("field", ["obstacle", "contact_flux", "g", "dirichlet"])
def test_parts_of_a_mesh_that_has_labels_are_checked_too(mesh, field):
    assert "no part 'botom'; did you mean bottom?" in told(mesh, **{field: {"botom": 1}})
    wrong = "bottom" if field in ("g", "dirichlet") else "right"
    assert told(mesh, **{field: {wrong: 1}}).startswith(f"{field}: {wrong!r} is not ")
    right = {"g": "right", "dirichlet": "top"}.get(field, "bottom")
    assert signorini.problem(mesh, "P1", f=1, **{field: {right: 0}}).contact.size == 5


def test_another_name_of_facets_in_contact_is_refused():
    """The mesh would know nothing of it, and the datum would be 0."""
    facets = SQUARE.facets_satisfying(lambda x: x[1] == 0, boundaries_only=True)
    mesh = SQUARE.with_boundaries({"floor": facets, "start": facets[:2]})
    assert "'floor' is not in contact" in told(mesh, contact="start", obstacle={"floor": 1})


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_part_that_the_obstacle_leaves_out_is_as_if_it_were_written_as_zero(mesh):
    sides = {"contact": ["bottom", "left"], "dirichlet": "top"}
    written = signorini.problem(mesh, "P1", f=1, obstacle={"bottom": "-x", "left": 0}, **sides)
    left_out = signorini.problem(mesh, "P1", f=1, obstacle={"bottom": "-x"}, **sides)
    assert np.array_equal(written.lower, left_out.lower)
    for obstacle in ({"bottom": 1}, {"bottom": 1, "left": 0}):
        assert "let the values of both meet there" in told(mesh, obstacle=obstacle, **sides)


@pytest.mark.parametrize("datum", ["obstacle", "contact_flux", "g", "dirichlet"])
def test_a_scene_has_no_data_by_part(datum):
    """So that no part of them can be misspelt."""
    document = {
        "domain": {"kind": "rectangle"},
        "boundary": dict(zip(NAMES, LABELS, strict=True)),
        "data": {"f": 1, datum: {"bottom": 1}},
        "levels": [4],
    }
    with pytest.raises(SceneError, match=rf"data\.{datum}: "):
        signorini.Scene.from_dict(document)


def test_sides_that_have_names_are_not_listed_by_number_as_well():
    """Their numbers are names, too, that a condition may use."""
    with pytest.raises(SceneError) as caught:
        signorini.problem(POLYGON, f=-1, contact="nowhere", dirichlet=NAMES[0])
    assert str(caught.value).endswith(f"known: {', '.join(NAMES)}")
    assert signorini.problem(POLYGON, f=-1, contact="side-1", dirichlet="side-0").contact.any()


@pytest.mark.parametrize(("field", "other"), [("contact", "obstacle"), ("neumann", "g")])
@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_values_are_not_dropped_where_names_are_asked_for(mesh, field, other):
    message = told(mesh, dirichlet={"top": 0}, **{field: {"bottom": -0.5}})
    wanted = f"has values, which it does not take; give names here, and the values in {other}"
    assert message == f"{field}: {{'bottom': -0.5}} (dict) {wanted}"


def test_a_mesh_is_shown_with_the_names_that_a_user_gave():
    assert repr(POLYGON).endswith(f"; boundaries: {', '.join(NAMES)}>")
    disc = skfem.MeshTri.init_circle(2)
    assert repr(signorini.triangulation((disc.p, disc.t))).endswith("; boundaries: none named>")
