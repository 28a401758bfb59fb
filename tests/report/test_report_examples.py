"""The examples of the docstrings of report."""

import doctest
import importlib

import pytest

MODULES = (
    "contact_side",
    "curves",
    "compare",
    "expectations",
    "macros",
    "rounding",
    "slopes",
    "table_writer",
    "tables",
)


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_the_docstrings_run(name):
    failed, tried = doctest.testmod(importlib.import_module(f"signorini.report.{name}"))
    assert tried > 0
    assert failed == 0
