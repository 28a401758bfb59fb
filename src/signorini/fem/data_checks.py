"""Checks of data on a mesh: poles of the force, and an obstacle that leaves nothing admissible."""

import numpy as np

from signorini.exceptions import SceneError
from signorini.fem.by_part import values_at
from signorini.fem.elements import find_element
from signorini.fem.function import Function
from signorini.formula import Formula

_ROUNDING = 1e-10  # relative, within which obstacle and Dirichlet data meet at a corner
_COARSE = 2**15  # triangles up to which poles of f are looked for


def check_poles(mesh, f):
    """Refuse a formula that has no finite value at a vertex or an edge midpoint.

    Poles tend to be there, and quadrature may miss them. Fine meshes are not looked at.

    Parameters
    ----------
    mesh : Grid or Triangulation
    f : Formula or Function
        Anything else is not looked at either.

    Raises
    ------
    FormulaError
        By the formula itself.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(2, 2, (-1.0, -1.0), (2.0, 2.0), "falling", ("contact",) * 4)
    >>> check_poles(grid, Formula("1/r", "data.f"))
    Traceback (most recent call last):
    signorini.exceptions.FormulaError: data.f: value is inf at (x, y) = (0.0, 0.0) in ...
    """
    if (
        isinstance(f, Formula | Function)
        and f.constant is None
        and mesh.number_of_triangles <= _COARSE
    ):
        f(*mesh.p)
        a, b = mesh.p[:, mesh.facets].transpose(1, 0, 2)
        f(*(0.5 * (a + b)))


def check_corners(mesh, data, size):
    """Refuse an obstacle beyond the Dirichlet data at a shared corner.

    The trace would jump there, and no function would be admissible: K is empty. Beyond is above, or
    below where u is bounded from above.

    Parameters
    ----------
    mesh : Grid or Triangulation
    data : Data
    size : float
        Largest of obstacle and Dirichlet data, to which rounding is relative; unit of u.

    Raises
    ------
    SceneError
        Naming the corner and both values.
    """
    shared = np.intersect1d(mesh.boundary_vertices("contact"), mesh.boundary_vertices("dirichlet"))
    x, y = mesh.points(shared)
    vertex_element = find_element("P1")
    obstacle, dirichlet = (
        values_at(mesh, vertex_element, datum, shared, check=False)
        for datum in (data.obstacle, data.dirichlet)
    )
    sign, side, remedy = _BEYOND[data.constraint]
    excess = sign * (obstacle - dirichlet)
    beyond = excess > _ROUNDING * np.maximum(size, np.abs(dirichlet))
    if beyond.any():
        k = int(np.flatnonzero(beyond)[0])
        raise SceneError(
            f"data: incompatible data at ({x[k]:.6g}, {y[k]:.6g}), where contact and dirichlet "
            f"parts meet: obstacle {obstacle[k]:.6g} lies {side} dirichlet {dirichlet[k]:.6g}; "
            f"{remedy} there"
        )


# Constraint -> sign of the obstacle's excess, where it lies then, and the remedy.
_BEYOND = {
    "lower": (1.0, "above", "lower the obstacle or raise dirichlet"),
    "upper": (-1.0, "below", "raise the obstacle or lower dirichlet"),
}
