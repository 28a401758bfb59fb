"""The diffusion coefficient: by formula, and by the subdomains of a mesh file."""

import numpy as np
import pytest

from builders import grid, statement
from signorini.exceptions import FormulaError, MeshError, SceneError, SignoriniError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import read_coefficient
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.boundary import SIDES
from signorini.mesh.domain import make_domain, read_domain, write_domain
from signorini.mesh.patterns import alternating
from signorini.scene.read import load_scene
from signorini.solvers import solve

meshio = pytest.importorskip("meshio")

LEFT, RIGHT = 2.0, 8.0
LABELS = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
SCENE = """
domain: {kind: mesh, file: plates.msh}
boundary: {bottom: contact, right: neumann, top: dirichlet, left: neumann}
data: {f: 3*sin(5*x) - 1, coefficient: %s}
levels: [1, 2, 4]
"""


@pytest.fixture
def plates(tmp_path):
    """A Gmsh file of the square (0, 2) x (0, 2) in two plates that meet at x = 1."""
    mesh = alternating(4, 4, (0, 0), (2, 2))
    x = mesh.p[0, mesh.t].mean(axis=0)
    tags = {
        "bottom": (1, 1),
        "right": (2, 1),
        "top": (3, 1),
        "left": (4, 1),
        "soft": (5, 2),
        "hard": (6, 2),
    }
    lines = np.concatenate([mesh.parts[side] for side in SIDES], axis=1).T
    sides = np.repeat(
        [tags[side][0] for side in SIDES], [mesh.parts[side].shape[1] for side in SIDES]
    )
    groups = [sides, np.where(x < 1, 5, 6)]
    written = meshio.Mesh(
        np.pad(mesh.p.T, [(0, 0), (0, 1)]),
        [("line", lines), ("triangle", mesh.t.T)],
        cell_data={"gmsh:physical": groups, "gmsh:geometrical": groups},
        field_data={name: np.array(tag) for name, tag in tags.items()},
    )
    meshio.gmsh.write(tmp_path / "plates.msh", written, "2.2", binary=False)
    return tmp_path / "plates.msh"


def scene(plates, coefficient):
    path = plates.with_name("plates.yaml")
    path.write_text(SCENE % coefficient)
    return load_scene(path)


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("n", [1, 2, 4])
def test_children_have_the_coefficient_of_their_parents_group(plates, element, n):
    """So that it is what a formula says whose jump the mesh follows, and so is the solution."""
    named = discretize(scene(plates, f"{{soft: {LEFT}, hard: {RIGHT}}}"), element, n)
    formula = discretize(scene(plates, f"'where(x < 1, {LEFT}, {RIGHT})'"), element, n)
    assert named.mesh.number_of_triangles == 32 * n**2
    np.testing.assert_array_equal(named.coefficient, formula.coefficient)
    np.testing.assert_array_equal(solve(named).u, solve(formula).u)


def test_subdomains_survive_storage(plates, tmp_path):
    made = make_domain({"kind": "mesh", "file": str(plates)}, LABELS, 1)
    write_domain(tmp_path / "domain.npz", made)
    coefficient = read_coefficient({"soft": LEFT, "hard": RIGHT})
    read = read_domain(tmp_path / "domain.npz")
    for n in (1, 2):
        np.testing.assert_array_equal(
            coefficient_on(read.level(n), coefficient), coefficient_on(made.level(n), coefficient)
        )


def test_groups_may_go_by_their_numbers(plates):
    found = discretize(scene(plates, '{"5": 2, hard: 8}'), "P1", 1).coefficient
    np.testing.assert_array_equal(
        found, discretize(scene(plates, "{soft: 2, hard: 8}"), "P1", 1).coefficient
    )


def test_one_in_every_subdomain_is_no_coefficient(plates):
    assert discretize(scene(plates, "{soft: 1, hard: 1.0}"), "P1", 1).coefficient is None


REFUSED = {
    "group missing": (
        "{soft: 2}",
        MeshError,
        r"triangle \d+ at \(.*\) has no coefficient; add a number for hard or 6",
    ),
    "group unknown": (
        "{soft: 2, hrad: 8}",
        MeshError,
        r"coefficient.hrad: .*; did you mean hard\? known: soft, 5, hard",
    ),
    "group of lines": (
        "{soft: 2, bottom: 8}",
        MeshError,
        r"coefficient.bottom: the mesh has no such subdomain",
    ),
    "two groups": (
        "{soft: 2, hard: 8, '6': 8}",
        MeshError,
        r"triangle \d+ at \(.*\) is in hard and 6 at once; name one",
    ),
    "empty": ("{}", MeshError, r"has no coefficient; add a number for soft or 5"),
    "zero": (
        "{soft: 2, hard: 0}",
        SceneError,
        r"data.coefficient.hard: 0 is not valid; it must be from 1e-100 to 1e",
    ),
    "negative": (
        "{soft: -2.5, hard: 1}",
        SceneError,
        r"data.coefficient.soft: -2.5 is not valid; it must be from 1e-100 to 1e",
    ),
    "text": (
        "{soft: 2*x, hard: 1}",
        SceneError,
        r'data.coefficient.soft: "2\*x" is not valid; expected a number',
    ),
    "list": (
        "[1, 2]",
        SceneError,
        r"data.coefficient: \[1, 2\] is not valid; expected a number or text or a section",
    ),
    "number": (
        "-1",
        FormulaError,
        "data.coefficient: -1 is not valid; it must be from 1e-100 to 1e",
    ),
    "formula": (
        "x - 1",
        FormulaError,
        r"data.coefficient: x - 1 is -.* at \(.*\); it must be from 1e-100 to 1e",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(plates, case):
    coefficient, kind, message = REFUSED[case]
    with pytest.raises(SignoriniError, match=message) as caught:
        discretize(scene(plates, coefficient), "P1", 1)
    assert type(caught.value) is kind
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "domain", ["{kind: rectangle}", "{kind: polygon, corners: [[0, 0], [1, 0], [0, 1]]}"]
)
def test_only_a_mesh_file_has_subdomains(tmp_path, domain):
    boundary = "{contact: 0.1 - y, dirichlet: rest}"
    path = tmp_path / "plain.yaml"
    path.write_text(
        f"domain: {domain}\nboundary: {boundary}\n"
        "data: {f: 1, coefficient: {soft: 2}}\nlevels: [2, 4]\n"
    )
    with pytest.raises(
        SceneError,
        match=r"data.coefficient: only a mesh file has subdomains; give a number or a form",
    ):
        load_scene(path)


def test_an_exact_truth_needs_a_formula(plates):
    path = plates.with_name("exact.yaml")
    path.write_text(
        (SCENE % "{soft: 2, hard: 8}").replace("f: 3*sin(5*x) - 1, ", "")
        + "truth: {kind: exact, u: 1 - y}\n"
    )
    with pytest.raises(
        SceneError, match=r"exact.yaml: data.coefficient: an exact truth needs a formula in x and y"
    ):
        load_scene(path)


def test_a_mesh_without_groups_says_so():
    asked = statement(f=1, coefficient={"soft": 2})
    with pytest.raises(
        MeshError, match=r"data.coefficient.soft: the mesh has no such subdomain; known: none"
    ):
        discretize_on(grid(2), "P1", asked)
