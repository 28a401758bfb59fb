"""Callables as data: the same numbers as the formula that says the same, or one line."""

from dataclasses import replace

import numpy as np
import pytest

from builders import PAPER
from signorini.exceptions import FormulaError
from signorini.fem.function import Function
from signorini.fem.problem import discretize
from signorini.mesh.boundary import SIDES
from signorini.scene.scene import Scene

DOCUMENT = {
    "domain": {"kind": "rectangle"},
    "boundary": dict(zip(SIDES, PAPER, strict=True)),
    "data": {
        "f": "x*y",
        "g": "x + 2*y",
        "dirichlet": "3*x",
        "obstacle": "x - y",
        "coefficient": "1 + x",
    },
    "levels": [4],
}
AS_FUNCTIONS = {
    "f": lambda x, y: x * y,
    "g": lambda x, y: x + 2 * y,
    "dirichlet": lambda x, y: 3 * x,
    "obstacle": lambda x, y: x - y,
    "coefficient": lambda x, y: 1 + x,
}


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("diagonal", ["falling", "criss-cross"])
def test_a_function_gives_the_numbers_of_its_formula(element, diagonal):
    domain = {"kind": "rectangle", "diagonal": diagonal}
    statement = Scene.from_dict(DOCUMENT | {"domain": domain}).problem_statement
    functions = {name: Function(own, name) for name, own in AS_FUNCTIONS.items()}
    changed = replace(statement, data=replace(statement.data, **functions))
    ours, theirs = (discretize(asked, element, 4) for asked in (changed, statement))
    for name in ("b", "lower", "fixed_values", "coefficient"):
        np.testing.assert_allclose(getattr(ours, name), getattr(theirs, name), rtol=0, atol=1e-15)


def test_a_constant_and_a_value_of_one_axis_are_broadcast():
    x, y = np.linspace(0.0, 1.0, 3), np.linspace(0.0, 1.0, 2)[:, None]
    assert Function(lambda x, y: 2)(x, y).tolist() == [[2.0] * 3] * 2
    assert Function(lambda x, y: x)(x, y).shape == (2, 3)


def test_a_function_that_writes_into_its_arguments_changes_nothing():
    def negative(x, y):
        x *= -1.0
        return x

    x = np.array([1.0, 2.0])
    assert Function(negative)(x, x).tolist() == [-1.0, -2.0]
    assert x.tolist() == [1.0, 2.0]


def pole(x, y):
    return 1.0 / (x - 0.5)


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (pole, ["f: pole(x, y) is inf at (x, y) = (0.5, 1.0)", "finite"]),
        (lambda x, y: np.sqrt(x - 1.0), ["is nan at (x, y) = (0.0, 0.0)"]),
        (lambda x, y: 1j * x, ["complex128", "real"]),
        (lambda x, y: np.zeros(2), ["shape (2,)", "shape (3,)"]),
        (lambda x, y: x if x > 0 else y, ["ValueError", "np.where"]),
        (lambda x: x, ["TypeError", "lambda x, y: ..."]),
        (lambda x, y: {}[0], ["KeyError", "NumPy"]),
        (lambda x, y: "many", ["<U4", "real"]),
        (lambda x, y: None, ["returns None", "return missing?"]),
    ],
)
def test_what_a_function_can_do_wrong_is_told_in_one_line(function, words):
    with pytest.raises(FormulaError) as caught:
        Function(function, "f")(np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, 1.0]))
    message = str(caught.value)
    assert "\n" not in message
    assert [word for word in words if word not in message] == []
