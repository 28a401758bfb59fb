"""Figures of what is local: which there are, and that what they say is on the page."""

import subprocess
from shutil import which

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.backends.backend_agg import FigureCanvasAgg

from signorini import load_scene
from signorini.api.solving import solve_level
from signorini.figures import details as module
from signorini.figures.details import bar_ticks, draw_details
from signorini.figures.style import save_figure
from signorini.report.details import details_of


@pytest.fixture(scope="module")
def details():
    scene = load_scene("config/scenes/smooth.yaml")
    solutions = [solve_level(scene, element, 8) for element in ("P1", "CR")]
    found = details_of(scene, scene.problem_statement.triangulations, solutions)
    rising = np.linspace(0.1, 1.0, found["t"].shape[1])
    return found | {"bound_P1": rising, "bound_CR": 2.0 * rising}


@pytest.fixture(scope="module")
def figures(details):
    return draw_details(details)


def collections(figure):
    return [c for axes in figure.axes for c in axes.collections if c.get_array() is not None]


def test_there_is_a_figure_of_all_that_was_measured(details, figures):
    assert list(figures) == ["mesh", "errors", "bounds", "jumps"]
    plain = {k: v for k, v in details.items() if k.split("_")[0] not in ("error", "bound", "jump")}
    assert list(draw_details(plain)) == ["mesh"]


def test_the_elements_share_a_scale(figures):
    first, second = collections(figures["bounds"])[:2]
    assert first.norm is second.norm
    assert (first.norm.vmin, first.norm.vmax) == pytest.approx((0.1, 2.0), rel=0.02)


def test_every_triangle_and_every_facet_is_drawn(details, figures):
    triangles = collections(figures["errors"])[0]
    assert triangles.get_array().size == details["t"].shape[1] == 128
    assert collections(figures["jumps"])[0].get_array().size == details["jump"].size


def test_all_words_and_tick_labels_are_on_the_page(figures):
    for figure in figures.values():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        page = figure.bbox
        for axes in figure.axes:
            box = axes.get_tightbbox(canvas.get_renderer())
            assert page.contains(box.x0, box.y0), axes.get_title()
            assert page.contains(box.x1, box.y1), axes.get_title()


def test_the_legend_is_off_the_panels(figures):
    for figure in figures.values():
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        renderer = canvas.get_renderer()
        legend = figure.legends[0].get_window_extent(renderer)
        boxes = [axes.get_tightbbox(renderer) for axes in figure.axes]
        assert not any(legend.overlaps(box) for box in boxes)


def test_many_lines_are_a_picture_within_the_pdf(details, monkeypatch):
    assert not draw_details(details)["mesh"].axes[0].collections[0].get_rasterized()
    monkeypatch.setattr(module, "MOST_LINES", 100)
    assert draw_details(details)["mesh"].axes[0].collections[0].get_rasterized()


def test_errors_of_nothing_are_drawn(details):
    none = {name: 0 * part if name.startswith("error") else part for name, part in details.items()}
    assert "errors" in draw_details(none)


@pytest.mark.parametrize(("low", "high"), [(1e-9, 3e-6), (0.11, 0.19), (1.0, 2.0), (3.1, 3.2)])
def test_a_bar_has_two_ticks_at_least(low, high):
    ticks = bar_ticks(low, high)
    assert len(ticks) >= 2
    assert low <= min(ticks) < max(ticks) <= high


@pytest.mark.skipif(not which("pdftotext"), reason="needs pdftotext")
def test_text_of_the_pdf_can_be_read(figures, tmp_path):
    path = tmp_path / "errors.pdf"
    save_figure(figures["errors"], path)
    text = subprocess.run(["pdftotext", path, "-"], capture_output=True, text=True, check=True)
    assert "root mean square on each triangle" in " ".join(text.stdout.split())
    assert {"Dirichlet", "contact", "CF (P1)", "NCF (CR)"} <= set(text.stdout.splitlines())
