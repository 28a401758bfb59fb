"""Grids that are held beside their contact side, and problems with exact solutions on them."""

from dataclasses import replace

import numpy as np
import pytest

from signorini.exact import derived_data
from signorini.fem.elements import find_element
from signorini.fem.problem import discretize_on
from signorini.formula import Formula
from signorini.mesh.grid import Grid
from signorini.scene.statement import ProblemStatement

HELD = ("contact", "dirichlet", "dirichlet", "dirichlet")
FREE = ("contact", "neumann", "dirichlet", "neumann")
ZERO = Formula("0", "data.g")
elements = pytest.mark.parametrize("element", ["P1", "CR"])


def grid(nx, ny=None, origin=(-1 / 3, 0.0), size=(1.0, 1.0), labels=HELD, diagonal="falling"):
    return Grid(nx, ny or nx, origin, size, diagonal, labels)


def nodes(mesh, element):
    kind = find_element(element)
    return kind.nodes(mesh, np.arange(kind.size(mesh)))


def problem_of(exact, mesh, element):
    """The problem that `exact` solves, with Dirichlet data on every side but the contact side."""
    data = replace(derived_data(exact), g=ZERO)
    return discretize_on(mesh, element, ProblemStatement({}, {}, data, 5))
