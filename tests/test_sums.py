"""Sums of floats are `math.fsum` or NumPy's.

From Python 3.12 on, the built-in `sum` of floats is compensated: its last bits are not those of
Python 3.11.
"""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "src/signorini"
# What no float can come of: `sum` of these counts.
COUNTING = (ast.Compare, ast.Not)
COUNTERS = {"len", "bool", "isinstance", "_is_met", "_bytes"}
WHOLE = {"size", "nbytes", "st_size"}
VERDICTS = ("['ok']", "['met']")
# The others, a number per file: of counts and whole numbers, and of arrays, which NumPy adds.
KNOWN = {
    "certificate/coarse.py": 1,
    "commands/forecast.py": 1,
    "errors/contact.py": 1,
    "errors/local.py": 1,
    "errors/overlay.py": 1,
    "errors/pieces.py": 1,
    "errors/projection.py": 1,
    "errors/reference.py": 1,
    "report/document.py": 1,
    "solvers/contact.py": 1,
    "storage/arrays.py": 1,
    "studies/benchmark/report.py": 2,
    "studies/sensitivity/chance.py": 1,
    "studies/sensitivity/sixth_choice.py": 2,
    "studies/stability/claims.py": 3,
    "studies/theory/exact_parts.py": 2,
    "sweeps/jobs.py": 1,
}


def sums(text):
    """Every call of the built-in `sum` in a text."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "sum":
            yield node


def is_count(call):
    """Whether a sum counts, by its form alone."""
    asked = call.args[0]
    if isinstance(asked, ast.GeneratorExp):
        each = asked.elt
        called = getattr(getattr(each, "func", None), "id", "")
        is_whole = called in COUNTERS or getattr(each, "attr", "") in WHOLE
        is_whole = is_whole or ast.unparse(each).endswith(VERDICTS)
        return is_whole or isinstance(getattr(each, "op", each), COUNTING)
    of_map = isinstance(asked, ast.Call) and getattr(asked.func, "id", "") == "map"
    return of_map and getattr(asked.args[0], "id", "") in COUNTERS


def others(path):
    """The sums of a file that are no counts by their form."""
    return [call for call in sums(path.read_text(encoding="utf-8")) if not is_count(call)]


def test_sums_of_floats_are_not_the_built_in():
    """A new one: `math.fsum`, or NumPy's, or, where it adds whole numbers or arrays, the table."""
    paths = {str(path.relative_to(PACKAGE)): path for path in PACKAGE.rglob("*.py")}
    found = {name: len(others(path)) for name, path in paths.items()}
    assert {name: count for name, count in found.items() if count} == KNOWN


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        ("sum(x == y for x in z)", True),
        ("sum(not x for x in z)", True),
        ("sum(map(len, z))", True),
        ("sum(x.size for x in z)", True),
        ("sum(squares)", False),
        ("sum(x.length for x in z)", False),
        ("sum(map(area, z))", False),
    ],
)
def test_a_count_is_told_from_a_sum_that_may_be_of_floats(text, counts):
    (call,) = sums(text)
    assert is_count(call) == counts
