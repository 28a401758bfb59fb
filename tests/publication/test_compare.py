"""Published numbers against computed ones."""

import csv
from decimal import Decimal
from pathlib import Path

import pytest

from signorini.exceptions import SignoriniError
from signorini.publication.compare import check_summary, compare, verdict
from signorini.publication.published import Published, read_published

ROOT = Path(__file__).parents[2]
PUBLISHED = list(read_published(ROOT / "config/published/table_5_1.csv").values())


def computed(shift="0"):
    """Numbers equal to the published ones, the first one shifted by units of its last digit."""
    numbers = {number.key: number.value for number in PUBLISHED}
    first = PUBLISHED[0]
    return numbers | {first.key: str(Decimal(first.value) + Decimal(shift) * first.unit)}


def test_there_are_24_errors_and_4_slopes():
    assert sum(not number.is_slope for number in PUBLISHED) == 24
    assert sum(number.is_slope for number in PUBLISHED) == 4


def test_the_published_numbers_are_those_of_the_table():
    """The file of the check and the printed table, entry by entry."""
    printed = csv.DictReader((ROOT / "tests/data/table_5_1.csv").read_text().splitlines())
    values = {number.key: number.value for number in PUBLISHED}
    for row in printed:
        for norm in ("l2", "h1"):
            for element, tag in (("P1", "cf"), ("CR", "ncf")):
                assert values[f"{norm}, {element}, {row['n']}"] == row[f"{norm}_{tag}"]


def test_numbers_that_are_met_are_counted():
    rows = compare(PUBLISHED, computed())
    assert [row["ok"] for row in rows] == [1] * 28
    assert {row["units"] for row in rows} == {"0.000"}
    assert verdict(rows, "check.csv").startswith(
        "all 28 published numbers met, 24 of 24 errors to the last printed digit"
    )


def test_slopes_alone_say_nothing_of_errors():
    slopes = [number for number in PUBLISHED if number.is_slope]
    said = verdict(compare(slopes, computed()), "check.csv")
    assert said.startswith("all 4 published numbers met; largest distance 0.000 units")


@pytest.mark.parametrize(
    ("shift", "units", "ok", "exact"),
    [
        ("0.4", "0.400", 1, 24),
        ("-0.5", "-0.500", 1, 24),
        ("0.6", "0.600", 1, 23),
        ("1", "1.000", 1, 23),
        ("-1.01", "-1.010", 0, None),
    ],
)
def test_distances_are_in_units_of_the_last_digit(shift, units, ok, exact):
    rows = compare(PUBLISHED, computed(shift))
    assert (rows[0]["units"], rows[0]["ok"]) == (units, ok)
    if ok:
        assert f"{exact} of 24 errors" in verdict(rows, "check.csv")


@pytest.mark.parametrize(
    ("value", "computed", "units"),
    [
        ("1.3e-4", "1.34e-4", "0.400"),
        ("2E3", "2400", "0.400"),
        ("-0.250", "-0.2504", "-0.400"),
        ("17", "17.4", "0.400"),
    ],
)
def test_the_unit_is_that_of_the_digits_as_printed(value, computed, units):
    (row,) = compare([Published("l2", "CR", "4", value, "1")], {"l2, CR, 4": computed})
    assert row["units"] == units


def test_the_largest_distance_is_named():
    assert "largest distance 0.700 units of the last digit (l2 P1 n=2)" in verdict(
        compare(PUBLISHED, computed("0.7")), "check.csv"
    )


def test_a_number_that_is_missed_is_named_with_its_distance():
    rows = compare(PUBLISHED, computed("2.5"))
    with pytest.raises(SignoriniError) as error:
        verdict(rows, "results/check.csv")
    assert str(error.value) == (
        "results/check.csv: 1 of 28 published numbers not met: "
        "l2 P1 n=2: published 0.10075495, computed 0.100754975, 2.500 units off; "
        "change the scene, or what was typed wrong, or allow a larger tolerance there"
    )


def test_a_table_read_from_a_file_gets_the_same_verdict():
    """Where every entry is text."""
    for shift in ("0.7", "2.5"):
        rows = compare(PUBLISHED, computed(shift))
        as_text = [{key: str(value) for key, value in row.items()} for row in rows]
        answers = []
        for table in (rows, as_text):
            try:
                answers.append(verdict(table, "x"))
            except SignoriniError as error:
                answers.append(str(error))
        assert answers[0] == answers[1]


@pytest.mark.parametrize("key", ["h1, P1, 2", "slope, l2, CR"])
def test_a_number_that_was_not_computed_is_named(key):
    numbers = computed()
    del numbers[key]
    with pytest.raises(
        SignoriniError, match="was not computed; restore levels, elements and norms"
    ):
        compare(PUBLISHED, numbers)


def test_check_summary_counts():
    rows = [
        {"cell": "a", "units": "0.5", "ok": "True"},
        {"cell": "b", "units": "-0.68", "ok": "True"},
        {"cell": "c", "units": 0.0, "ok": True},
        {"cell": "d", "units": "-7.25", "ok": "False"},
    ]
    summary = check_summary(rows)
    assert (summary.total, summary.matched, summary.exact) == (4, 3, 2)
    assert (summary.largest, summary.largest_cell) == (7.25, "d")
    assert str(summary).startswith("3 of 4 published numbers matched, 2 of them in every digit")


def test_check_summary_of_nothing_is_refused():
    with pytest.raises(ValueError, match="no published number"):
        check_summary([])


@pytest.mark.parametrize("computed", ["nan", "-inf", "=1+1", "1,5"])
def test_what_is_no_number_is_named(computed):
    number = PUBLISHED[0]
    with pytest.raises(SignoriniError, match=r"check: .* is no number; delete the table"):
        compare([number], {number.key: computed})
