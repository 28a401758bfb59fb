"""How numbers are printed: rounded once, from their exact value, as a manuscript asks."""

from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from signorini.publication.notation import Form, in_digits, in_latex, read_form

FINITE = st.floats(allow_nan=False, allow_infinity=False)


@given(value=FINITE, decimals=st.integers(0, 12))
def test_decimals_are_those_of_the_exact_value(value, decimals):
    printed = Decimal(in_digits(repr(value), Form(decimals=decimals, notation="fixed")))
    assert abs(printed - Decimal(value)) <= Decimal(5).scaleb(-decimals - 1)


@given(value=FINITE.filter(bool), digits=st.integers(1, 17))
def test_digits_are_significant_in_every_notation(value, digits):
    exact = Decimal(value)
    unit = Decimal(1).scaleb(exact.adjusted() - digits + 1)
    for notation in ("fixed", "scientific", "auto"):
        printed = Decimal(in_digits(repr(value), Form(digits=digits, notation=notation)))
        assert abs(printed - exact) <= unit / 2


@given(value=FINITE)
def test_seventeen_digits_give_the_number_back(value):
    assert float(in_digits(repr(value), Form(digits=17, notation="plain"))) == value


@pytest.mark.parametrize(
    ("text", "options", "printed"),
    [
        ("0.10075495377", "", "0.101"),
        ("9.866e-05", "", r"\ensuremath{9.87\times10^{-5}}"),
        ("64", "", "64"),
        ("123456789", "", "123456789"),
        ("123456789.5", "", r"\ensuremath{1.23\times10^{8}}"),
        ("9.866e-05", "decimals=8", r"\ensuremath{9.86600000\times10^{-5}}"),
        ("9.866e-05", "decimals=8, notation=fixed", "0.00009866"),
        ("0.25", "notation=scientific, digits=1", r"\ensuremath{2\times10^{-1}}"),
        ("0.26978", "notation=percent", "27"),
        ("0.0057724", "notation=percent", "0.58"),
        ("0.26978", "notation=percent, decimals=1", "27.0"),
        ("9.866e-05", "notation=plain", "9.87e-05"),
        ("-0.68", "decimals=2", r"\ensuremath{-0.68}"),
        ("1.4189", "digits=2", "1.4"),
        ("0.0", "", "0.00"),
        ("inf", "decimals=2", r"\ensuremath{\infty}"),
        ("-inf", "", r"\ensuremath{-\infty}"),
    ],
)
def test_the_notation_that_is_asked_for(text, options, printed):
    assert in_latex(text, read_form(options)) == printed


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("digit=3", "digit is no option; did you mean digits?"),
        ("digits=0", "digits=0 is not valid; give a whole number from 1 to 17"),
        ("digits=18", "digits=18 is not valid"),
        ("digits", "digits= is not valid"),
        ("decimals=-1", "decimals=-1 is not valid; give a whole number from 0 to 17"),
        ("notation=scientifc", "notation=scientifc is not valid; did you mean scientific?"),
        ("digits=2, decimals=2", "digits and decimals are both given; keep one"),
    ],
)
def test_an_option_that_is_none_is_refused(options, said):
    with pytest.raises(ValueError, match=r"\w") as caught:
        read_form(options)
    assert said in str(caught.value)
