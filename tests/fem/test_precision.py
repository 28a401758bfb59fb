"""Loads in single precision: against NumPy, on every route, and not where not asked for."""

from dataclasses import replace

import numpy as np
import pytest

from builders import DATA, delaunay, grid, statement
from signorini import solve
from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.load import assemble_contact_load, assemble_load
from signorini.fem.precision import LOAD_PRECISIONS, to_single
from signorini.fem.problem import discretize_on
from signorini.formula import Formula

SINGLE = LOAD_PRECISIONS["single"]
ZERO = Formula("0")
PAPER_LOAD = "2*pi*sin(2*pi*x)"
UNIT = 2.0**-24  # the largest relative rounding error


def test_to_single_is_what_numpy_rounds_to():
    values = np.random.default_rng(1).normal(size=10_000)
    values = np.concatenate([values, [0.0, 1.0, 1.0 + UNIT, 1.0 + 3 * UNIT, -2.0 + UNIT]])
    np.testing.assert_array_equal(to_single(values), values.astype(np.float32))


@pytest.mark.parametrize("power", [-900, -140, 140, 900])
def test_to_single_keeps_24_bits_at_every_size(power):
    values = np.random.default_rng(2).normal(size=100)
    scaled = to_single(np.ldexp(values, power))
    np.testing.assert_array_equal(scaled, np.ldexp(to_single(values), power))


def in_numpys_single(mesh, kind):
    """f at the centroid, and area f / 3, by arithmetic of single precision; the sums in double."""
    x = mesh.p[0][mesh.t].mean(axis=0)
    f = (2 * np.pi * np.sin(2 * np.pi * x)).astype(np.float32)
    area = np.float32(0.5 / mesh.nx**2)  # a power of two: the product with f is exact
    share = (area * f / np.float32(3)).astype(float)
    b = np.zeros(kind.size(mesh))
    for dofs in kind.triangle_dofs(mesh):
        np.add.at(b, dofs, share)
    return b


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("n", [2, 8, 64])
def test_the_load_is_that_of_single_precision(element, n):
    mesh, kind = grid(n), find_element(element)
    expected = in_numpys_single(mesh, kind)
    found = assemble_load(mesh, kind, Formula(PAPER_LOAD), ZERO, "centroid", SINGLE)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15 * np.abs(expected).max())
    in_double = assemble_load(mesh, kind, Formula(PAPER_LOAD), ZERO, "centroid")
    assert np.abs(found - in_double).max() > 1e-9 * np.abs(expected).max()


@pytest.mark.parametrize("element", ELEMENTS)
@pytest.mark.parametrize("mesh", [grid(6, 5), delaunay(0)], ids=["grid", "delaunay"])
@pytest.mark.parametrize("rule", ["centroid", "vertices", 4, "nodal"])
def test_every_part_of_a_load_is_rounded_and_nothing_more(element, mesh, rule):
    """Of a positive f each share is off by two roundings, so by 2**-23 of the sum of its dof."""
    kind, f = find_element(element), Formula("2 + sin(3*x + y)")
    single, double = (assemble_load(mesh, kind, f, ZERO, rule, p) for p in LOAD_PRECISIONS.values())
    size = assemble_load(mesh, find_element("P1"), f, ZERO, rule).max() * 6
    assert 0 < np.abs(single - double).max() <= 2 * UNIT * size


@pytest.mark.parametrize("element", ELEMENTS)
def test_fluxes_are_rounded_too(element):
    mesh, kind, flux = grid(4), find_element(element), Formula("1 + x*y/3")
    fluxes = [
        (assemble_load(mesh, kind, ZERO, flux, "exact", precision),
         assemble_contact_load(mesh, kind, flux, precision))
        for precision in LOAD_PRECISIONS.values()
    ]  # fmt: skip
    for in_double, in_single in zip(*fluxes, strict=True):
        assert 0 < np.abs(in_single - in_double).max() <= 4 * UNIT * np.abs(in_double).max()


@pytest.mark.parametrize("element", ELEMENTS)
def test_double_is_the_default_to_the_byte(element):
    asked = statement(**DATA, contact_flux="x")
    problems = [
        discretize_on(mesh, element, given)
        for mesh in (grid(5), delaunay(1))
        for given in (asked, replace(asked, load_precision="double"))
    ]
    for plain, double in (problems[:2], problems[2:]):
        assert plain.b.tobytes() == double.b.tobytes()
        assert plain.contact_load.tobytes() == double.contact_load.tobytes()


@pytest.mark.parametrize("element", ELEMENTS)
def test_every_route_solves_with_the_load_of_single_precision(element):
    """They agree to round-off; from the solution with the load of double they are far."""
    asked = statement(f=PAPER_LOAD, load_quadrature="centroid")
    mesh = grid(32)
    double, single = (
        discretize_on(mesh, element, replace(asked, load_precision=name))
        for name in LOAD_PRECISIONS
    )
    found = {name: solve(single, name).u for name in ("fourier", "direct", "multigrid")}
    for u in found.values():
        np.testing.assert_allclose(u, found["fourier"], rtol=0, atol=1e-13)
    assert np.abs(found["fourier"] - solve(double).u).max() > 1e-10
