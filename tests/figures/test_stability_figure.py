"""The figures of the stability suite."""

import pytest

pytest.importorskip("matplotlib")

from drawn import legend
from signorini.figures.stability import draw_floor

LINES = {"P1": (2.0, 1.0), "CR": (2.0, 4.0)}


def rows(patch):
    return [
        {"element": element, "family": family, "n": n, "l2": error, "h1_semi": 0.0}
        for element in LINES
        for family, error in (("smooth", 1e-3), ("patch", patch))
        for n in (2, 4, 8)
    ]


@pytest.mark.parametrize(("patch", "families"), [(0.0, ["error"]), (1e-16, ["error", "round-off"])])
def test_the_legend_of_the_floor_names_what_is_drawn_and_nothing_else(patch, families):
    names = ["CF (P1)", "NCF (CR)"]
    told = [*families, "eps times condition"]
    expected = {f"{name}, {what}" for name in names for what in told}
    found = legend(draw_floor(rows(patch), LINES))
    assert sorted(found) == sorted(expected)
