"""Whole scenes at random: whatever goes in, out comes an error that names a field, or a solution
that is one.

What a solution must satisfy is written here anew, with scikit-fem's matrix and plain NumPy.
"""

import json
import re
import time
import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.optimize import lsq_linear
from skfem import Basis, BilinearForm, ElementTriCR, ElementTriP1
from skfem.helpers import dot, grad

from scenes_at_random import LABELS, MOVES, SMOOTH, changed_mesh, scenes
from signorini.exceptions import MeshError, SignoriniError
from signorini.fem.mirror import mirrored
from signorini.fem.problem import discretize
from signorini.mesh import imported
from signorini.mesh.grid import Grid
from signorini.mesh.imported import import_mesh
from signorini.mesh.parse import parse
from signorini.mesh.patterns import alternating
from signorini.scene.read import load_scene
from signorini.solvers import solve
from signorini.solvers.fourier import why_not

FIELDS = (
    r"\b(domain|boundary|constraint|data|levels|elements|load_quadrature|truth|norms|outputs|polygon"
    r"|solver)\b"
)
EPS, TINY = np.finfo(float).eps, np.finfo(float).tiny


@BilinearForm
def weighted(u, v, w):
    return w.k * dot(grad(u), grad(v))


def stiffness(problem):
    """The matrix, dense; that of a grid near the origin, elsewhere its coordinates are rounded."""
    mesh = problem.mesh.skfem
    if isinstance(problem.mesh, Grid):
        mesh = replace(problem.mesh, origin=(0.0, 0.0)).skfem
    basis = Basis(mesh, {"P1": ElementTriP1, "CR": ElementTriCR}[problem.element](), intorder=1)
    k = np.ones(mesh.nelements) if problem.coefficient is None else problem.coefficient
    return weighted.assemble(basis, k=k[:, None]).toarray()


def largest(*arrays):
    return max(float(np.max(np.abs(values), initial=0.0)) for values in arrays)


def check_kkt(problem, A, b, u, multiplier, lower, fixed_values, tolerance):
    """Each condition relative to the terms it is the sum of; u is in units of its largest value."""
    terms = np.abs(A) @ np.abs(u) + np.abs(b) + A.diagonal() * largest(u, lower, fixed_values)
    force = np.divide(A @ u - b, terms, out=np.zeros_like(b), where=terms > 0)
    size = largest(u, lower, fixed_values) or 1.0
    gap, pressure = (u[problem.contact] - lower) / size, force[problem.contact]
    inside = np.ones(b.size, dtype=bool)
    inside[problem.contact] = inside[problem.fixed] = False
    assert largest(force[inside]) <= tolerance, "equilibrium"
    assert largest(u[problem.fixed] - fixed_values) < TINY, "Dirichlet values"
    assert np.min(gap, initial=0) >= -tolerance, "no penetration"
    assert np.min(pressure, initial=0) >= -tolerance, "the force presses"
    assert largest(np.minimum(gap, pressure)) <= tolerance, "complementarity"
    given_force = np.divide(
        multiplier, terms[problem.contact], out=np.zeros_like(multiplier), where=multiplier > 0
    )
    np.testing.assert_allclose(given_force, pressure, rtol=0, atol=2 * tolerance)


def by_least_squares(problem, A, b, lower, fixed_values):
    """The solution by SciPy's BVLS on the Schur complement; it needs a Dirichlet part."""
    c, u = problem.contact, np.zeros(b.size)
    u[problem.fixed], u[c] = fixed_values, lower
    i = np.setdiff1d(problem.free, c)
    inverse = np.linalg.inv(A[np.ix_(i, i)])
    S = A[np.ix_(c, c)] - A[np.ix_(c, i)] @ inverse @ A[np.ix_(i, c)]
    load = b - A @ u
    q = load[c] - A[np.ix_(c, i)] @ inverse @ load[i]
    d = np.sqrt(S.diagonal())
    R = np.linalg.cholesky(S / np.outer(d, d)).T
    if c.size:
        size = largest(q / d) or 1.0
        found = lsq_linear(
            R, np.linalg.solve(R.T, q / d / size), (0, np.inf), "bvls", tol=1e-15, max_iter=1000
        )
        u[c] = lower + size * found.x / d
    u[i] = inverse @ (load[i] - A[np.ix_(i, c)] @ (u[c] - lower))
    return u


def check_solution(problem):
    """Solve by every route that applies; check the conditions, the routes against each other, and
    BVLS. A constraint from above is checked in the mirror.
    """
    if problem.upper:
        image = mirrored(problem)
        np.testing.assert_array_equal(solve(problem).u, -solve(image).u)
        problem = image
    routes = ["auto", "direct", *["fourier"] * (why_not(problem) is None)]
    solutions = [solve(problem, route) for route in routes]
    found, A = solutions[0], stiffness(problem)
    if 0 < largest(problem.b, problem.lower, problem.fixed_values) < SUBNORMAL:
        return  # solved, and a warning says what it is worth
    # Powers of two bring u and the force to order one, so that no sum below over- or underflows.
    length = int(np.frexp(largest(found.u, problem.lower, problem.fixed_values))[1])
    A_exponent = int(np.frexp(largest(A))[1])
    if int(np.frexp(largest(problem.b))[1]) - A_exponent - length > 900:
        return  # solved; no power of two brings both u and a load 1e270 times it to order one
    A, b = np.ldexp(A, -A_exponent), np.ldexp(problem.b, -length - A_exponent)
    lower, fixed_values = np.ldexp(problem.lower, -length), np.ldexp(problem.fixed_values, -length)
    for solution in solutions:
        assert solution.status in ("solved", "inaccurate")
        u, multiplier = (
            np.ldexp(solution.u, -length),
            np.ldexp(solution.multiplier, -length - A_exponent),
        )
        assert np.isfinite(u).all()
        tolerance = 1e-10 if solution.residual <= 1e-10 else 1e-6
        check_kkt(problem, A, b, u, multiplier, lower, fixed_values, tolerance)
        assert np.all(multiplier[~solution.active] == 0)
        assert largest(u[problem.contact[solution.active]] - lower[solution.active]) < TINY
        if solution.status == found.status == "solved":
            np.testing.assert_allclose(u, np.ldexp(found.u, -length), rtol=0, atol=1e-10)
    condition = (
        np.linalg.cond(A[np.ix_(problem.free, problem.free)])
        if problem.fixed.size * problem.free.size
        else np.inf
    )
    if condition < 1e12:
        expected = by_least_squares(problem, A, b, lower, fixed_values)
        size = largest(expected, lower, fixed_values)
        np.testing.assert_allclose(
            np.ldexp(found.u, -length), expected, rtol=0, atol=100 * condition * EPS * size
        )


SUBNORMAL = 2.0**-1000  # data below have lost digits, or their products do


def attempt(folder, document, element):
    """What became of a scene: "solved", or the message of the error."""
    path = folder / "mine.yaml"
    path.write_text(json.dumps(document))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings(
            "ignore", ".*(data as small as|vertices belong to no triangle)", UserWarning
        )
        try:
            scene = load_scene(path)
            problem = discretize(scene, element, scene.levels[0])
            check_solution(problem)
        except SignoriniError as error:
            return str(error).removeprefix(f"{path}: ")
    return "solved"


def check_message(message, names):
    if message != "solved":
        assert message.isprintable()
        assert len(message) < 600
        assert re.search(names, message), message


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("scenes")


@given(document=scenes(), element=st.sampled_from(["P1", "CR"]))
@settings(
    max_examples=120, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
def test_a_scene_is_solved_or_refused_by_the_name_of_a_field(folder, document, element):
    message = attempt(folder, document, element)
    check_message(message, FIELDS)


SQUARE = alternating(3, 3, (0, 0), (3, 3))
NUMBERS = {"bottom": 1, "right": 2, "top": 3, "left": 4, "inner": 5}


def gmsh(p, t, bottom):
    """A Gmsh file: the sides of the square as physical groups, its bottom perhaps without the first
    facet.
    """
    ends = [(NUMBERS[side], a + 1, b + 1) for side in SQUARE.parts for a, b in SQUARE.parts[side].T]
    lines = [f"1 2 {tag} {tag} {a} {b}" for tag, a, b in ends[0 if bottom else 1 :]]
    cells = lines + [f"2 2 5 1 {a + 1} {b + 1} {c + 1}" for a, b, c in t]
    return "\n".join([
        "$MeshFormat", "2.2 0 8", "$EndMeshFormat",
        "$PhysicalNames", "5",
        *(f'{1 + (tag == 5)} {tag} "{name}"' for name, tag in NUMBERS.items()),
        "$EndPhysicalNames",
        "$Nodes", str(len(p)),
        *(f"{k + 1} {x!r} {y!r} 0" for k, (x, y) in enumerate(p)), "$EndNodes",
        "$Elements", str(len(cells)),
        *(f"{k + 1} {cell}" for k, cell in enumerate(cells)), "$EndElements", "",
    ])  # fmt: skip


@given(
    moves=st.lists(MOVES, max_size=1),
    labels=st.lists(st.sampled_from(LABELS), min_size=4, max_size=4),
    bottom=st.integers(-9, 9),
    data=st.fixed_dictionaries({"f": SMOOTH}, optional={"obstacle": SMOOTH, "g": SMOOTH}),
    element=st.sampled_from(["P1", "CR"]),
    n=st.sampled_from([1, 2]),
)
@settings(
    max_examples=100, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck)
)
def test_a_mesh_file_is_solved_or_refused(
    folder, monkeypatch, moves, labels, bottom, data, element, n
):
    """Read in this process: less safe, but faster."""
    monkeypatch.setattr(imported, "run_in_sandbox", lambda _, path, **limits: parse(path))
    (folder / "square.msh").write_text(
        gmsh(*changed_mesh(SQUARE.p.T.tolist(), SQUARE.t.T.tolist(), moves), bottom)
    )
    document = {
        "domain": {"kind": "mesh", "file": "square.msh"},
        "boundary": dict(zip(SQUARE.parts, labels, strict=True)),
        "data": data | {"coefficient": {"inner": 2}},
        "levels": [n],
    }
    message = attempt(folder, document, element)
    check_message(message, FIELDS + "|square.msh")


@given(
    content=st.binary(max_size=300),
    ending=st.sampled_from(["msh", "vtu", "vtk", "mesh", "xdmf", "inp", "stl"]),
)
@settings(max_examples=6, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
def test_random_bytes_are_no_mesh(folder, content, ending):
    path = folder / f"random.{ending}"
    path.write_bytes(content)
    start = time.perf_counter()
    with pytest.raises(MeshError, match=rf"^random.{ending}: "):
        import_mesh(path)
    assert time.perf_counter() - start < 31
