"""A level is judged before it is made, and the message says what would do."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from builders import statement
from signorini import memory
from signorini.exceptions import MeshError
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.mesh.domain import Rectangle, Refined, make_domain
from signorini.scene.memory_check import check_level
from signorini.scene.statement import ProblemStatement

ROOT = Path(__file__).parents[2]
SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
SQUARE = {
    "kind": "rectangle",
    "origin": [0, 0],
    "size": [1, 1],
    "diagonal": "falling",
    "cells": "per-side",
}
TRIANGLE = {"kind": "polygon", "corners": [[0, 0], [1, 0], [0, 1]], "holes": []}
DOMAINS = {
    "square": (SQUARE, SIDES),
    "per-unit": (SQUARE | {"size": [2, 0.5], "cells": "per-unit"}, SIDES),
    "criss-cross": (SQUARE | {"diagonal": "criss-cross"}, SIDES),
    "alternating": (SQUARE | {"diagonal": "alternating"}, SIDES),
    "graded": (SQUARE | {"grade": {"towards": ["bottom"], "exponent": 2}}, SIDES),
    "by formula": (SQUARE, {"contact": "0.1 - y", "dirichlet": "y - 0.9", "neumann": "rest"}),
    "polygon": (TRIANGLE, {"side-0": "contact", "side-1": "neumann", "side-2": "dirichlet"}),
}


def statement_on(domain="square", **parts):
    domain, boundary = DOMAINS[domain]
    data = {"f": 1, "g": 0, "dirichlet": 0, "obstacle": 0} | parts
    mapping = {
        "domain": domain,
        "boundary": boundary,
        "data": data,
        "load_quadrature": "exact",
        "coarsest": 4,
    }
    return ProblemStatement.from_mapping(mapping)


@pytest.fixture
def small_machine(monkeypatch):
    """One with 1 MB: it holds the factors of 900 triangles for P1, 7,700 for multigrid, 33,000 of a
    grid.
    """
    monkeypatch.setattr(memory, "_memory", lambda: 1e6)


@pytest.fixture
def no_mesh(monkeypatch):
    """Where a mesh is made, the test fails."""
    monkeypatch.setattr(Rectangle, "_cut", None)
    monkeypatch.setattr(Refined, "_refined", None)


@pytest.mark.parametrize("domain", DOMAINS)
@pytest.mark.parametrize("n", [4, 8])
def test_triangles_are_counted_without_a_mesh(domain, n):
    made = make_domain(*DOMAINS[domain], 4)
    assert made.count_triangles(n) == made.level(n).number_of_triangles
    assert getattr(made, "uniform", False) == (domain in ("square", "per-unit"))


def limit(monkeypatch, refused):
    """The least memory with which `refused()` passes, bytes."""
    low, high = 0.0, 1e12
    while high - low > 1:
        middle = 0.5 * (low + high)
        monkeypatch.setattr(memory, "_memory", lambda given=middle: given)
        low, high = (low, middle) if _passes(refused) else (middle, high)
    return high


def _passes(check):
    try:
        check()
    except MeshError:
        return False
    return True


@pytest.mark.parametrize("domain", DOMAINS)
def test_a_domain_that_has_not_been_made_is_judged_nearly_alike(monkeypatch, domain):
    """Exactly where it is a rectangle; a polygon's triangles are a few more than its area tells."""
    made = make_domain(*DOMAINS[domain], 4)
    known, guessed = (
        limit(
            monkeypatch,
            lambda given=given: check_level(statement_on(domain), "CR", 64, "multigrid", given),
        )
        for given in (made, None)
    )
    if isinstance(made, Rectangle):
        assert known == pytest.approx(guessed)
    else:
        assert 1 <= known / guessed < 1.5


def test_a_hole_is_no_part_of_the_area(monkeypatch):
    """Nor does the sense of rotation matter."""
    square = [[0, 0], [2, 0], [2, 2], [0, 2]]
    plain, pierced, reversed_ = (
        replace(
            statement_on("polygon"), domain={"kind": "polygon", "corners": corners, "holes": holes}
        )
        for corners, holes in (
            (square, []),
            (square, [[[1, 1], [1, 1.5], [1.5, 1]]]),
            (square[::-1], []),
        )
    )
    limits = [
        limit(monkeypatch, lambda one=one: check_level(one, "P1", 64, "direct"))
        for one in (plain, pierced, reversed_)
    ]
    assert limits == pytest.approx(
        [2 * 64**2 * area * ELEMENT_FACTS["P1"].direct_bytes for area in (4, 3.875, 4)]
    )


def test_levels_that_fit_are_judged_without_numpy():
    """Snakemake's own process does it at the start of every build."""
    scene = "config/scenes/paper.yaml"
    code = f"""
import sys
from signorini.scene.memory_check import check_level
from signorini.scene.read import load_scene
check_level(load_scene({scene!r}).problem_statement, "CR", 512, "auto")
assert not {{"numpy", "signorini.mesh.domain", "signorini.fem.problem"}} & set(sys.modules)
"""
    subprocess.run(
        [sys.executable, "-c", code], check=True, cwd=ROOT, env=os.environ | {"PYTHONPATH": "src"}
    )


REFUSED = {
    # case: (statement, level, method, what the message says would do)
    "direct on a grid": (
        statement_on,
        32,
        "direct",
        "; set solver.method to fourier or multigrid, or choose",
    ),
    "direct on a large grid": (
        statement_on,
        100,
        "direct",
        "; set solver.method to fourier, or choose",
    ),
    "multigrid on a grid": (
        statement_on,
        100,
        "multigrid",
        "; set solver.method to fourier, or choose",
    ),
    "fourier": (statement_on, 150, "fourier", r" here; choose smaller levels"),
    "a varying coefficient": (
        lambda: statement_on(coefficient="1 + x"),
        32,
        "direct",
        "; set solver.method to multigrid, or",
    ),
    "criss-cross": (
        lambda: statement_on("criss-cross"),
        32,
        "direct",
        "; set solver.method to multigrid, or choose",
    ),
    "graded": (
        lambda: statement_on("graded"),
        32,
        "direct",
        "; set solver.method to multigrid, or choose",
    ),
    "polygon": (
        lambda: statement_on("polygon"),
        64,
        "direct",
        "; set solver.method to multigrid, or choose",
    ),
    "beyond all": (lambda: statement_on("graded"), 4096, "direct", " here; choose smaller levels"),
    "auto beyond all": (lambda: statement_on("graded"), 64, "auto", " here; choose smaller levels"),
    "auto, no grid": (lambda: statement_on("polygon"), 512, "auto", " here; choose smaller levels"),
}


@pytest.mark.usefixtures("small_machine", "no_mesh")
@pytest.mark.parametrize("case", REFUSED)
def test_case_10_what_does_not_fit_is_refused_by_name(case):
    statement_of, n, method, remedy = REFUSED[case]
    with pytest.raises(
        MeshError, match=rf"^levels: n = {n}.* triangles and needs at least .* GB .*{remedy}"
    ):
        check_level(statement_of(), "P1", n, method)


@pytest.mark.usefixtures("small_machine", "no_mesh")
@pytest.mark.parametrize("method", ["fourier", "multigrid", "direct", "auto"])
def test_what_fits_passes(method):
    for domain in DOMAINS:
        check_level(statement_on(domain), "P1", 8, method)


@pytest.mark.usefixtures("small_machine", "no_mesh")
def test_auto_takes_what_fits():
    check_level(statement_on(), "P1", 100, "auto")
    with pytest.raises(MeshError, match=r"solver\.method auto"):
        check_level(statement_on(coefficient="1 + x"), "P1", 100, "auto")


@pytest.mark.usefixtures("small_machine", "no_mesh")
def test_fourier_is_named_only_where_it_applies():
    """Not with contact on two sides, nor with different sides beside it."""
    for labels in (
        ("contact", "neumann", "contact", "dirichlet"),
        ("contact", "neumann", "dirichlet", "dirichlet"),
    ):
        with pytest.raises(MeshError, match=r"; set solver\.method to multigrid, or"):
            check_level(statement(labels, f=1), "P1", 32, "direct")


@pytest.mark.usefixtures("small_machine", "no_mesh")
def test_elements_differ_in_what_they_need():
    check_level(statement_on(), "P1", 20, "direct")
    with pytest.raises(MeshError, match=r"n = 20 for CR by solver\.method direct"):
        check_level(statement_on(), "CR", 20, "direct")
