"""Pictures of meshes: every part by its name, inside the body, on a mesh that can be seen."""

import numpy as np
import pytest
import skfem

import signorini
from signorini.exceptions import SceneError

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def words(figure):
    return {text.get_text(): text for text in figure.axes[0].texts}


def test_parts_and_subdomains_are_named():
    bracket = signorini.triangulation("examples/bracket.msh")
    shown = words(bracket.plot())
    assert set(shown) == {"foot = 1", "wall = 2", "slope = 3", "free = 4", "steel = 5"}


def test_sides_with_names_do_without_their_numbers():
    hole = [(0.4, 0.4), (0.6, 0.4), (0.5, 0.6)]
    mesh = signorini.polygon(SQUARE, 4, sides=["a", "b", "a", "b"], holes=[hole])
    assert set(words(mesh.plot())) == {"a", "b", "hole-0"}


@pytest.mark.parametrize("size", [(1, 1), (40, 1)], ids=["to scale", "not to scale"])
def test_names_of_a_rectangle_stand_within_it(size):
    figure = signorini.rectangle(4, size=size, cells="per-side").plot()
    offsets = {name: text.get_position() for name, text in words(figure).items()}
    expected = {"bottom": (0, 7), "right": (-7, 0), "top": (0, -7), "left": (7, 0)}
    assert set(offsets) == set(expected)
    for name, offset in expected.items():
        np.testing.assert_allclose(offsets[name], offset, atol=1e-9)


def test_of_a_fine_mesh_a_level_is_drawn_whose_lines_can_be_told_apart():
    axes = signorini.rectangle(256).plot().axes[0]
    assert axes.get_title() == "8,192 triangles, level n = 64"
    coarsest = signorini.triangulation(skfem.MeshTri.init_tensor(*2 * [np.linspace(0, 1, 112)]))
    assert coarsest.plot().axes[0].get_title() == "24,642 triangles, level n = 1"


def test_a_title_is_taken_as_it_is(tmp_path):
    path = tmp_path / "mesh.png"
    figure = signorini.rectangle(2).plot(path, title="50 $ a_b")
    assert figure.axes[0].get_title() == "50 $ a_b"
    assert path.stat().st_size > 0
    with pytest.raises(SceneError, match=r"path: 'mesh\.gif' is no figure"):
        signorini.rectangle(2).plot("mesh.gif")
