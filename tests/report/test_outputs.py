"""The rows of outputs.csv."""

import pytest

from builders import DATA, grid, statement
from signorini.fem.functionals import contact_length
from signorini.fem.problem import discretize_on
from signorini.report.outputs import output_rows
from signorini.scene.quantities import OPTIONS
from signorini.scene.read import scene_schema
from signorini.solvers import solve
from signorini.solvers.stored import stored


@pytest.fixture
def solved():
    problem = discretize_on(grid(8), "P1", statement(**DATA))
    return problem, stored(problem, solve(problem), 8, 0.125)


def test_a_row_for_each_quantity_in_its_own_unit(solved):
    asked = {
        "plain": {"kind": "contact_length", "unit": "m"},
        "in mm": {"kind": "contact_length", "unit": "mm", "factor": 1000},
        "none": {"kind": "critical_point", "which": 1000},
    }
    plain, scaled, none = output_rows(*solved, asked)
    length = contact_length(*solved)
    what = {"element": "P1", "n": 8, "h": 0.125}
    assert plain == what | {"name": "plain", "value": length, "unit": "m"}
    assert scaled == what | {"name": "in mm", "value": 1000 * length, "unit": "mm"}
    assert none == what | {"name": "none", "value": None, "unit": ""}


@pytest.mark.parametrize("kind", OPTIONS)
def test_every_kind_of_the_schema_has_a_value(solved, kind):
    (row,) = output_rows(*solved, {"it": {"kind": kind}})
    assert isinstance(row["value"], float)


def test_the_schema_knows_the_kinds_and_their_options():
    keys = scene_schema()["properties"]["quantities"]["additionalProperties"]["properties"]
    assert keys["kind"]["enum"] == list(OPTIONS)
    options = {key for known in OPTIONS.values() for key in known}
    assert set(keys) == {"kind", "factor", "unit"} | options
