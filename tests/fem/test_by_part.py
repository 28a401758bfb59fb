"""Data part by part: the same numbers as the formula that holds on all parts."""

from dataclasses import replace

import numpy as np
import pytest

from signorini.exceptions import SceneError
from signorini.fem.by_part import ByPart
from signorini.fem.problem import discretize
from signorini.formula import Formula
from signorini.mesh.given import from_arrays
from signorini.scene.scene import Scene
from signorini.scene.statement import ProblemStatement

SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "dirichlet"}
WHOLE = {"f": "x", "g": "where(x > 0.999, y, 0)", "dirichlet": "where(y > 0.999, x, 0)"}
DOCUMENT = {
    "domain": {"kind": "rectangle"},
    "boundary": SIDES,
    "data": WHOLE | {"obstacle": -1},
    "levels": [4],
}


def parts(field, **texts):
    return ByPart({name: Formula(text, f"{field}.{name}") for name, text in texts.items()}, field)


def statements():
    """On a grid, and on the refinement of a mesh that is given."""
    grid = Scene.from_dict(DOCUMENT).problem_statement
    mesh = from_arrays([[0, 1, 0, 1], [0, 0, 1, 1]], [[0, 1], [1, 3], [2, 2]])
    domain = {"kind": "given", "mesh": mesh, "rest": "neumann", "width": 1.0}
    return {"grid": grid, "given": ProblemStatement(domain, SIDES, grid.data, "exact")}


STATEMENTS = statements()


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("kind", STATEMENTS)
def test_the_parts_add_up_to_the_whole(kind, element):
    statement = STATEMENTS[kind]
    by_part = replace(
        statement.data,
        dirichlet=parts("dirichlet", top="x", left="0"),
        g=parts("g", right="y"),
        obstacle=parts("obstacle", bottom="-1"),
    )
    ours, theirs = (
        discretize(asked, element, 4) for asked in (replace(statement, data=by_part), statement)
    )
    for name in ("b", "lower", "fixed_values"):
        np.testing.assert_allclose(getattr(ours, name), getattr(theirs, name), rtol=0, atol=1e-15)
    assert np.ptp(ours.fixed_values) > 0.5
    assert np.abs(ours.b).max() > 0.1


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_values_that_jump_where_parts_meet_are_refused(element):
    statement = STATEMENTS["grid"]
    data = replace(statement.data, dirichlet=parts("dirichlet", top="1", left="0"))
    with pytest.raises(SceneError, match=r"dirichlet.left: 0 at \(0, 1\).* dirichlet has 1; let"):
        discretize(replace(statement, data=data), element, 4)


def test_fluxes_of_parts_that_overlap_are_refused():
    statement = STATEMENTS["given"]
    mesh = replace(statement.domain["mesh"], parts=statement.domain["mesh"].parts)
    mesh.parts["wall"] = mesh.parts["right"]
    asked = replace(
        statement,
        domain=statement.domain | {"mesh": mesh},
        boundary=SIDES | {"wall": "neumann"},
        data=replace(statement.data, g=parts("g", right="1", wall="1")),
    )
    with pytest.raises(SceneError, match=r"g.wall: shares the facet at \(1, 0.125\) with another"):
        discretize(asked, "P1", 4)
