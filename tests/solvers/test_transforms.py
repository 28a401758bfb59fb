"""The four trigonometric bases: invertible, orthogonal, and those of the second difference."""

import numpy as np
import pytest
import scipy.fft

from signorini.solvers import transforms

BASES = {
    # name: (sizes of grids it serves, the transform it is, up to a factor; difference at each end:
    # see `matrix`)
    "vertex_cosines": (lambda x: scipy.fft.dct(x, 1), "flux at a vertex"),
    "vertex_sines": (lambda x: scipy.fft.dst(x, 1), "value at a vertex"),
    "midpoint_cosines": (lambda x: scipy.fft.dct(x, 2), "flux half a cell outside"),
    "midpoint_sines": (lambda x: scipy.fft.dst(x, 2), "value half a cell outside"),
}


@pytest.fixture(params=BASES)
def name(request):
    return request.param


@pytest.fixture(params=[2, 3, 4, 7, 16, 65])
def basis(request, name):
    return getattr(transforms, name)(request.param)


def matrix(name, size):
    """-x[i-1] + 2 x[i] - x[i+1] with the end conditions of a basis; for vertex cosines times the
    mass.
    """
    D = 2.0 * np.eye(size) - np.eye(size, k=1) - np.eye(size, k=-1)
    D[[0, -1], [0, -1]] = {
        "flux at a vertex": 1,
        "value at a vertex": 2,
        "flux half a cell outside": 1,
    }.get(BASES[name][1], 3)
    return D


@pytest.mark.parametrize("shape", [(), (1,), (5,), (64,), (65,), (130,)])
def test_backward_undoes_forward(basis, shape):
    x = np.random.default_rng(0).standard_normal((*shape, basis.mass.size))
    np.testing.assert_allclose(basis.backward(basis.forward(x)), x, rtol=0, atol=1e-13)
    np.testing.assert_allclose(basis.forward(basis.backward(x)), x, rtol=0, atol=1e-12)


def test_rows_are_transformed_one_by_one(basis):
    x = np.random.default_rng(0).standard_normal((70, basis.mass.size))
    for transform in (basis.forward, basis.backward):
        np.testing.assert_allclose(transform(x), [transform(row) for row in x], rtol=0, atol=1e-13)


def test_it_diagonalises_the_second_difference(name, basis):
    D = matrix(name, basis.mass.size)
    vectors = basis.backward(np.eye(basis.mass.size))  # row k: basis vector k
    scale = np.abs(vectors).max()
    expected = basis.eigenvalues[:, None] * basis.mass * vectors
    np.testing.assert_allclose(vectors @ D, expected, rtol=0, atol=1e-13 * scale)
    assert np.all(np.diff(basis.eigenvalues) > 0)


def test_it_is_orthogonal_in_its_mass(basis):
    vectors = basis.backward(np.eye(basis.mass.size))
    gram = (basis.mass * vectors) @ vectors.T
    np.testing.assert_allclose(gram, np.diag(gram.diagonal()), rtol=0, atol=1e-14 * gram.max())


def test_it_is_scipys_transform_up_to_factors(name, basis):
    x = np.random.default_rng(0).standard_normal(basis.mass.size)
    found, other = basis.forward(x), BASES[name][0](x)
    factors = found / other
    np.testing.assert_allclose(np.abs(factors), np.abs(factors[0]), rtol=1e-10)


def test_a_vector_is_left_as_it_was(basis):
    x = np.random.default_rng(0).standard_normal((3, basis.mass.size))
    before = x.copy()
    basis.forward(x)
    basis.backward(x)
    np.testing.assert_array_equal(x, before)


def test_scipy_takes_large_arrays_and_any_number_of_threads_gives_the_same_bits(name, monkeypatch):
    basis = getattr(transforms, name)(100)
    x = np.random.default_rng(0).standard_normal((173, basis.mass.size))
    expected = basis.forward(x), basis.backward(x)
    monkeypatch.setattr(transforms, "_LARGE", 4096)
    found = []
    for threads in ("1", "2", "3", "no number"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        found.append((basis.forward(x), basis.backward(x, out=x.copy())))
    np.testing.assert_allclose(found[0][0], expected[0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(found[0][1], expected[1], rtol=0, atol=1e-12)
    assert any(
        not np.array_equal(a, b) for a, b in zip(found[0], expected, strict=True)
    )  # it was SciPy
    for other in found[1:]:
        np.testing.assert_array_equal(other, found[0])
