"""The diffusion coefficient on a mesh.

It is a formula taken at centroids, or a number for each subdomain of a mesh file.
"""

import numpy as np

from signorini.exceptions import FormulaError, MeshError
from signorini.fem.data import COEFFICIENTS, BySubdomain
from signorini.wording import nearest


def coefficient_on(mesh, coefficient):
    """The diffusion coefficient of each triangle of a mesh.

    Parameters
    ----------
    mesh : Grid or Triangulation
    coefficient : Formula or BySubdomain

    Returns
    -------
    ndarray, shape (nt,), or None
        None where it is 1 throughout.

    Raises
    ------
    FormulaError
        If the formula's value at a centroid is not one of `COEFFICIENTS`: positive, and not
        extreme.
    MeshError
        If the mesh has no subdomain of a name, or a triangle is in none that is named, or in two.

    Examples
    --------
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> coefficient_on(mesh, Formula("where(x < 0.5, 1, 2)", "data.coefficient"))
    array([1., 2., 1., 2., 1., 2., 1., 2.])
    >>> coefficient_on(mesh, Formula("1", "data.coefficient")) is None
    True
    """
    if isinstance(coefficient, BySubdomain):
        values = _by_subdomain(mesh, coefficient)
    elif coefficient.constant == 1.0:
        return None
    else:
        values = _at_centroids(mesh, coefficient)
    return None if np.all(values == 1.0) else values


def _at_centroids(mesh, formula):
    x, y = mesh.p[:, mesh.t].mean(axis=1)
    values = formula(x, y)
    low, high = COEFFICIENTS
    wrong = (values < low) | (values > high)
    if wrong.any():
        k = int(np.argmax(wrong))
        place = f"{values[k]:g} at ({x[k]:.6g}, {y[k]:.6g})"
        value = "not valid" if np.all(values == values[0]) else place
        raise FormulaError(
            f"{formula.field}: {formula.text} is {value}; it must be from {low:g} to {high:g}"
        )
    return values


def _by_subdomain(mesh, coefficient):
    known = getattr(mesh, "subdomains", {})
    values = np.zeros(mesh.number_of_triangles)
    times = np.zeros(mesh.number_of_triangles, dtype=int)
    for name, number in coefficient.numbers.items():
        if name not in known:
            raise MeshError(
                f"{coefficient.field}.{name[:60]}: the mesh has no such subdomain; "
                f"{nearest(name, known or ['none'])}"
            )
        values[known[name]] = number
        times[known[name]] += 1
    for wrong, complaint in ((times == 0, _missing), (times > 1, _double)):
        if wrong.any():
            _refuse(mesh, coefficient, int(np.argmax(wrong)), complaint)
    return values


def _refuse(mesh, coefficient, triangle, complaint):
    """Raise MeshError for a triangle without a coefficient, or with two."""
    x, y = mesh.p[:, mesh.t[:, triangle]].mean(axis=1)
    subdomains = getattr(mesh, "subdomains", {})
    around = [name for name, members in subdomains.items() if triangle in members]
    raise MeshError(
        f"{coefficient.field}: triangle {triangle} at ({x:.6g}, {y:.6g}) "
        f"{complaint(coefficient, around)}"
    )


def _missing(_, around):
    if around:
        return f"has no coefficient; add a number for {' or '.join(around)}"
    return "has no coefficient; put it into a group of the mesh file"


def _double(coefficient, around):
    named = [name for name in around if name in coefficient.numbers]
    return f"is in {' and '.join(named)} at once; name one of them"
