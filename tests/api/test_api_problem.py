"""Problems of a program: those of the scene that says the same, on any mesh; or one line."""

import meshio
import numpy as np
import pytest
import skfem

import signorini
from signorini.exceptions import SignoriniError
from signorini.mesh.grid import Grid

F = "6*sin(5*x + 2*y) - 2"
SQUARE = skfem.MeshTri().refined(2)
CONDITIONS = {"dirichlet": {"top": "0.1*x"}, "contact": "bottom", "g": {"left": "cos(3*y)"}}


def as_meshio(mesh):
    """A mesh of scikit-fem as one of meshio, its four sides as cell sets."""
    facets = mesh.boundary_facets()
    x, y = mesh.p[:, mesh.facets[:, facets]].mean(axis=1)
    sides = {"bottom": y == 0, "right": x == 1, "top": y == 1, "left": x == 0}
    return meshio.Mesh(
        mesh.p.T,
        [("triangle", mesh.t.T), ("line", mesh.facets[:, facets].T)],
        cell_sets={name: [None, np.flatnonzero(on)] for name, on in sides.items()},
    )


MESHES = {
    "scikit-fem": SQUARE,
    "arrays": (SQUARE.p, SQUARE.t),
    "meshio": as_meshio(SQUARE),
}


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_scene_and_a_program_that_say_the_same_have_the_same_problem(element):
    document = {
        "domain": {"kind": "rectangle", "size": [2, 1]},
        "boundary": {
            "bottom": "contact",
            "right": "neumann",
            "top": "dirichlet",
            "left": "neumann",
        },
        "data": {
            "f": F,
            "g": "x + y",
            "dirichlet": "0.1*x",
            "obstacle": "-x",
            "coefficient": "1+x",
        },
        "levels": [4],
    }
    theirs = signorini.Scene.from_dict(document).problem(element, 4)
    ours = signorini.problem(
        signorini.rectangle(4, size=(2, 1)),
        element,
        f=F,
        g="x + y",
        obstacle="-x",
        coefficient="1 + x",
        dirichlet={"top": "0.1*x"},
        contact="bottom",
    )
    assert ours.mesh == theirs.mesh
    for name in ("b", "contact", "lower", "fixed", "fixed_values", "coefficient", "n", "h"):
        assert np.array_equal(getattr(ours, name), getattr(theirs, name)), name


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_mesh_is_the_same_whichever_library_it_comes_from(mesh, element):
    solution = signorini.solve(signorini.problem(mesh, element, f=F, **CONDITIONS))
    theirs = signorini.solve(signorini.problem(SQUARE, element, f=F, **CONDITIONS))
    np.testing.assert_allclose(solution.u, theirs.u, atol=1e-12)
    assert 0 < solution.active.sum() < solution.active.size


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_a_mesh_of_scikit_fem_gives_the_solution_of_the_grid_of_the_same_triangles(element):
    grid = signorini.solve(signorini.problem(signorini.rectangle(4), element, f=F, **CONDITIONS))
    flat = skfem.MeshTri(grid.problem.mesh.p, grid.problem.mesh.t)
    mesh = signorini.solve(signorini.problem(flat, element, f=F, **CONDITIONS))
    np.testing.assert_allclose(mesh.u, grid.u, atol=1e-12)


def test_an_own_mesh_of_the_library_keeps_its_labels():
    labels = ("contact", "neumann", "dirichlet", "neumann")
    grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    ours = signorini.problem(grid, "P1", f=F, dirichlet="0.1*x")
    asked = {"dirichlet": {"top": "0.1*x"}, "contact": "bottom"}
    theirs = signorini.problem(signorini.rectangle(4), "P1", f=F, **asked)
    assert np.array_equal(ours.b, theirs.b)
    assert np.array_equal(ours.fixed_values, theirs.fixed_values)


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("refined", ["by scikit-fem", "by us"])
def test_a_refined_mesh_of_scikit_fem_is_solved_by_multigrid(element, refined):
    coarse = skfem.MeshTri.init_lshaped()
    meshes = {
        "by us": signorini.triangulation(coarse).refined(5),
        "by scikit-fem": coarse.refined(5),
    }
    asked = {"f": -1, "dirichlet": "top", "contact": "bottom"}
    problem = signorini.problem(meshes[refined], element, **asked)
    solution = signorini.solve(problem, "multigrid")
    assert problem.n == 32
    assert problem.mesh.coarser().coarser().number_of_triangles == 6 * 4**3
    assert solution.status == "solved"
    np.testing.assert_allclose(solution.u, signorini.solve(problem, "direct").u, atol=1e-10)


def test_many_unknowns_on_a_refined_mesh_take_multigrid_by_themselves():
    mesh = skfem.MeshTri.init_sqsymmetric().refined(5)
    problem = signorini.problem(mesh, "CR", f=-1, dirichlet="top", contact="bottom")
    assert problem.b.size < 20_000
    problem = signorini.problem(mesh.refined(1), "CR", f=-1, dirichlet="top", contact="bottom")
    assert signorini.solve(problem).method == "multigrid"


@pytest.mark.parametrize("diagonal", ["alternating", "criss-cross"])
def test_a_rectangle_of_another_pattern_is_refined_into_nested_levels(diagonal):
    mesh = signorini.rectangle(4, diagonal=diagonal)
    fine = signorini.problem(mesh.refined(), "P1", f=F, **CONDITIONS)
    assert (fine.n, fine.h) == (8, 0.125)
    assert fine.mesh.coarser().number_of_triangles == mesh.number_of_triangles
    assert signorini.solve(fine).status == "solved"


def test_two_materials_by_subdomain_and_by_function_are_the_same():
    mesh = signorini.triangulation(
        SQUARE, subdomains={"soft": lambda x, y: x < 0.5, "hard": lambda x, y: x > 0.5}
    ).refined()
    by_name = signorini.problem(mesh, f=F, coefficient={"soft": 1, "hard": 9}, **CONDITIONS)
    by_function = signorini.problem(
        mesh, f=F, coefficient=lambda x, y: np.where(x < 0.5, 1, 9), **CONDITIONS
    )
    assert np.array_equal(by_name.coefficient, by_function.coefficient)
    assert set(by_name.coefficient) == {1.0, 9.0}


def test_a_polygon_has_its_sides_and_nested_levels():
    mesh = signorini.polygon([(0, 0), (2, 0), (0, 1)], 2, ["floor", "slope", "wall"])
    fine = signorini.problem(mesh.refined(2), f=-1, dirichlet="wall", contact="floor")
    assert fine.n == 8
    assert fine.mesh.coarser().coarser().number_of_triangles == mesh.number_of_triangles
    assert np.all(fine.contact_points[1] == 0.0)
    assert mesh.to_skfem().boundaries.keys() >= {"floor", "slope", "wall"}


@pytest.mark.parametrize("made", ["by us", "by scikit-fem"])
def test_a_disc_that_follows_its_circle_converges(made):
    """Without the curve the polygon of the first level would stay, and with it its error."""
    rim, circle = ["rim"], {"rim": {"center": (0, 0), "radius": 1}}
    angles = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    if made == "by us":
        corners = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        disc = signorini.polygon(corners, 4, rim * 12, boundary_shape=circle)
    else:
        disc = signorini.triangulation(
            skfem.MeshTri.init_circle(2), {"rim": lambda x, y: x + y < 9}, boundary_shape=circle
        )
    errors = []
    for times in (0, 1, 2):
        problem = signorini.problem(disc.refined(times), exact="1 - x*x - y*y", dirichlet="rim")
        errors.append(signorini.solve(problem).errors("1 - x*x - y*y", ["l2"])["l2"])
        assert np.allclose(
            np.hypot(*problem.mesh.points(problem.mesh.boundary_vertices("dirichlet"))), 1
        )
    assert errors[0] > 3.5 * errors[1] > 3.5**2 * errors[2]


def test_data_are_derived_from_an_exact_solution():
    sides = ["right", "top", "left"]
    mesh = signorini.rectangle(8)
    ours = signorini.problem(mesh, "P1", exact="smooth", dirichlet=sides, contact="bottom")
    document = {
        "domain": {"kind": "rectangle"},
        "boundary": dict.fromkeys(sides, "dirichlet") | {"bottom": "contact"},
        "levels": [4, 8],
        "truth": {"kind": "exact", "family": "smooth"},
    }
    theirs = signorini.Scene.from_dict(document).problem("P1", 8)
    assert np.array_equal(ours.b, theirs.b)
    assert np.array_equal(ours.fixed_values, theirs.fixed_values)


def test_functions_as_an_exact_solution_are_checked_against_the_data():
    exact = (lambda x, y: x * x, lambda x, y: (2 * x, 0 * y))
    sides = {"dirichlet": ["bottom", "right", "top", "left"]}
    problem = signorini.problem(signorini.rectangle(4), "P1", f=-2, exact=exact, **sides)
    assert np.ptp(problem.fixed_values) == 1.0
    with pytest.raises(SignoriniError, match=r"f: -3 at .* where differences of the flux give -2"):
        signorini.problem(signorini.rectangle(4), "P1", f=-3, exact=exact, **sides)
    with pytest.raises(SignoriniError, match="f: missing; the load of functions"):
        signorini.problem(signorini.rectangle(4), "P1", exact=exact, **sides)


def test_a_threshold_of_the_flux_and_a_bound_from_above_mirror_each_other():
    mesh = signorini.rectangle(8)
    asked = {"contact": "bottom", "dirichlet": {"top": 0}}
    lower = signorini.problem(mesh, f=F, obstacle=-0.1, contact_flux=0.2, **asked)
    mirrored = {"f": f"-({F})", "obstacle": 0.1, "contact_flux": -0.2, "constraint": "upper"}
    upper = signorini.problem(mesh, **mirrored, **asked)
    ours, theirs = signorini.solve(lower), signorini.solve(upper)
    np.testing.assert_allclose(ours.u, -theirs.u, atol=1e-13)
    assert ours.resultant == pytest.approx(-theirs.resultant, abs=1e-12)


MESH = signorini.rectangle(4)
GASKET = "config/meshes/gasket.msh"


def asked(mesh=MESH, *arguments, **changes):
    return signorini.problem(mesh, *arguments, **({"f": 1, "dirichlet": {"top": 0}} | changes))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: asked(42), "mesh: 42 (int) is no mesh; give signorini.rectangle"),
        (lambda: asked(skfem.MeshQuad()), "mesh: the cells of a MeshQuad1 are no triangles"),
        (lambda: asked((SQUARE.p.T, SQUARE.t)), "(2, nv)"),
        (lambda: asked((SQUARE.p, SQUARE.t.T)), "(3, nt)"),
        (lambda: asked((SQUARE.p[:, :-1], SQUARE.t)), "out of range"),
        (lambda: asked(([[0, 1, 0, 2], [0, 0, 1, 2]], [[0, 0], [1, 1], [2, 3]])), "overlap"),
        (lambda: asked("absent.msh"), "absent.msh: cannot read the mesh file"),
        (lambda: asked(MESH, "Q1"), "element: unknown element 'Q1'; known: P1, CR"),
        (lambda: asked(MESH, ["CR"]), "element: unknown element ['CR']"),
        (lambda: asked(f=None), "f: missing; give the volume force"),
        (lambda: asked(f=1j), "f: 1j is not real"),
        (lambda: asked(f=float("nan")), "f: number nan out of range"),
        (lambda: asked(f=np.ones(3)), "f: an array of shape (3,) and type float64 is no datum"),
        (lambda: asked(f=True), "f: True (bool) is no datum"),
        (lambda: asked(f=lambda x, y: 1j * x), "f: <lambda>(x, y) is of type complex128"),
        (lambda: asked(f=lambda x, y: 1 / (y - 0.5)), "f: <lambda>(x, y) is inf at (x, y) = "),
        (lambda: asked(f=lambda x, y: x[:2]), "f: <lambda>(x, y) has shape (2,)"),
        (lambda: asked(g={"left": "1/x"}), "g.left: value is inf"),
        (lambda: asked(g={"lift": 1}), "g: the boundary has no part 'lift'; did you mean left?"),
        (lambda: asked(g={"top": 1}), "g: 'top' is in dirichlet, too"),
        (lambda: asked(dirichlet={"top": None}), "dirichlet.top: None (NoneType) is no datum"),
        (lambda: asked(dirichlet=0), "dirichlet: 0 (int) names no part of the boundary"),
        (lambda: asked(dirichlet={"topp": 0}), "no part 'topp'; did you mean top? known: bottom"),
        (lambda: asked(dirichlet={"top": 0, "left": 1}), "dirichlet.left: 1 at (0, 1)"),
        (lambda: asked(contact="botom"), "contact: the boundary has no part 'botom'"),
        (lambda: asked(contact=["bottom", 3]), "contact: ['bottom', 3] (list) names no part"),
        (lambda: asked(contact="top"), "contact: 'top' is in dirichlet, too"),
        (lambda: asked(contact="left", obstacle=1), "obstacle 1 lies above dirichlet 0"),
        (lambda: asked(neumann="left", contact="bottom"), "neumann: the side right has no"),
        (lambda: asked(SQUARE, neumann="left"), "facets of mesh have no label"),
        (lambda: asked(coefficient=0), "coefficient: 0 is not valid; it must be from 1e-100"),
        (lambda: asked(coefficient={"a": 1}), "coefficient.a: the mesh has no such subdomain"),
        (lambda: asked(coefficient={"a": "1"}), "coefficient.a: '1' (str) is no number"),
        (lambda: asked(coefficient={"a": -1}), "coefficient.a: -1.0 is not valid"),
        (lambda: asked(load_quadrature="gauss"), "load_quadrature: 'gauss' (str) is not valid"),
        (lambda: asked(load_quadrature=0), "load_quadrature: 0 (int) is not valid"),
        (lambda: asked(load_precision="half"), "load_precision: 'half' (str) is not valid"),
        (lambda: asked(constraint="both"), "constraint: 'both' (str) is not valid; known: lower"),
        (lambda: asked(exact="punchy"), "'punchy' is neither a formula nor a family; did you mean"),
        (lambda: asked(exact=3), "exact: 3 (int) is no exact solution"),
        (lambda: asked(exact=lambda x, y: x), "exact.gradient: missing"),
        (lambda: asked(exact="x"), "data.f: 1 at"),
        (lambda: asked(GASKET, dirichlet={"clamp": 0}), "no part 'clamp'; did you mean clamped?"),
        (lambda: signorini.rectangle(0), "n: 0 (int) is not valid; n is 1/h"),
        (lambda: signorini.rectangle(4, size=(0, 1)), "rectangle: domain.size: 0 is not valid"),
        (lambda: signorini.rectangle(4, diagonal="up"), 'rectangle: domain.diagonal: "up"'),
        (lambda: signorini.rectangle(2, size=(0.3, 1)), "cuts the x side into 0.6 cells"),
        (lambda: signorini.polygon([(0, 0), (1, 0)], 4), "polygon: domain.corners"),
        (lambda: signorini.polygon([(0, 0), (1, 1), (1, 0), (0, 1)], 4), "cross"),
        (
            lambda: signorini.triangulation(SQUARE, boundary_shape={"rim": "x"}),
            "domain.boundary_shape.rim: mesh has no such part; did you mean right?",
        ),
        (
            lambda: signorini.triangulation(SQUARE, boundary_shape={"top": 3}),
            "boundary_shape.top: 3 (int) is no curve; give a formula",
        ),
        (lambda: MESH.refined(-1), "times: -1 (int) is not valid"),
        (
            lambda: signorini.triangulation(SQUARE).level(3),
            "3 is not 1 times a power of two; for instance 2 or 4",
        ),
        (
            lambda: signorini.Problem("P1", SQUARE, *[np.zeros(1)] * 5),
            "mesh: a MeshTri1 has no labelled boundary; let signorini.problem",
        ),
    ],
)
def test_what_is_wrong_is_told_in_one_line(make, words):
    with pytest.raises(SignoriniError) as caught:
        make()
    assert "\n" not in str(caught.value)
    assert words in str(caught.value)
