"""The examples of the docstrings in `signorini.fem`."""

import doctest
import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    "module",
    [
        "signorini.fem.elements",
        "signorini.fem.function",
        "signorini.fem.problem",
        "signorini.fem.quadrature",
        "signorini.fem.residual",
        "signorini.fem.stencil",
    ],
)
def test_the_examples_run(module, monkeypatch):
    monkeypatch.chdir(ROOT)
    failed, tried = doctest.testmod(importlib.import_module(module))
    assert tried > 0
    assert failed == 0
