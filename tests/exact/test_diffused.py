"""Exact solutions under a diffusion coefficient."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from known_solutions import grid, inside

import signorini
from signorini.errors.exact import ExactErrors
from signorini.exact import Diffused, FormulaSolution, derived_data, read_exact, with_coefficient
from signorini.exact.check import check_data
from signorini.exact.samples import Samples
from signorini.exceptions import FormulaError, SceneError
from signorini.fem.data import BySubdomain
from signorini.fem.problem import discretize
from signorini.formula import Formula
from signorini.scene.statement import ProblemStatement
from signorini.solvers import solve

EPS = np.finfo(float).eps
MAPPING = {
    "domain": {"origin": [0, 0], "size": [1, 1], "diagonal": "falling", "cells": "per-side"},
    "boundary": {
        "bottom": "contact",
        "right": "neumann",
        "top": "dirichlet",
        "left": "neumann",
    },
    "load_quadrature": "exact",
    "truth": {"kind": "exact", "u": "1 + sin(x)*y**2"},
}


@pytest.mark.parametrize("one", [1, 1.0, "1", "1.0", "1e0", "2/2", "cos(0)", "(1)"])
def test_a_coefficient_of_one_leaves_the_solution_as_it_is_however_written(one):
    exact = FormulaSolution(Formula("x"))
    assert with_coefficient(exact, Formula(one)) is exact
    assert isinstance(read_exact({"u": "x"}, Formula(one)), FormulaSolution)
    statement = ProblemStatement.from_mapping(MAPPING | {"data": {"coefficient": one}})
    assert isinstance(statement.exact, FormulaSolution)
    statement.check()


def test_no_coefficient_is_one():
    exact = FormulaSolution(Formula("x"))
    assert with_coefficient(exact, None) is exact
    assert isinstance(ProblemStatement.from_mapping(MAPPING | {"data": {}}).exact, FormulaSolution)


@pytest.mark.parametrize("text", ["2", "1 + x", "where(x < 0, 1, 1)"])
def test_another_coefficient_is_kept(text):
    exact = with_coefficient(FormulaSolution(Formula("x")), Formula(text))
    assert isinstance(exact, Diffused)
    assert derived_data(exact).coefficient == Formula(text)


def test_coefficients_that_no_truth_has_are_refused():
    exact = FormulaSolution(Formula("x"))
    by_subdomain = BySubdomain({"steel": 1.0}, "data.coefficient")
    with pytest.raises(SceneError, match=r"data\.coefficient: an exact truth needs a formula"):
        with_coefficient(exact, by_subdomain)
    with pytest.raises(SceneError, match=r"data\.coefficient: an exact truth needs a formula"):
        ProblemStatement.from_mapping(MAPPING | {"data": {"coefficient": {"steel": 1.0}}})
    with pytest.raises(FormulaError, match=r"data\.coefficient: value is inf"):
        with_coefficient(exact, Formula("1/0", "data.coefficient"))


@pytest.mark.parametrize("coefficient", ["1", "1.0", "1 + x*y"])
def test_reading_a_truth_with_a_coefficient_imports_no_numpy(coefficient):
    mapping = MAPPING | {"data": {"coefficient": coefficient}}
    code = (
        "import sys\n"
        "from signorini.scene.statement import ProblemStatement\n"
        f"ProblemStatement.from_mapping({mapping})\n"
        "sys.exit('numpy' in sys.modules)"
    )
    source = Path(signorini.__file__).parents[1]
    environment = os.environ | {"PYTHONPATH": str(source)}
    done = subprocess.run([sys.executable, "-c", code], check=False, env=environment)
    assert done.returncode == 0


def test_flux_may_be_continuous_where_the_coefficient_jumps():
    exact = read_exact({"u": "where(x < 0, 2*x, x)"}, Formula("where(x < 0, 1, 2)"))
    assert isinstance(exact, Diffused)
    check_data(exact, replace(derived_data(exact), obstacle=Formula("-2")), Samples.of(grid()))
    assert isinstance(read_exact({"u": "x"}, Formula("1")), FormulaSolution)


def test_load_under_a_coefficient_that_varies():
    """k = 1 + xy, u = x + y**2: f = -div(k grad u) = -(y + 2 (1 + xy) + 2 xy)."""
    exact, (x, y) = read_exact({"u": "x + y**2"}, Formula("1 + x*y")), inside()
    np.testing.assert_allclose(exact.load(x, y), -(y + 2 * (1 + x * y) + 2 * x * y), rtol=4 * EPS)


@pytest.mark.parametrize("element", ["P1", "CR"])
def test_rates_under_a_coefficient_that_varies(element):
    statement = ProblemStatement.from_mapping(MAPPING | {"data": {"coefficient": "1 + x*y"}})
    errors = []
    for n in (8, 16, 32):
        problem = discretize(statement, element, n)
        errors.append(
            ExactErrors(statement.exact, ["l2"]).of(problem.mesh, element, solve(problem).u)["l2"]
        )
    np.testing.assert_allclose(np.log2(errors[0] / errors[1]), 2, atol=0.1)
    np.testing.assert_allclose(np.log2(errors[1] / errors[2]), 2, atol=0.05)
