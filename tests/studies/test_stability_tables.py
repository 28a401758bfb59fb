"""What the stability suite makes of its rows: success, statuses, estimates, claims, digits."""

import numpy as np
import pytest

from signorini.errors.norms import PARTS_OF_H1
from signorini.studies.stability import summaries
from signorini.studies.stability.claims import claims
from signorini.studies.stability.parts import (
    digits_by_cell,
    error_pairs,
    frame,
    profiles_of,
    shares,
    title,
    titles,
)
from signorini.studies.stability.verdicts import answered, estimated


def rows(solver="ours", **values):
    base = {
        "family": "needles",
        "load": "white",
        "element": "CR",
        "seed": 0,
        "solver": solver,
        "claimed": 1,
        "residual": 1e-16,
    }
    base |= {
        "seconds": 0.01,
        "iterations": 2,
        "status": "solved",
        "accuracy": 1e-15,
        "error": 1e-15,
    }
    base |= {
        "multiplier_accuracy": 1e-15,
        "multiplier_error": 1e-15,
        "wrong_side": 0,
        "undecided": 0,
        "needless": 0,
    }
    return (
        base
        | {
            "limit": 1e-15,
            "multiplier_limit": 1e-15,
            "floor": 1e-15,
            "multiplier_floor": 1e-15,
            "rounded_residual": 1e-16,
        }
        | values
    )


def refused(solver="ours/direct", **values):
    empty = dict.fromkeys(
        ("accuracy", "multiplier_accuracy", "error", "multiplier_error", "wrong_side", "undecided")
    )
    return rows(
        solver, claimed=0, status="refused", residual=np.inf, needless=None, **empty | values
    )


def test_success_is_claimed_and_true():
    found = [
        rows(),
        rows(residual=1e-8),
        rows(residual=1e-3),
        rows(claimed=0),
        rows(residual=np.inf, claimed=0),
    ]
    (row,) = summaries.solvers(frame(found), time_limit=1.0)
    assert (row["problems"], row["solved_1e-06"], row["solved_1e-09"]) == (5, 0.4, 0.2)
    assert (row["wrong"], row["unclaimed"]) == (1, 1)
    shift = summaries.SHIFT
    spent = np.exp(np.mean(np.log([0.01 + shift, *[1.0 + shift] * 4]))) - shift
    assert row["seconds"] == pytest.approx(spent, rel=1e-12)


def test_loads_of_another_size_are_left_out_of_the_ordinary():
    found = frame([rows(), rows(load="tiny", residual=1.0)])
    (row,) = summaries.solvers(found, time_limit=1.0)
    assert (row["solved_1e-09"], row["ordinary_1e-09"]) == (0.5, 1.0)


def test_an_answer_called_inaccurate_is_no_wrong_claim():
    found = [rows(residual=1e-3, status=status) for status in ("solved", "inaccurate")]
    (row,) = summaries.solvers(frame(found), 1.0)
    assert (row["wrong"], row["warned"], row["solved_1e-06"]) == (1, 1, 0.0)


def test_a_status_better_than_the_error_is_wrong():
    found = [
        rows("ours/direct", error=2e-10),
        rows("ours/direct"),
        rows("ours/direct", error=np.nan),
        rows("ours/direct", multiplier_error=2e-10),
        rows("ours/direct", wrong_side=2),
        rows("ours/direct", status="inaccurate", error=1e-4, accuracy=1e-3, limit=1e-4),
        rows(
            "ours/direct", status="inaccurate", error=1e-14, accuracy=1e-9, undecided=3, needless=1
        ),
        rows("ours/direct", status="inaccurate", error=1e-14, accuracy=1e-9),
        refused(limit=1.0),
        refused(limit=1e-4),
    ]
    (row,) = summaries.statuses(frame(found))
    assert (row["solutions"], row["solved"], row["wrong"], row["inaccurate"], row["needed"]) == (
        10,
        5,
        4,
        3,
        1,
    )
    assert (row["refused"], row["unneeded"]) == (2, 2)
    assert (row["wrong_side"], row["undecided"], row["needless"]) == (2, 3, 1)
    assert row["solved_multiplier_error"] == 2e-10


@pytest.mark.parametrize(
    ("row", "right"),
    [
        (rows(), True),
        (rows(residual=1e-8), False),
        (rows(status="inaccurate", accuracy=1e-9), False),
        (rows(status="inaccurate", accuracy=1e-9, limit=1e-12), True),
        (rows(status="inaccurate", accuracy=1e-9, multiplier_limit=1e-12), False),
        (rows(status="inaccurate", multiplier_accuracy=1e-9), False),
        (rows(status="inaccurate", multiplier_accuracy=1e-9, multiplier_limit=1e-12), True),
        (rows(status="inaccurate", accuracy=1e-9, limit=1e-12, residual=1e-8), False),
        (
            rows(
                status="inaccurate", accuracy=1e-9, limit=1e-7, residual=1e-8, rounded_residual=1e-8
            ),
            True,
        ),
        (rows(status="inaccurate", accuracy=1e-9, limit=np.nan), False),
        (refused(limit=1e-3), False),
        (refused(limit=0.1), True),
        (refused(limit=np.nan), False),
    ],
)
def test_less_than_solved_is_right_only_where_double_precision_cannot(row, right):
    assert answered(frame([row])).item() is right


@pytest.mark.parametrize(
    ("accuracy", "error", "right"),
    [
        (1e-12, 1e-12, True),
        (1e-13, 1e-12, True),
        (0.9e-13, 1e-12, False),
        (1e-9, 1e-12, True),
        (1.1e-9, 1e-12, False),
        (0.0, 0.0, True),
        (0.0, 1e-17, False),
        (1e-12, 0.0, True),
        (1.1e-12, 0.0, False),
        (1e-12, np.nan, False),
        (np.nan, 1e-12, False),
    ],
)
@pytest.mark.parametrize("which", ["", "multiplier_"])
def test_an_estimate_is_within_a_tenth_and_a_thousand(which, accuracy, error, right):
    row = rows("ours/direct", **{f"{which}accuracy": accuracy, f"{which}error": error})
    assert estimated(frame([row]), which).item() is right
    (found,) = summaries.estimates(frame([row, refused()]))
    other = "multiplier_" if not which else ""
    assert (found[f"{which}missed"], found[f"{other}missed"], found["answers"]) == (
        int(not right),
        0,
        1,
    )


def test_estimates_are_those_of_the_answers():
    found = [
        rows("ours/direct", accuracy=a, error=e)
        for a, e in ((1e-9, 1e-10), (1e-9, 1e-9), (1e-9, 1e-8))
    ]
    (row,) = summaries.estimates(frame(found))
    assert (row["least"], row["median"], row["most"], row["missed"]) == pytest.approx(
        (0.1, 1, 10, 0)
    )
    assert error_pairs(frame(found))["u"][0] == (1e-10, 1e-9, True)


def test_a_claim_that_is_not_met_says_so():
    extremes = {
        "scaling": [{"power": 900, "different": 1}],
        "sizes": [{"value": 1e9, "change": 1e-3}],
        "offsets": [
            {"value": 1e4, "change": 1.0, "refused": ""},
            {"value": 1e14, "change": None, "refused": "no"},
        ],
        "critical-points": [{"critical_points": 9, "residual": 1.0}],
        "contact-sets": [{"active": 1, "expected": 0, "iterations": 1}],
        "walk": [
            {"status": "refused", "stored": 0.0},
            {"status": "solved", "stored": 0.0, "difference": 1.0, "condition": 1.0},
        ],
    }
    extremes = {kind: frame(found) for kind, found in extremes.items()}
    lie = rows(residual=1.0, error=1.0, multiplier_error=1.0)
    found = claims(frame([lie]), [{"wrong": 1, "wrong_side": 1}], [{"digits": 10.9}], extremes)
    assert len(found) == 15
    assert not any(row["met"] for row in found)


def test_digits_are_those_that_no_variant_changes():
    key = {"element": "P1", "n": 2, "norm": "l2"}
    base = key | {"variant": "auto", "value": 1.0}
    found = [
        base,
        *(base | {"variant": v, "value": x} for v, x in (("a", 1 + 1e-9), ("b", 1 - 1e-7))),
    ]
    (row,) = summaries.digits(frame(found))
    assert (row["digits_a"], row["digits_b"], row["digits"]) == pytest.approx((9, 7, 7), abs=1e-6)
    (row,) = summaries.digits(frame([base, base | {"variant": "a"}]))
    assert row["digits"] == pytest.approx(-np.log10(2.0**-52))


def test_growth_and_crossings_are_those_of_powers():
    levels = [4, 8, 16, 32]
    table = [{"element": "P1", "n": n, "condition": 3.0 * n**2} for n in levels]
    assert summaries.growth(frame(table), "condition")["P1"] == pytest.approx((2, 3))
    errors = [
        {
            "family": family,
            "element": "P1",
            "n": n,
            **dict.fromkeys(PARTS_OF_H1, value(n)),
        }
        for family, value in {"smooth": lambda n: n**-2.0, "patch": lambda n: 1e-16 * n}.items()
        for n in levels
    ]
    for row in summaries.crossings(frame(errors)):
        assert row["order"] == pytest.approx(2)
        assert row["h"] == pytest.approx(1e-16 ** (1 / 3))


def test_figures_show_shares_and_digits():
    found = [
        rows(),
        rows("ours/direct", error=1e-9),
        rows("osqp", residual=1.0),
        rows("osqp", load="smooth"),
    ]
    found = frame(found)
    assert digits_by_cell(found)["CR", "needles", "white"] == pytest.approx((9, 1))
    assert shares(found, "load")["osqp", "white"] == 0
    assert shares(found, "family")["osqp", "needles"] == 0.5
    drawn = profiles_of(found)  # of the two problems both solvers were given one, which osqp missed
    assert list(drawn) == ["signorini", "OSQP"]
    assert [list(map(list, steps)) for steps in drawn.values()] == [[[1.0], [1.0]], [[1.0], [0.0]]]
    assert list(titles(found)) == ["ours", "ours/direct", "osqp"]
    assert [title(name) for name in ("ours", "ours/direct", "osqp")] == [
        "signorini",
        "signorini direct",
        "OSQP",
    ]


def test_a_floor_of_zero_has_neither_growth_nor_crossing():
    errors = [
        {"family": family, "element": "P1", "n": n, "l2": error * n**-2.0, "h1_semi": error / n}
        for family, error in (("smooth", 1.0), ("patch", 0.0))
        for n in (2, 4, 8, 16)
    ]
    for row in summaries.crossings(frame(errors)):
        assert (row["floor"], row["floor_order"], row["h"]) == (0.0, None, None)
    flat = frame([{"element": "P1", "error": 0.0, "aspect": 1e-2}])
    assert summaries.growth(flat, "error", by="aspect") == {}
