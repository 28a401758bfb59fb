"""Refinement undone, against scikit-fem's and our own."""

from dataclasses import replace

import numpy as np
import pytest
import skfem

from signorini.mesh.coarsening import coarsest
from signorini.mesh.given import from_arrays, from_skfem
from signorini.mesh.labels import labelled

ROOT = (
    skfem.MeshTri.init_lshaped()
    .with_boundaries({"left": lambda x: x[0] == -1.0, "rest": lambda x: x[0] > -1.0})
    .with_subdomains({"low": lambda x: x[1] < 0.0})
)


def corners(t):
    """The triangles in an order of their own."""
    rows = np.sort(t, axis=0)
    return rows[:, np.lexsort(rows)]


@pytest.mark.parametrize("times", [0, 1, 3])
def test_the_refinement_of_the_root_is_the_mesh(times):
    theirs = ROOT.refined(times)
    root, found = coarsest(from_skfem(theirs))
    assert found == times
    mesh = labelled(root, {"left": "contact"}, rest="neumann", keep=["left"])
    for _ in range(found):
        mesh = mesh.refined()
    assert np.array_equal(mesh.p, theirs.p)
    assert np.array_equal(corners(mesh.t), corners(theirs.t))
    assert np.array_equal(mesh.facets, theirs.facets)
    assert np.array_equal(mesh.boundary_facets("contact"), np.sort(theirs.boundaries["left"]))
    ours, low = mesh.t[:, mesh.subdomains["low"]], theirs.t[:, theirs.subdomains["low"]]
    assert np.array_equal(corners(ours), corners(low))


def test_our_own_refinements_are_recognised():
    mesh = labelled(from_skfem(ROOT), {"left": "contact"}, rest="neumann").refined().refined()
    root, times = coarsest(from_arrays(mesh.p, mesh.t))
    assert times == 2
    assert root.t.shape == ROOT.t.shape


def test_a_part_or_subdomain_of_the_finer_mesh_alone_keeps_it():
    fine = from_skfem(ROOT.refined(2))
    half = {"half": fine.parts["left"][:, :3]}
    assert coarsest(replace(fine, parts=half))[1] == 0
    assert coarsest(replace(fine, subdomains={"some": np.arange(5)}))[1] == 0


def test_a_mesh_that_was_not_refined_is_its_own_root():
    fine = ROOT.refined(2)
    moved = fine.p + 1e-12 * np.sin(7.0 * fine.p)
    renumbered = np.roll(fine.t, 1, axis=1)
    for p, t in ((moved, fine.t), (fine.p, renumbered)):
        mesh = from_arrays(p, t)
        assert coarsest(mesh) == (mesh, 0)
