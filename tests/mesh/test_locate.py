"""Points in triangles, against their barycentric coordinates."""

import numpy as np
import pytest
import skfem

from builders import grid, labelled
from signorini.mesh.given import from_skfem
from signorini.mesh.labels import labelled as with_labels
from signorini.mesh.locate import locate

LSHAPE = with_labels(from_skfem(skfem.MeshTri.init_lshaped()), {}, rest="neumann")
MESHES = {
    "falling": grid(3, 5, size=(1.5, 1.0), origin=(-1.0, 2.0)),
    "rising": grid(4, 2, diagonal="rising"),
    "searched": labelled(skfem.MeshTri.init_sqsymmetric().refined(2)),
    "refined": LSHAPE.refined().refined(),
}


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_point_inside_a_triangle_is_found_in_it(mesh):
    shares = np.random.default_rng(1).dirichlet([1.0, 1.0, 1.0], mesh.number_of_triangles).T
    points = (mesh.p[:, mesh.t] * shares).sum(axis=1)
    triangles, found = locate(mesh, points)
    assert triangles.tolist() == list(range(mesh.number_of_triangles))
    np.testing.assert_allclose(found, shares, atol=1e-9)


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_vertex_is_found_in_a_triangle_that_has_it(mesh):
    triangles, shares = locate(mesh, mesh.p)
    assert np.all(mesh.t[shares.argmax(axis=0), triangles] == np.arange(mesh.number_of_vertices))
    np.testing.assert_allclose(shares.max(axis=0), 1.0)


@pytest.mark.parametrize("mesh", MESHES.values(), ids=MESHES)
def test_a_point_outside_is_in_no_triangle(mesh):
    centre = mesh.p.mean(axis=1, keepdims=True)
    outside = centre + 2.0 * (mesh.p.max(axis=1, keepdims=True) - centre) * [[1, 0, -1], [0, 1, 1]]
    assert locate(mesh, outside)[0].tolist() == [-1, -1, -1]


def test_a_notch_is_outside():
    x, y = np.array([[-0.5, -0.5, 0.5, 0.5], [-0.5, 0.5, -0.5, 0.5]])
    triangles, _ = locate(MESHES["refined"], np.stack([x, y]))
    assert np.array_equal(triangles < 0, (x > 0.0) & (y > 0.0))


def test_long_thin_triangles_are_found_though_other_centroids_are_nearer():
    x = np.linspace(0.0, 1.0, 60)
    p = np.array([np.append(x, [0.5]), np.append(0.0 * x, [40.0])])
    t = np.array([range(59), range(1, 60), [60] * 59])
    fan = with_labels(from_skfem(skfem.MeshTri(p, t)), {}, rest="neumann")
    points = fan.p[:, fan.t].transpose(1, 0, 2)[0] * 0.98 + 0.01 * (
        fan.p[:, fan.t[1]] + fan.p[:, fan.t[2]]
    )
    assert locate(fan, points)[0].tolist() == list(range(59))
