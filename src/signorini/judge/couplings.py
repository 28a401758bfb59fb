"""The Dirichlet form as a network of couplings, in extended precision (80 bits).

Vertices are taken as exact; of a `Grid`, the side lengths and numbers of cells.
"""

from typing import NamedTuple

import numpy as np

from signorini.fem.elements import find_element
from signorini.judge.elimination import EXTENDED
from signorini.mesh.grid import Grid


class Couplings(NamedTuple):
    """Terms w (u_i - u_j) of the forces, one for every facet of every triangle.

    ``first`` and ``second`` are i and j, ``weight`` w, and ``rounding`` what w is summed from: eps
    times it is the error of w. All have shape (3 nt,); the last two are longdouble, in the unit of
    the coefficient.
    """

    first: np.ndarray
    second: np.ndarray
    weight: np.ndarray
    rounding: np.ndarray


def couplings(mesh, element, coefficient=None):
    """The couplings of the Dirichlet form.

    With a and b the edges of a triangle from the facet's ends to the opposite vertex, P1 couples
    the ends by w = a.b / (2 |a x b|), half the cotangent of the angle; CR couples the other two
    facets by 4 w.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    coefficient : ndarray, shape (nt,), optional

    Returns
    -------
    Couplings

    Examples
    --------
    Two right triangles of half a square each couple along their legs, and not along the diagonal:

    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> square = Grid(1, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> couplings(square, "P1").weight.astype(float) + 0.0
    array([0.5, 0.5, 0. , 0. , 0.5, 0.5])
    """
    element, edges = find_element(element), _edge_vectors(mesh)
    crossing = edges[0, 0] * edges[1, 1], edges[0, 1] * edges[1, 0]
    area = np.abs(crossing[0] - crossing[1])
    cancelled = (np.abs(crossing[0]) + np.abs(crossing[1])) / area
    stiffness = 1 if coefficient is None else coefficient.astype(EXTENDED)
    scale = EXTENDED(0.5 * element.coupling_factor) / area * stiffness
    dofs = element.triangle_dofs(mesh)
    by_facet = []
    for facet, (one, other) in enumerate(element.coupled):
        terms = edges[facet - 2] * edges[facet - 1]
        weight = -scale * terms.sum(axis=0)
        rounding = scale * np.abs(terms).sum(axis=0) + cancelled * np.abs(weight)
        by_facet.append((dofs[one], dofs[other], weight, rounding))
    return Couplings(*(np.concatenate(parts) for parts in zip(*by_facet, strict=True)))


def _edge_vectors(mesh):
    """The edges 01, 12 and 20 of all triangles, longdouble, shape (3, 2, nt)."""
    if isinstance(mesh, Grid):
        size = np.array(mesh.size, dtype=EXTENDED)
        spacing = size / (mesh.nx, mesh.ny)
        cell = np.array(mesh.corners).transpose(1, 2, 0)
        cells = np.repeat(cell, mesh.nx * mesh.ny, axis=2)
        corners = cells * spacing[:, None]
    else:
        points = mesh.p.astype(EXTENDED)
        corners = points[:, mesh.t].transpose(1, 0, 2)
    return np.roll(corners, -1, axis=0) - corners
