"""A solution that is held against another: of the same problem, and fine enough, or it is told."""

import warnings
from dataclasses import replace

import pytest

import signorini
from signorini.api.same_problem import check_same_problem
from signorini.exceptions import SignoriniError
from signorini.formula import Formula

CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]
NAMES = ["bottom", "right", "top", "left"]
SIDES = {"dirichlet": {"top": 0}, "contact": ["bottom"]}
MESHES = {
    "rectangle": signorini.rectangle(4),
    "polygon": signorini.polygon(CORNERS, 4, sides=NAMES),
}


def solved(mesh, element="P1", **given):
    return signorini.solve(signorini.problem(mesh, element, **{"f": "1 + x", **SIDES, **given}))


OTHERS = {
    "f": ({"f": -9}, "truth: its f is another, -9 where the solution has 1."),
    "g": ({"g": {"left": "y"}}, "truth: its g is another, "),
    "dirichlet": ({"dirichlet": {"top": "x"}}, "truth: its dirichlet is another, "),
    "obstacle": (
        {"obstacle": -0.01},
        "truth: its obstacle is another, -0.01 where the solution has",
    ),
    "threshold": ({"contact_flux": 1}, "truth: its contact_flux is another, 1 where the solution"),
    "coefficient": ({"coefficient": "1 + y"}, "truth: its coefficient is another, "),
    "constraint": ({"constraint": "upper"}, "truth: its constraint is on the other side"),
    "contact": ({"contact": ["bottom", "left"]}, "truth: its contact part is another than that"),
    "held": ({"dirichlet": {"top": 0, "left": 0}}, "truth: its dirichlet part is another than"),
}


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
@pytest.mark.parametrize("changed", OTHERS)
def test_a_reference_of_another_problem_is_refused(mesh, changed):
    change, words = OTHERS[changed]
    reference = solved(mesh.refined(2), **change)
    with pytest.raises(SignoriniError) as refused:
        solved(mesh, g={"left": 0}).errors(reference)
    assert str(refused.value).startswith(words)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
@pytest.mark.parametrize(
    "said",
    [
        {"f": "x + 1"},
        {"f": lambda x, y: 1 + x},
        {"g": {"left": 0, "right": "0*y"}},
        {"dirichlet": "top"},
        {"obstacle": {"bottom": "y"}},  # which is 0 there
        {"coefficient": "2/2"},
        {"load_quadrature": "centroid"},
    ],
    ids=["formula", "function", "parts", "side", "obstacle", "coefficient", "quadrature"],
)
def test_a_problem_that_is_said_otherwise_is_the_same(mesh, said):
    found = solved(mesh).errors(solved(mesh.refined(2), **said), ["l2"])["l2"]
    wanted = solved(mesh).errors(solved(mesh.refined(2)), ["l2"])["l2"]
    assert found == pytest.approx(wanted, rel=0.05)


def test_numbers_of_subdomains_are_compared():
    halves = {"low": lambda x, y: y < 0.5, "high": lambda x, y: y > 0.5}
    mesh = signorini.triangulation(MESHES["rectangle"].to_skfem(), subdomains=halves)
    own = solved(mesh, coefficient={"low": 1, "high": 2})
    with pytest.raises(SignoriniError, match=r"its coefficient\.high is another, 3 where the sol"):
        own.errors(solved(mesh.refined(2), coefficient={"low": 1, "high": 3}))
    assert own.errors(solved(mesh.refined(2), coefficient={"low": 1, "high": 2}))["l2"] > 0.0


def test_a_pole_of_a_datum_where_nothing_is_evaluated_is_no_difference():
    """At a midpoint of the coarse mesh, which is none of the points that P1 takes."""
    mesh, obstacle = MESHES["rectangle"], "-1 - 1e-9/(x - 1/8)**2"
    own, fine = solved(mesh), solved(mesh.refined(2))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        peaked = replace(own.problem.data, obstacle=Formula(obstacle, "obstacle"))
        check_same_problem(replace(fine.problem, data=peaked), replace(own.problem, data=peaked))


def test_a_problem_by_hand_has_no_data_that_could_be_compared():
    problem = solved(MESHES["rectangle"]).problem
    bare = signorini.solve(replace(problem, data=None))
    assert bare.errors(solved(MESHES["rectangle"].refined(2), f=-9))["l2"] > 0.0


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_reference_that_is_the_coarser_one_is_to_be_exchanged(mesh):
    with pytest.raises(
        SignoriniError, match=r"do not nest in the reference's .*: exchange the two"
    ):
        solved(mesh.refined()).errors(solved(mesh))


def test_meshes_that_do_not_nest_are_told_as_such():
    with pytest.raises(SignoriniError, match="n must be a power of two times n"):
        solved(signorini.rectangle(4)).errors(solved(signorini.rectangle(12)))


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_reference_is_warned_of_where_it_is_not_four_times_as_fine(mesh):
    with pytest.warns(UserWarning, match="only 2 times as fine as the finest level") as caught:
        solved(mesh).errors(solved(mesh.refined()))
    assert [each.filename for each in caught] == [__file__]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        solved(mesh).errors(solved(mesh.refined(2)))


def test_the_same_mesh_by_another_quadrature_is_neither_the_reference_nor_warned_of():
    mesh = signorini.rectangle(4)
    rough, exact = (solved(mesh, f="x**5", load_quadrature=rule) for rule in ("centroid", "exact"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = rough.errors(exact)
    assert found["l2"] > 0.0
    assert found["floor"] == ""


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_reference_itself_solved_once_more_has_no_error_and_no_slope(element):
    """As in a scene; the other element on its mesh has both."""

    def problem(n):
        mesh = signorini.rectangle(n)
        return [signorini.problem(mesh, name, f="1 + x", **SIDES) for name in ("P1", "CR")]

    truth = signorini.solve(problem(16)[("P1", "CR").index(element)])
    with pytest.warns(UserWarning, match=f"there {element} is the reference itself") as caught:
        frame = signorini.convergence(problem, [4, 8, 16], truth, ["l2"])
    assert [each.filename for each in caught] == [__file__]
    own = frame[frame["element"] == element]
    assert own["floor"].tolist() == ["", "", "reference"]
    slopes = signorini.rates(frame)
    assert (slopes["slope"].isna() == (slopes["element"] == element)).all()


def test_the_warning_is_that_of_the_scene_that_says_the_same():
    scene = signorini.Scene.from_dict(
        {
            "domain": {"kind": "rectangle"},
            "boundary": dict(
                zip(NAMES, ("contact", "neumann", "dirichlet", "neumann"), strict=True)
            ),
            "data": {"f": "1 + x"},
            "elements": ["P1"],
            "levels": [4, 8],
            "truth": {"kind": "reference", "element": "CR", "n": 16},
        }
    )
    truth = solved(signorini.rectangle(16), "CR")
    with pytest.warns(UserWarning, match="truth: the reference, n = 16, is only 2") as caught:
        signorini.convergence(lambda n: solved(signorini.rectangle(n)).problem, [4, 8], truth)
    told = [str(each.message) for each in caught]
    assert told == [f"truth: {scene.reference_note}"]
