"""The convergence plots."""

from math import inf, log

import pytest

pytest.importorskip("matplotlib")

from drawn import FIGURES, legend, pixels, published_errors
from signorini.figures.convergence import draw_convergence
from signorini.figures.style import save_figure


def test_convergence_is_labelled():
    figure = FIGURES["convergence"]()
    (axes,) = figure.axes
    assert legend(figure) == ["CF (P1), slope 1.90", "NCF (CR), slope 2.10"]
    assert axes.get_xlabel() == "mesh width $h$"
    assert axes.get_ylabel() == "$L^2$ error"
    ticks = dict(
        zip((t.get_text() for t in axes.get_xticklabels()), axes.get_xticks(), strict=True)
    )
    assert ticks == {f"1/{n}": 1 / n for n in (2, 4, 8, 16, 32, 64)}
    assert axes.get_xlim() == pytest.approx((1e-2, 1))  # as in the paper


@pytest.mark.parametrize(("norm", "order"), [("l2", 2), ("h1", 1), ("h1_semi", 1)])
def test_triangle_has_the_slope_it_says(norm, order):
    (axes,) = draw_convergence(published_errors(), norm).axes
    (left, low), (right, _), (_, high), _ = axes.lines[-1].get_xydata()
    assert log(high / low) / log(right / left) == pytest.approx(order)
    assert [text.get_text() for text in axes.texts] == ["$1$", f"${order}$"]


FITTED = {
    "narrow": [(n, 0.3 / n) for n in (8, 16)],
    "wide": [(2**k, 7.0**-k) for k in range(1, 10)],
    "bent": [(4, 0.5), (8, 0.01), (16, 0.009), (32, 0.001)],
    "one": [(8, 0.02)],
}


def fitted(name, slopes):
    errors = [
        {"element": element, "n": n, "h": 1 / n, "l2": factor * error}
        for element, factor in (("P1", 1.0), ("CR", 2.0))
        for n, error in FITTED[name]
    ]
    return draw_convergence(errors, "l2", slopes, fitted=True)


@pytest.mark.parametrize("name", FITTED)
def test_fitted_axes_hold_all_and_nothing_covers_a_curve(name):
    figure = fitted(name, {"P1": 1.9, "CR": 2.0})
    (axes,) = figure.axes
    pixels(figure)
    box = axes.get_window_extent()
    legend_box = axes.get_legend().get_window_extent()
    assert legend_box.y0 >= box.y1 - 1
    assert legend_box.y1 <= figure.bbox.y1
    assert all(box.contains(*place) for text in axes.texts for place in corners(text))
    p1, _, *triangle = axes.lines
    for line in axes.lines:
        assert all(box.contains(*axes.transData.transform(point)) for point in line.get_xydata())
    low, high = axes.get_ylim()
    powers = [k for k in range(-20, 5) if low <= 10.0**k <= high]
    assert len(powers) >= 2
    for shape in triangle:
        (left, bottom), _, (right, top), _ = shape.get_xydata()
        assert log(top / bottom) / log(right / left) == pytest.approx(2)
        for h, error in p1.get_xydata():
            if left <= h <= right:
                assert bottom * (h / left) ** 2 < 0.7 * error


def corners(text):
    box = text.get_window_extent()
    return [(box.x0, box.y0), (box.x1, box.y1)] if text.get_text() == "$1$" else []


@pytest.mark.parametrize(
    ("slopes", "shown"),
    [
        ({"P1": 1.52, "CR": "1.47"}, ["$1$", "$3/2$"]),
        ({"P1": 0.84, "CR": 0.82}, ["$1$", "$0.83$"]),
        ({"P1": 1.91, "CR": 1.89}, ["$1$", "$2$"]),
        ({"P1": 1.84, "CR": 1.6}, ["$1$", "$1.7$"]),
        ({"P1": 1.57, "CR": 1.92}, []),
        ({"P1": 0.1, "CR": 0.2}, []),
        (None, []),
    ],
)
def test_the_triangle_is_of_the_rate_that_the_slopes_show(slopes, shown):
    (axes,) = fitted("wide", slopes).axes
    assert [text.get_text() for text in axes.texts] == shown


def test_lines_differ_in_more_than_colour():
    lines = draw_convergence(published_errors(), "h1").axes[0].lines[:2]
    assert len({artist.get_marker() for artist in lines}) == 2
    assert len({artist.get_linestyle() for artist in lines}) == 2


@pytest.mark.parametrize("error", [0.0, None, "", inf])
def test_an_error_that_has_no_logarithm_is_left_out(error, tmp_path):
    errors = published_errors()
    errors[-1]["l2"] = error
    figure = draw_convergence(errors, "l2")
    save_figure(figure, tmp_path / "f.png")
    assert figure.axes[0].get_ylim()[0] > 1e-6


def test_many_levels_keep_the_labels_apart():
    errors = [{"element": "CR", "n": 2**k, "h": 2.0**-k, "l2": 4.0**-k} for k in range(12)]
    labels = [text.get_text() for text in draw_convergence(errors, "l2").axes[0].get_xticklabels()]
    assert len(labels) == 12
    assert sum(map(bool, labels)) <= 7


def test_any_norm_that_is_given():
    errors = [row | {"trace_l2": row["h1"], "l_17": row["h1"]} for row in published_errors()]
    for norm, name in (("trace_l2", r"$L^2(\Gamma_C)$ error of $u$"), ("l_17", "l 17")):
        (axes,) = draw_convergence(errors, norm).axes
        assert axes.get_ylabel() == name
        assert axes.texts[-1].get_text() == "$1$"


def test_mesh_widths_that_are_not_one_over_n_are_named_by_their_value():
    errors = [{"element": "CR", "n": n, "h": 0.37 / n, "l2": n**-2.0} for n in (2, 4, 8)]
    labels = [text.get_text() for text in draw_convergence(errors, "l2").axes[0].get_xticklabels()]
    assert labels == ["0.18", "0.092", "0.046"]


@pytest.mark.parametrize(("norm", "element"), [("l3", "P1"), ("l2", "P2")])
def test_unknown_names_are_refused(norm, element):
    with pytest.raises(ValueError, match="known: "):
        draw_convergence([{"element": element, "n": 2, "h": 0.5, "l2": 1.0}], norm)
