"""The contact line."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from drawn import legend, pixels, sloping_rows
from signorini.figures.contact_line import draw_contact_line
from signorini.figures.style import save_figure
from signorini.storage import read_csv, write_csv


def test_contact_line_from_text_and_from_numbers(tmp_path):
    write_csv(tmp_path / "line.csv", sloping_rows())
    for rows, name in ((sloping_rows(), "a.png"), (read_csv(tmp_path / "line.csv"), "b.png")):
        save_figure(draw_contact_line(rows), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_contact_line_shows_the_finest_level():
    figure = draw_contact_line([*sloping_rows(n=16), *sloping_rows(n=8)])
    assert legend(figure) == [
        "CF (P1), $n = 16$",
        "NCF (CR), $n = 16$",
        "obstacle",
        "critical point",
    ]
    upper, _, lower = figure.axes
    for axes, column in ((upper, "u"), (lower, "flux")):
        x, y = next(artist for artist in axes.lines if len(artist.get_xdata()) == 17).get_data()
        rows = [row for row in sloping_rows(n=16) if row["element"] == "P1"]
        np.testing.assert_allclose(x, [row["s"] for row in rows])
        np.testing.assert_allclose(y, [row[column] for row in rows], atol=1e-15)


def test_where_h_is_not_1_over_n_the_legend_tells_it():
    rows = [row | {"h": 0.0519} for row in sloping_rows(n=4)]
    assert legend(draw_contact_line(rows))[:2] == ["CF (P1), $h = 0.052$", "NCF (CR), $h = 0.052$"]


def test_critical_points_of_the_contact_line_are_marked_in_both_panels():
    for axes in draw_contact_line(sloping_rows()).axes:
        upright = [
            artist.get_xdata()[0] for artist in axes.lines if len(set(artist.get_xdata())) == 1
        ]
        assert sorted({0.6875, 0.75} & set(upright)) == [0.6875, 0.75]


def test_components_are_drawn_apart():
    rows = sloping_rows(labels=("contact", "neumann", "contact", "neumann"))
    curve = draw_contact_line(rows).axes[0].lines[0]
    assert np.flatnonzero(np.isnan(curve.get_xdata())).tolist() == [9]
    assert len(curve.get_xdata()) == 19


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-9, 1e9])
def test_contact_line_of_any_size(scale):
    rows = sloping_rows(size=(scale, scale), height=1e-200)
    figure = draw_contact_line(rows)
    pixels(figure)
    assert f"[$10^{{{round(np.log10(scale))}}}$]" in figure.axes[-1].get_xlabel()
    assert "[$10^{-201}$]" in figure.axes[0].get_title(loc="left")


@pytest.mark.filterwarnings("error")
def test_contact_line_without_force():
    pixels(draw_contact_line(sloping_rows(turn=2)))


def test_contact_line_that_cannot_be_drawn_is_refused():
    with pytest.raises(ValueError, match="no rows"):
        draw_contact_line([])
    with pytest.raises(ValueError, match="known: P1, CR"):
        draw_contact_line([row | {"element": "P2"} for row in sloping_rows()])


def test_the_threshold_is_drawn_below_where_there_is_one():
    rows = [row | {"threshold": 0.25 * row["s"]} for row in sloping_rows()]
    figure = draw_contact_line(rows)
    assert "threshold" in legend(figure)
    assert "threshold" not in legend(draw_contact_line(sloping_rows()))
    line = next(line for line in figure.axes[-1].lines if line.get_label() == "threshold")
    x, y = line.get_data()
    own = [row for row in rows if row["element"] == rows[0]["element"]]
    np.testing.assert_allclose(x, [row["s"] for row in own])
    unit = y[-1] / own[-1]["threshold"]
    np.testing.assert_allclose(y, [unit * row["threshold"] for row in own])


def difference_lines(rows):
    _, middle, _ = draw_contact_line(rows).axes
    return middle, [line for line in middle.lines if len(line.get_xdata()) > 2]


def test_cr_is_drawn_against_p1_where_the_one_would_hide_the_other():
    rows = [row | {"u": row["u"] + 1e-7 * (row["element"] == "CR")} for row in sloping_rows(turn=2)]
    middle, (line,) = difference_lines(rows)
    assert "u_\\mathrm{CR} - u_\\mathrm{P1}" in middle.get_title(loc="left")
    assert "10^{-9}" in middle.get_title(loc="left")
    np.testing.assert_allclose(line.get_ydata(), 100.0, rtol=1e-6)


def test_both_are_drawn_against_the_exact_solution_where_there_is_one():
    shifts = {"P1": 0.5, "CR": -0.25}
    rows = [row | {"exact": row["u"] - shifts[row["element"]]} for row in sloping_rows()]
    middle, lines = difference_lines(rows)
    assert middle.get_title(loc="left") == "$u_h - u$"
    for line, shift in zip(lines, shifts.values(), strict=True):
        np.testing.assert_allclose(line.get_ydata(), shift, rtol=1e-12)


def test_both_are_drawn_against_the_reference_where_nothing_is_exact():
    rows = [row | {"reference": row["u"] - 0.5} for row in sloping_rows()]
    rows[3]["reference"] = None
    middle, lines = difference_lines(rows)
    assert middle.get_title(loc="left") == r"$u_h - u_\mathrm{ref}$"
    assert len(lines) == 2
    assert np.isnan(lines[0].get_ydata()).sum() == 1
    for line in lines:
        known = line.get_ydata()[~np.isnan(line.get_ydata())]
        np.testing.assert_allclose(known, 0.5, rtol=1e-12)


@pytest.mark.parametrize(
    ("forces", "told"),
    [
        ((0.040625, 0.0405), "resultant: P1 $0.040625$, CR $0.040625$, reference $0.040500$"),
        ((4e-8, 0.0), "resultant  [$10^{-9}$]: P1 $40.000$, CR $40.000$, reference $0.000$"),
        ((-12.5, 12.0), "resultant: P1 $-12.500$, CR $-12.500$, reference $12.000$"),
        ((0.0, None), "resultant: P1 $0$, CR $0$"),
    ],
)
def test_the_whole_contact_forces_are_told_above_their_densities(forces, told):
    whole = dict(zip(("resultant", "true_resultant"), forces, strict=True))
    figure = draw_contact_line([row | whole for row in sloping_rows()])
    assert figure.axes[-1].get_title(loc="right") == told


def test_markers_of_one_element_do_not_hide_those_of_the_other():
    upper = draw_contact_line(sloping_rows(n=64)).axes[0]
    shown = {line.get_label(): line for line in upper.lines}
    places = [
        set(np.arange(64)[slice(line.get_markevery()[0], None, line.get_markevery()[1])])
        for name, line in shown.items()
        if "n = 64" in name
    ]
    assert len(places) == 2
    assert not set.intersection(*places)


def test_one_element_alone_has_nothing_to_be_compared_with():
    rows = [row for row in sloping_rows() if row["element"] == "CR"]
    assert len(draw_contact_line(rows).axes) == 2


def test_many_neighbouring_critical_points_are_one_interval():
    rows = sloping_rows(n=32)
    for k, row in enumerate(rows):
        row["critical"] = row["s"] + 1 / 64 if 5 < k < 15 and row["element"] == "P1" else None
    figure = draw_contact_line(rows)
    assert "alternating contact" in legend(figure)
    assert "critical point" not in legend(figure)
    for axes in figure.axes:
        (band,) = axes.patches
        assert (band.get_x(), band.get_width()) == pytest.approx((6.5 / 32, 8 / 32))


def touching_rows(n=32):
    """Contact with force before 0.3; the exact solution is on the obstacle up to 0.7."""
    rows = [row | {"exact": row["obstacle"]} for row in sloping_rows(n=n)]
    for row in rows:
        row["flux"] = 1.0 if row["s"] < 0.3 else 0.0
        row["exact"] += max(row["s"] - 0.7, 0.0)
    return rows


def test_contact_without_force_is_an_interval():
    figure = draw_contact_line(touching_rows())
    assert "contact without force" in legend(figure)
    for axes in figure.axes:
        (band,) = axes.patches
        assert band.get_x() == pytest.approx(0.3, abs=1 / 32)
        assert band.get_x() + band.get_width() == pytest.approx(0.7, abs=1 / 32)


def test_contact_with_force_and_a_gap_are_no_such_interval():
    pressed = [row | {"flux": 1.0} for row in touching_rows()]
    apart = [row | {"exact": row["obstacle"] + 1e-6} for row in touching_rows()]
    for rows in (pressed, apart):
        assert not any(axes.patches for axes in draw_contact_line(rows).axes)


def test_a_legend_of_two_rows_is_below_all_labels():
    figure = draw_contact_line(touching_rows())
    pixels(figure)
    lowest = min(axes.get_tightbbox().y0 for axes in figure.axes)
    (key,) = figure.legends
    box = key.get_window_extent()
    texts = [text.get_window_extent() for text in key.texts]
    assert max(text.y0 for text in texts) > max(text.y1 for text in texts[1:2])  # two rows
    assert 0 <= box.y0 < box.y1 < lowest
    assert 0 <= box.x0 < box.x1 <= figure.bbox.width


@pytest.mark.parametrize("height", [1e-4, 0.00123456, 1.0])
def test_no_tick_label_is_cut_off(height):
    figure = draw_contact_line(sloping_rows(height=height))
    pixels(figure)
    labels = [text for axes in figure.axes for text in axes.get_yticklabels() if text.get_text()]
    assert labels
    assert min(text.get_window_extent().x0 for text in labels) >= 0
