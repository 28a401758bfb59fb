"""Parts of meshes for processes: together they are the whole, and meet in the same vertices."""

import numpy as np
import pytest

from bisection import l_shape
from builders import grid
from signorini.mesh.patch import cut_out, dealt_out, facets_along
from signorini.mesh.strip import strip_of


@pytest.mark.parametrize("diagonal", ["falling", "rising"])
def test_strips_are_the_grid(diagonal):
    whole = grid(3, 5, diagonal=diagonal)
    vertices, facets = set(), set()
    for first, last in ((0, 2), (2, 3), (3, 5)):
        strip = strip_of(whole, first, last)
        mine, edges = strip.vertices_of_whole(), strip.facets_of_whole()
        np.testing.assert_array_equal(strip.p, whole.points(mine))
        np.testing.assert_array_equal(mine[strip.facets], whole.facets[:, edges])
        vertices.update(mine)
        facets.update(edges)
    assert len(vertices) == whole.number_of_vertices
    assert len(facets) == whole.number_of_facets


def test_a_cut_is_no_boundary():
    strip = strip_of(grid(4), 1, 3)
    assert strip.boundary_facets("contact").size == strip.boundary_facets("dirichlet").size == 0
    assert strip.boundary_facets("neumann").size == 4


@pytest.mark.parametrize("levels", [0, 1, 2])
@pytest.mark.parametrize("count", [2, 3])
def test_patches_are_the_refined_mesh(count, levels):
    coarse = l_shape().refined()
    fine = coarse
    for _ in range(levels):
        fine = fine.refined()
    owner = dealt_out(coarse, count)
    cuts = [cut_out(coarse, owner, which, levels) for which in range(count)]
    found = np.concatenate([cut.triangles for cut in cuts])
    np.testing.assert_array_equal(np.sort(found), np.arange(fine.number_of_triangles))
    for cut in cuts:
        corners = fine.p[:, fine.t[:, cut.triangles]]
        np.testing.assert_array_equal(cut.mesh.p[:, cut.mesh.t], corners)


def test_neighbours_know_the_same_chains():
    coarse = l_shape().refined()
    owner = dealt_out(coarse, 3)
    cuts = [cut_out(coarse, owner, which, 2) for which in range(3)]
    for which, cut in enumerate(cuts):
        for other, chains in cut.chains.items():
            theirs = cuts[other]
            np.testing.assert_array_equal(
                cut.mesh.p[:, chains], theirs.mesh.p[:, theirs.chains[which]]
            )
            assert facets_along(cut.mesh, chains).shape == (len(chains), 4)
        for other, corners in cut.corners.items():
            theirs = cuts[other]
            np.testing.assert_array_equal(
                cut.mesh.p[:, corners], theirs.mesh.p[:, theirs.corners[which]]
            )
