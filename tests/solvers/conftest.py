"""Problems of every kind of mesh, element and route."""

import pytest

from builders import DATA, PAPER, delaunay, grid, perturbed, statement
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize_on
from signorini.solvers import METHODS

MESHES = {
    "falling grid": lambda labels=PAPER: grid(8, labels=labels),
    "rising grid": lambda labels=PAPER: grid(8, labels=labels, diagonal="rising"),
    "delaunay": lambda labels=PAPER: delaunay(0, labels=labels),
    "perturbed": lambda labels=PAPER: perturbed(6, labels=labels),
}


@pytest.fixture(params=ELEMENTS)
def element(request):
    return request.param


@pytest.fixture(params=MESHES)
def mesh_of(request):
    return MESHES[request.param]


@pytest.fixture
def problem(mesh_of, element):
    return discretize_on(mesh_of(), element, statement(**DATA))


@pytest.fixture(params=METHODS)
def method(request):
    return request.param
