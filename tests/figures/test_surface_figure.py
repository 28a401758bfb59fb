"""The surface."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from drawn import legend, line, pixels, sloping_surface
from signorini.figures.style import save_figure
from signorini.figures.surface import draw_surface


def test_critical_point_is_marked_where_the_contact_line_turns():
    figure = draw_surface(sloping_surface())
    marker = line(figure, "critical point").get_xydata()
    level = line(figure, "obstacle").get_xydata()
    np.testing.assert_allclose(marker[0], level[0] + 0.7 * (level[-1] - level[0]))
    assert "$x = 0.700$" in [text.get_text() for text in figure.axes[0].texts]


def test_binding_part_is_told_from_the_free_one():
    figure = draw_surface(sloping_surface())
    free = np.isfinite(line(figure, "contact side, free").get_ydata())
    binding = np.isfinite(line(figure, "contact side, binding").get_ydata())
    assert (free ^ binding).all()
    assert free.sum() == np.count_nonzero(np.linspace(0, 1, 65) < 0.7)


def test_an_obstacle_other_than_zero_decides_what_binds():
    surface = sloping_surface()
    surface["contact_obstacle"] = np.full(65, 0.35)
    surface["contact_u"] = np.maximum(surface["contact_u"], 0.35)
    binding = np.isfinite(line(draw_surface(surface), "contact side, binding").get_ydata())
    assert binding.sum() == np.count_nonzero(0.7 - np.linspace(0, 1, 65) <= 0.35)


def test_an_obstacle_below_the_surface_is_within_the_box():
    surface = sloping_surface()
    surface["contact_obstacle"] = np.linspace(-0.2, 0, 65)
    figure = draw_surface(surface)
    _, corner, *_ = figure.axes[0].collections[1].get_paths()[0].vertices  # below its left end
    assert corner[1] < line(figure, "obstacle").get_ydata()[0]


@pytest.mark.parametrize("points", [[], [(0.3, 0)], [(0.3, 0), (0.7, 0)]])
def test_any_number_of_critical_points(points):
    figure = draw_surface(sloping_surface(points))
    markers = [artist for artist in figure.axes[0].lines if artist.get_marker() == "o"]
    assert len(markers) == len(points)
    assert legend(figure).count("critical point") == bool(points)


@pytest.mark.parametrize(
    ("places", "told"), [([0.3], 1), ([0.3, 0.7], 2), ([0.3, 0.35], 0), ([0.1, 0.5, 0.9], 0)]
)
def test_values_of_critical_points_stand_where_they_have_room(places, told):
    figure = draw_surface(sloping_surface([(x, 0) for x in places]))
    values = [text for text in figure.axes[0].texts if text.get_text().startswith("$x = ")]
    assert len(values) == told


def test_the_name_of_u_is_left_of_its_values():
    """Values of five letters and more, which reach further to the left."""
    surface = sloping_surface(())
    figure = draw_surface(
        surface | {"u": surface["u"] / 100, "contact_u": surface["contact_u"] / 100}
    )
    pixels(figure)
    boxes = {text.get_text(): text.get_window_extent() for text in figure.axes[0].texts}
    name = boxes.pop("$u$")
    assert any(len(text) > 6 for text in boxes)
    assert not any(name.overlaps(box) for box in boxes.values())


@pytest.mark.filterwarnings("error")
def test_a_flat_surface_has_a_box_too(tmp_path):
    surface = sloping_surface(())
    flat = surface | {"u": np.zeros((9, 9)), "contact_u": np.zeros(65)}
    save_figure(draw_surface(flat), tmp_path / "f.png")


def test_surface_names_its_axes():
    texts = {text.get_text() for text in draw_surface(sloping_surface()).axes[0].texts}
    assert {"$x$", "$y$", "$u$"} <= texts


def test_nearer_cells_are_painted_later():
    cells = draw_surface(sloping_surface()).axes[0].collections[-1].get_paths()
    first, last = (cell.vertices[:, 1].mean() for cell in (cells[0], cells[-1]))
    assert len(cells) == 64
    assert first > last
