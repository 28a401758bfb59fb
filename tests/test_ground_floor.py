"""The examples of the docstrings in the modules that every room stands on."""

import doctest
import importlib

import pytest


@pytest.mark.parametrize("name", ["chunks", "memory", "wording", "work"])
def test_the_examples_run(name):
    failed, tried = doctest.testmod(importlib.import_module(f"signorini.{name}"))
    assert tried > 0
    assert failed == 0
