"""The examples of the docstrings of publication."""

import doctest
import importlib

import pytest

MODULES = ("compare", "keys", "notation", "published")


@pytest.mark.parametrize("name", MODULES)
def test_the_examples_of_the_docstrings_run(name):
    failed, tried = doctest.testmod(importlib.import_module(f"signorini.publication.{name}"))
    assert tried > 0
    assert failed == 0
