"""What is gathered for figures of triangles."""

import numpy as np
import pytest

from signorini import load_scene
from signorini.api.solving import solve_level
from signorini.certificate.level import certified_level
from signorini.report import details as module
from signorini.report.details import details_of

SCENE = load_scene("config/scenes/smooth.yaml")
DOMAIN = SCENE.problem_statement.triangulations
SOLUTIONS = [solve_level(SCENE, element, 8) for element in ("P1", "CR")]


def test_parts_of_a_bound_keep_what_the_certificate_adds_up():
    mesh, by_element = DOMAIN.level(8), {one.element: one for one in SOLUTIONS}
    level = certified_level(SCENE.problem_statement, mesh, by_element, n=8, h=DOMAIN.mesh_size(8))
    found = details_of(SCENE, DOMAIN, SOLUTIONS, certificate=level)
    for element, shares in zip(level.elements, level.numbers["contributions"], strict=True):
        parts = np.sum(mesh.area * found[f"bound_{element}"] ** 2)
        assert parts == pytest.approx(shares.sum(), rel=1e-12)


def test_without_truth_and_certificate_there_are_neither():
    scene = load_scene("config/scenes/paper.yaml")
    domain = scene.problem_statement.triangulations
    found = details_of(scene, domain, [solve_level(scene, "P1", 8)])
    assert not [name for name in found if name.startswith(("error", "bound", "jump"))]


def test_a_mesh_of_too_many_lines_is_shown_coarser(monkeypatch):
    monkeypatch.setattr(module, "LINES_SEEN", 40)
    found = details_of(SCENE, DOMAIN, SOLUTIONS)
    assert (found["t"].shape[1], found["mesh_t"].shape[1], int(found["mesh_n"])) == (128, 32, 4)
