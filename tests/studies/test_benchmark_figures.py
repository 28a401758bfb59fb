"""The benchmark's figures: what they show, and that nothing lies over anything."""

from itertools import combinations

import pytest
from benchmark_rows import FIGURES, GUARANTEED, POINTS, RIVALS, SUMMARY
from matplotlib.backends.backend_agg import FigureCanvasAgg

from signorini.figures import benchmark as figures
from signorini.figures.style import TEXT_WIDTH, save_figure
from signorini.studies.benchmark.columns import series
from signorini.studies.benchmark.guarantee_costs import by_run
from signorini.studies.benchmark.routes import best, in_full, rough_only


def drawn():
    found = series(POINTS)
    return {
        "error": figures.draw_error(best(found), rough_only(found)),
        "guaranteed": figures.draw_guaranteed(by_run(GUARANTEED)),
        "dofs": figures.draw_dofs(in_full(found)),
        "growth": figures.draw_growth(found),
        "rivals": figures.draw_rivals(RIVALS, SUMMARY["titles"]),
    }


@pytest.fixture(scope="module")
def figure():
    return drawn()


def test_every_figure_of_the_report_is_drawn_at_the_width_of_the_text(figure):
    assert figure.keys() == set(FIGURES)
    assert {round(found.get_figwidth(), 6) for found in figure.values()} == {round(TEXT_WIDTH, 6)}
    assert max(found.get_figheight() for found in figure.values()) < 235 / 25.4


def test_the_error_figure_has_one_curve_for_each_element_by_its_best_route(figure):
    axes = figure["error"].axes
    assert [ax.get_title() for ax in axes] == ["paper\nfourier", "corner\nfourier", "", ""]
    found = [len(ax.containers) for ax in axes]
    assert found == [4, 2, 4, 2]  # multigrid as far as it pays was measured for one scene


def test_labels_of_the_error_figure_do_not_overprint(figure):
    renderer = FigureCanvasAgg(figure["error"]).get_renderer()
    for axes in figure["error"].axes:
        boxes = [text.get_window_extent(renderer) for text in axes.texts]
        assert len(boxes) > 0
        pairs = combinations(boxes, 2)
        assert not any(one.overlaps(other) for one, other in pairs)


@pytest.mark.parametrize("name", ["error", "growth", "guaranteed", "rivals"])
def test_no_key_lies_over_data(figure, name):
    found = figure[name]
    renderer = FigureCanvasAgg(found).get_renderer()
    (key,) = found.legends
    assert not any(axes.get_legend() for axes in found.axes)
    panels = [axes.get_window_extent(renderer) for axes in found.axes]
    assert not any(key.get_window_extent(renderer).overlaps(panel) for panel in panels)


def test_the_key_of_the_rivals_names_elements_and_fates(figure):
    (key,) = figure["rivals"].legends
    words = [text.get_text() for text in key.get_texts()]
    assert words == ["P1 solved", "P1 failed", "equal; right of it ours is faster"]
    assert "1/8 to 1/16" in key.get_title().get_text()


def test_guarantees_and_true_errors_are_drawn_for_both_kinds_of_meshes(figure):
    for axes in figure["guaranteed"].axes:
        assert len(axes.lines) == 4
        true, guaranteed = axes.lines[0], axes.lines[1]
        assert (true.get_xdata() < guaranteed.get_xdata()).all()
        assert (true.get_ydata() < guaranteed.get_ydata()).all()


def test_a_failed_rival_is_hollow_and_an_absent_one_not_drawn(figure):
    (axes,) = figure["rivals"].axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["Fast", "Slow & sure"]
    fills = [line.get_markerfacecolor() for line in axes.lines if line.get_marker() == "o"]
    assert fills == ["black", "black", "white"]


@pytest.mark.parametrize("name", FIGURES)
def test_same_numbers_same_bytes(figure, name, tmp_path):
    again = drawn()[name]
    for k, found in enumerate((figure[name], again)):
        save_figure(found, tmp_path / f"{k}.pdf")
    assert (tmp_path / "0.pdf").read_bytes() == (tmp_path / "1.pdf").read_bytes()


def test_routes_and_elements_of_the_growth_are_told_apart_without_colour(figure):
    for axes in figure["growth"].axes:
        looks = [(line.get_marker(), line.get_markerfacecolor()) for line in axes.lines]
        assert len(set(looks)) == len(looks)


@pytest.mark.parametrize("name", ["growth", "dofs"])
def test_unknowns_have_several_numbers_and_none_lies_over_another(figure, name):
    renderer = FigureCanvasAgg(figure[name]).get_renderer()
    for axes in figure[name].axes[-2:]:
        figure[name].draw(renderer)
        numbers = [text for text in axes.get_xticklabels() if text.get_text()]
        boxes = [text.get_window_extent(renderer) for text in numbers]
        assert 2 <= len(boxes) <= 4
        assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
