"""The figure of a sweep draws what it is given."""

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from signorini.figures.style import save_figure
from signorini.figures.sweep import draw_sweep


def curves(panels=3, variants=("",), ticks=None, **changes):
    series = [
        {"element": element, "variant": variant, "x": [0.0, 1.0, 2.0], "y": [1.0, k + 2.0, 50.0]}
        for element in ("P1", "CR")
        for k, variant in enumerate(variants)
    ]
    panel = {"label": "contact force in all", "log": False, "series": series}
    made = {"label": "truth.parameters.half_width", "log": False, "ticks": ticks}
    return made | {"panels": [panel] * panels} | changes


def test_every_series_is_a_line_of_its_panel():
    figure = draw_sweep(curves(variants=("f 1", "f 2")))
    assert len(figure.axes) == 3
    for axes in figure.axes:
        assert [list(line.get_ydata()) for line in axes.lines] == [
            [1.0, 2.0, 50.0],
            [1.0, 3.0, 50.0],
        ] * 2
    dashes = [line.get_linestyle() for line in figure.axes[0].lines]
    assert len(figure.legends[0].get_texts()) == 4
    assert len({str(line._dash_pattern) for line in figure.axes[0].lines[:2]}) == 2, dashes


def test_a_marker_is_seen_around_that_of_the_other_element():
    """The last points of both lie at the same place: the corners of a square within a ring."""
    axes = draw_sweep(curves()).axes[0]
    sizes = {line.get_marker(): line.get_markersize() for line in axes.lines}
    assert sizes["s"] * 2**0.5 < sizes["o"]


def test_many_variants_have_no_legend_to_drown_in():
    figure = draw_sweep(curves(variants=[f"f {k}" for k in range(9)]))
    assert figure.legends == []


def test_names_stand_where_values_are_no_numbers():
    figure = draw_sweep(curves(ticks=["falling", "rising", "criss_cross"]))
    labels = [tick.get_text() for tick in figure.axes[0].get_xticklabels()]
    assert labels == ["falling", "rising", r"criss$\_$cross"]


@pytest.mark.parametrize("panels", [1, 2, 3, 4])
def test_nothing_leaves_the_page(panels):
    figure = draw_sweep(curves(panels))
    renderer = FigureCanvasAgg(figure).get_renderer()
    width, height = figure.get_size_inches()
    for axes in figure.axes:
        box = axes.get_tightbbox(renderer)
        assert 0 <= box.x0 <= box.x1 <= width * figure.dpi
        assert 0 <= box.y0 <= box.y1 <= height * figure.dpi


def test_the_same_curves_give_the_same_bytes(tmp_path):
    for name in ("a.pdf", "b.pdf"):
        save_figure(draw_sweep(curves()), tmp_path / name)
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
