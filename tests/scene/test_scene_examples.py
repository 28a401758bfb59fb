"""The examples of the docstrings of scene."""

import doctest
import importlib

import pytest


@pytest.mark.parametrize(
    "name", ["scene.read", "scene.scene", "scene.schema", "scene.statement", "wording"]
)
def test_the_examples_of_the_docstrings_run(name):
    module = importlib.import_module(f"signorini.{name}")
    failed, tried = doctest.testmod(module, optionflags=doctest.ELLIPSIS)
    assert tried > 0
    assert failed == 0
