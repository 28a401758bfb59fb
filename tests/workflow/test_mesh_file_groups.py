"""Scenes on mesh files whose groups have labels for their names."""

import shutil

import pytest
from project import ROOT, Project

SCENE = """\
title: Groups named as labels are
domain: {kind: mesh, file: ../meshes/labels.msh}
boundary: BOUNDARY
data: {f: -1, dirichlet: 0.01}
elements: [P1]
levels: [1, 2]
truth: {kind: reference, n: 8}
"""


@pytest.fixture
def project(tmp_path):
    project = Project.fresh(tmp_path / "project")
    shutil.copy(
        ROOT / "tests/data/groups_named_as_labels_41.msh", project / "config/meshes/labels.msh"
    )
    return project


def test_a_group_named_dirichlet_may_be_the_contact_side(project):
    boundary = "{contact: dirichlet, dirichlet: contact, neumann: neumann}"
    project.write("config/scenes/small.yaml", SCENE.replace("BOUNDARY", boundary))
    project.build()
    header, *rows = project.results()["small/contact_line.csv"].decode().splitlines()
    y = header.split(",").index("y")
    assert {float(row.split(",")[y]) for row in rows} == {1.0}  # the group contact is at the bottom


def test_a_group_named_contact_makes_no_contact_line(project):
    boundary = "{contact: dirichlet, dirichlet: neumann, neumann: neumann}"
    project.write("config/scenes/small.yaml", SCENE.replace("BOUNDARY", boundary))
    assert "contact_line" not in project.jobs()


def test_a_group_named_contact_is_no_formula(project):
    boundary = "{contact: contact, dirichlet: dirichlt, neumann: neumann}"
    project.write("config/scenes/small.yaml", SCENE.replace("BOUNDARY", boundary))
    run = project.run()
    assert len(run.errors) == 1, run.text
    assert (
        'small.yaml: boundary.dirichlet: "dirichlt" is no label, but other values are; did you'
        in run.errors[0]
    )
