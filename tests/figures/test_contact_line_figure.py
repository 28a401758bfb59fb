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
    upper, lower = figure.axes
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
    assert f"[$10^{{{round(np.log10(scale))}}}$]" in figure.axes[1].get_xlabel()
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
    line = next(line for line in figure.axes[1].lines if line.get_label() == "threshold")
    x, y = line.get_data()
    own = [row for row in rows if row["element"] == rows[0]["element"]]
    np.testing.assert_allclose(x, [row["s"] for row in own])
    unit = y[-1] / own[-1]["threshold"]
    np.testing.assert_allclose(y, [unit * row["threshold"] for row in own])
