"""The field, and the gallery of fields."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from drawn import inside, legend, lightness, line, pixels, sloping_field
from signorini.figures.field import COLOURS, draw_field
from signorini.figures.gallery import draw_gallery


def test_colours_read_in_grey():
    steps = np.diff(lightness(COLOURS(np.linspace(0, 1, 50))[:, :3]))
    assert (steps < 0).all()
    assert steps.min() / steps.max() < 2
    assert lightness(np.array(COLOURS(1.0)[:3])) > 30  # black lines stand out


@pytest.mark.parametrize("turn", [0.7, 0.76, 0.84])
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_every_point_of_the_domain_has_a_colour(element, turn):
    """Whatever the round numbers of the colour bar leave over."""
    assert not (inside(draw_field(sloping_field(element, turn=turn))) == 255).all(axis=-1).any()


def test_contours_stay_inside_their_triangles():
    """Of a function that is 0 on one triangle and 1 on the other, nothing is interpolated."""
    field = sloping_field(n=1)
    jump = field | {"values": np.array([[0.0, 1.0]] * 3), "range": np.array([0.0, 1.0])}
    figure = draw_field(jump)
    _, lines = figure.axes[0].collections[:2]
    assert not any(len(path.vertices) for path in lines.get_paths())
    assert len(np.unique(inside(figure).reshape(-1, 3), axis=0)) == 2


@pytest.mark.parametrize("label", ["Dirichlet", "Neumann", "contact", "contact, binding"])
def test_boundary_parts_lie_where_they_should(label):
    points = line(draw_field(sloping_field("CR")), label).get_xydata()
    points = points[np.isfinite(points).all(axis=1)]
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    expected = {"Dirichlet": ([0, 1], [1, 1]), "Neumann": ([0, 0], [1, 1])}
    expected |= {"contact": ([0, 0], [1, 0]), "contact, binding": ([0.75, 0], [1, 0])}
    assert (low, high) == expected[label]


def test_boundary_parts_differ_in_more_than_colour():
    lines = [
        line(draw_field(sloping_field()), name)
        for name in ("Dirichlet", "Neumann", "contact", "contact, binding")
    ]
    assert len({(artist.get_linewidth(), artist.get_linestyle()) for artist in lines}) == 4


def test_contact_by_turns_is_a_bar_of_its_own():
    pieces = np.array([[[0.0, 0.0], [0.25, 0.0]], [[0.25, 0.0], [0.5, 0.0]]])
    figure = draw_field(sloping_field() | {"by_turns": pieces})
    assert "alternating contact" in legend(figure)
    bar = line(figure, "alternating contact").get_xydata()
    np.testing.assert_array_equal(bar, [[0, 0], [0.25, 0], [0.5, 0]])
    assert "alternating contact" not in legend(draw_field(sloping_field()))


def test_critical_points_of_a_field_are_marked():
    figure = draw_field(sloping_field("CR"))
    np.testing.assert_array_equal(line(figure, "critical point").get_xydata(), [[0.75, 0]])
    assert legend(figure) == [
        "Dirichlet",
        "Neumann",
        "contact",
        "contact, binding",
        "critical point",
    ]
    assert "critical point" not in legend(draw_field(sloping_field(turn=2)))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("offset", [0.0, 1e6])
def test_any_size_and_place(scale, offset):
    origin = (scale * offset, -scale * offset)
    figure = draw_field(sloping_field(size=(scale, 2 * scale), origin=origin))
    axes = figure.axes[0]
    image, reference = (
        pixels(figure).astype(int),
        pixels(draw_field(sloping_field(size=(1.0, 2.0)))).astype(int),
    )
    box = np.array(axes.get_window_extent()).ravel()
    x, y = axes.transData.transform([[0, 0], [1, 1]])
    assert (y - x)[0] == pytest.approx((y - x)[1])  # one scale for both axes
    labels = {0.0: ("$x$", "$y$"), 1e6: ("$x - 1000000$", "$y + 1000000$")} if scale == 1 else {}
    if offset in labels:
        assert (axes.get_xlabel(), axes.get_ylabel()) == labels[offset]
    elif scale != 1:
        assert f"[$10^{{{round(np.log10(scale))}}}$]" in axes.get_xlabel()
    assert all(len(text.get_text()) < 8 for text in axes.get_xticklabels() + axes.get_yticklabels())
    middle = [
        slice(len(image) // 2 - 50, len(image) // 2 + 50),
        slice(int(box[0]) + 9, int(box[2]) - 9),
    ]
    assert np.mean(np.any(image[tuple(middle)] != reference[tuple(middle)], axis=-1)) < 0.01


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("height", [0.0, 1e-300, 1e250])
@pytest.mark.parametrize("size", [(1.0, 1.0), (1.0, 1e-6), (1e-3, 1.0)])
def test_any_values_and_shape(height, size):
    field = sloping_field("CR", height=height, size=size)
    figure = draw_field(field, "any")
    pixels(figure)
    assert ("not to scale" in figure.axes[0].get_xlabel()) == (size != (1.0, 1.0))
    pixels(draw_gallery([("any", "", field)]))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("title", ["x_1 < 2 & $", r"$\nonsense$", "{Γ_C} ≤ 10^3 %", "Signorini's"])
def test_titles_are_plain_text(title):
    figure = draw_field(sloping_field(), title)
    pixels(figure)
    assert title in [text.get_text() for text in figure.texts]


@pytest.mark.parametrize("count", [1, 4, 5, 9])
def test_gallery_has_four_in_a_row(count):
    scenes = [
        (f"scene-{k}", "a title that is far too long for its cell " * 4, sloping_field(n=2))
        for k in range(count)
    ]
    figure = draw_gallery(scenes)
    domains = [axes.get_position() for axes in figure.axes[:count]]
    assert len({round(box.x0, 6) for box in domains}) == min(count, 4)
    assert len({round(box.y0, 6) for box in domains}) == -(-count // 4)
    assert min(box.y0 for box in domains) > 0
    assert {name for name, *_ in scenes} <= {text.get_text() for text in figure.texts}
    assert max(text.get_text().count("\n") for text in figure.texts) == 1


def test_gallery_says_what_range_u_has():
    field = sloping_field(height=1e-9)
    assert "$0 \\leq u \\leq 700$  [$10^{-12}$]" in {
        text.get_text() for text in draw_gallery([("a", "", field)]).texts
    }


def test_an_empty_gallery_is_refused():
    with pytest.raises(ValueError, match="no scenes"):
        draw_gallery([])
