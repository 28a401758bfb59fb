"""The adaptive study: what is saved, computed from runs of known powers."""

import numpy as np
import pytest

from signorini.studies.adaptive.page import page, summary_rows
from signorini.studies.adaptive.summary import compare, needed, run_of, slope


def run(power, factor=2.0, seconds=1e-5, count=9, effectivity=None):
    """A run whose bound is dofs**power and whose steps take so many seconds per unknown."""
    dofs = 50 * factor ** np.arange(count)
    steps = [
        {
            "step": k,
            "element": element,
            "dofs": n,
            "upper": n**power,
            "lower": 0.9 * n**power,
            "effectivity": effectivity,
        }
        for k, n in enumerate(dofs)
        for element in ("P1", "CR")
    ]
    took = [
        {"step": k, "refine": 0.0, "solve": seconds * n, "certify": seconds * n}
        for k, n in enumerate(dofs)
    ]
    return run_of(steps, took)


def test_slopes_are_those_of_the_powers():
    assert slope(run(-0.5)) == pytest.approx(-0.5)
    assert slope(run(-1 / 3, factor=4, count=5)) == pytest.approx(-1 / 3)


def test_what_is_needed_for_a_bound_is_interpolated_in_logarithms():
    found = run(-0.5)
    assert needed(found, 1000.0**-0.5, "dofs") == pytest.approx(1000.0)
    assert needed(found, 1.0, "dofs") == 50.0
    assert needed(found, 1e-9, "dofs") is None


def test_savings():
    adaptive, uniform = run(-0.5, count=12), run(-1 / 3, factor=4, count=6)
    row = compare(adaptive, uniform)
    bound = uniform["upper"].min()
    assert row["bound"] == bound
    assert row["fewer"] == pytest.approx(uniform["dofs"].max() / bound**-2)
    assert row["uniform_seconds"] == pytest.approx(2e-5 * uniform["dofs"].max())
    assert row["uniform_run_seconds"] == pytest.approx(2e-5 * uniform["dofs"].sum())
    assert row["faster"] < row["run_faster"]
    assert row["faster"] < row["fewer"]  # the adaptive run pays for all its steps
    assert row["effectivity"] is None
    assert compare(run(-0.5, effectivity=1.1), uniform)["effectivity"] == 1.1


def frames(adaptive, uniform):
    return {("P1", "adaptive"): adaptive, ("P1", "uniform"): uniform}


@pytest.mark.parametrize("layout", ["markdown", "latex"])
def test_the_page_says_where_it_pays(layout):
    runs = {
        "sharp": frames(run(-0.5, count=12), run(-1 / 3, factor=4, count=6)),
        "plain": frames(run(-0.5, effectivity=1.05), run(-0.5, factor=4, count=5)),
    }
    text = page(layout, runs)
    assert "pay for sharp" in text
    assert "do not pay for plain" in text
    assert "1.05" in text
    assert [row["scene"] for row in summary_rows(runs)] == ["sharp", "plain"]
