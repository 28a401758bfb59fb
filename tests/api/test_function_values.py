"""Functions of a program that return no proper values: refused by name, for every datum."""

import numpy as np
import pytest
import skfem

import signorini
from signorini.exceptions import FormulaError, SignoriniError
from signorini.mesh.boundary import SIDES

FIELDS = ("f", "g", "dirichlet", "obstacle", "coefficient", "contact_flux")


def nowhere(x, y):
    return np.full(x.shape, np.nan)


def on_a_part(x, y):
    return np.where(x > 0.4, np.nan, 1.0)


def infinite(x, y):
    return 1.0 / (x - x)


def negative_infinite(x, y):
    return -np.exp(1e4 + x)


def imaginary(x, y):
    return 1j * x


def real_as_complex(x, y):
    return x + 0j


def too_long(x, y):
    return np.ones(x.size + 1)


def a_column(x, y):
    return np.ones((x.size, 1, 1))


def words(x, y):
    return "one"


def nothing(x, y):
    return None


def of_one_array(x):
    return x[0]


def by_halves(x, y):
    return 1.0 if x > 0.5 else 0.0


FAULTS = {
    nowhere: "is nan at (x, y) = (",
    on_a_part: "is nan at (x, y) = (",
    infinite: "is inf at (x, y) = (",
    negative_infinite: "is -inf at (x, y) = (",
    imaginary: "is of type complex128; its values must be real",
    real_as_complex: "is of type complex128; its values must be real",
    too_long: "return an array of their shape, or a number",
    a_column: "return an array of their shape, or a number",
    words: "its values must be real",
    nothing: "returns None; is a return missing?",
    of_one_array: "write a function of two arrays, lambda x, y: ...",
    by_halves: "write it with NumPy, np.where for if",
}


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.__name__)
@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("field", FIELDS)
def test_a_function_without_proper_values_is_refused(field, element, fault):
    data = {"f": 1, "dirichlet": {"top": 0}, "contact": "bottom", "obstacle": -9}
    data[field] = {"top": fault} if field == "dirichlet" else fault
    with pytest.raises(FormulaError) as refused:
        signorini.problem(signorini.rectangle(4), element, **data)
    told = str(refused.value)
    place = "dirichlet.top" if field == "dirichlet" else field
    assert told.startswith(f"{place}: {fault.__name__}(x, y) ")
    assert FAULTS[fault] in told
    assert "\n" not in told


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        (of_one_array, "write a function of two arrays, lambda x, y: ..."),
        (nothing, "returns None; is a return missing?"),
    ],
)
@pytest.mark.parametrize("place", ["boundaries", "subdomains", "exact"])
def test_functions_that_are_no_data_are_told_the_same(place, fault, words):
    mesh = skfem.MeshTri().refined(2)
    named = {} if place == "exact" else {place: {"own": fault}}
    exact = (np.add, fault) if place == "exact" else None
    with pytest.raises(SignoriniError) as refused:
        signorini.problem(signorini.triangulation(mesh, **named), f=0, dirichlet=SIDES, exact=exact)
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)
