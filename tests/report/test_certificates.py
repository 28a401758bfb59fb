"""The table of certificates."""

from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from signorini.report.certificates import certificate_table, outward
from signorini.report.table_latex import latex
from signorini.report.table_writer import markdown


@given(st.floats(-1e6, 1e6, allow_subnormal=False))
def test_rounding_is_outward_and_by_less_than_the_last_digit(value):
    low, high = (Decimal(outward(value, way)) for way in (ROUND_FLOOR, ROUND_CEILING))
    assert low <= Decimal(value) <= high
    assert high - low <= abs(Decimal(value)) * Decimal("1.01e-4")


def test_small_numbers_have_exponents():
    assert outward(1.23456789e-7, ROUND_CEILING) == "1.2346e-7"


@pytest.mark.parametrize("value", [None, ""])
def test_what_is_not_there_is_a_dash(value):
    assert outward(value, ROUND_FLOOR) == "--"


ROWS = [
    {"element": element, "n": n, "lower": 0.5 / n, "upper": 0.6 / n, "dual": -2, "primal": -1}
    for element in ("P1", "CR")
    for n in (16, 8)
]


def test_levels_increase_and_every_element_has_its_interval():
    lines = markdown(certificate_table(ROWS)).splitlines()
    assert lines[0] == "| N | CF from | CF to | NCF from | NCF to | energy from | energy to |"
    assert lines[2].startswith("| 8 | 0.062500 | 0.07")
    assert lines[3].startswith("| 16 | 0.031250 | 0.0375")


def test_one_element_alone():
    lines = markdown(certificate_table(ROWS[:2])).splitlines()
    assert lines[0] == "| N | CF from | CF to | energy from | energy to |"


@pytest.mark.parametrize("write", [markdown, latex])
def test_it_says_of_what_the_intervals_are(write):
    text = write(certificate_table(ROWS))
    assert "the energy norm of the error of the discrete solution" in text
    assert "against the solution of the continuous problem" in text
