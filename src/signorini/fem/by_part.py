"""A datum that is given part by part of the boundary."""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import SceneError
from signorini.mesh.boundary import part_key

_ROUNDING = 1e-10  # relative, within which the values of two parts meet


@dataclass(frozen=True, eq=False)
class ByPart:
    """Name of a part of the boundary -> its datum.

    Parameters
    ----------
    parts : dict of str to Formula or Function
        The mesh knows each by its `part_key`.
    field : str
        Name of the quantity, for error messages.
    """

    parts: dict
    field: str

    constant = None


def values_at(mesh, element, datum, dofs, check=True):
    """Values of a datum at degrees of freedom on the boundary.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    datum : Formula, Function or ByPart
    dofs : ndarray of int, shape (k,)
        Of a `ByPart` each on one of its parts; on two, the latter holds.
    check : bool
        Whether a value that is not finite is an error.

    Returns
    -------
    ndarray, shape (k,)

    Raises
    ------
    FormulaError
        Where a value is not finite.

    Examples
    --------
    >>> from signorini.fem.elements import find_element
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> dofs = mesh.boundary_vertices("contact")
    >>> values_at(mesh, find_element("P1"), Formula("2*x", "obstacle"), dofs)
    array([0., 1., 2.])
    """
    if not isinstance(datum, ByPart):
        return datum(*element.nodes(mesh, dofs), check=check)
    values = np.zeros(dofs.size)
    for name, own in datum.parts.items():
        on_part = np.isin(dofs, element.boundary_dofs(mesh, part_key(name)))
        values[on_part] = own(*element.nodes(mesh, dofs[on_part]), check=check)
    return values


def check_parts_meet(mesh, datum, label):
    """Refuse a datum whose values jump where two of its parts meet.

    No continuous function has them. Where `label` holds and no part is named, it is 0.

    Parameters
    ----------
    mesh : Grid or Triangulation
    datum : ByPart
        Anything else is not looked at.
    label : {"dirichlet", "contact"}
        Of the parts that it acts on.

    Raises
    ------
    SceneError
        Naming the point and both values.

    Examples
    --------
    >>> from signorini.formula import Formula
    >>> from signorini.mesh.grid import Grid
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", ("dirichlet",) * 4)
    >>> check_parts_meet(grid, Formula("x", "data.dirichlet"), "dirichlet")
    """
    if not isinstance(datum, ByPart):
        return
    seen, values = np.zeros((2, mesh.number_of_vertices))
    rest = np.unique(mesh.facet_ends(_facets_left_out(mesh, datum, label)))
    seen[rest] = 1.0
    for name, own in datum.parts.items():
        vertices = mesh.boundary_vertices(part_key(name))
        new = own(*mesh.points(vertices), check=False)
        before = values[vertices]
        size = np.maximum(np.abs(new), np.abs(before))
        jumps = (seen[vertices] > 0) & (np.abs(new - before) > _ROUNDING * size)
        if jumps.any():
            k = int(np.argmax(jumps))
            x, y = mesh.points(vertices[k : k + 1])[:, 0]
            other = "a part that is left out" if vertices[k] in rest else "another part"
            raise SceneError(
                f"{datum.field}.{name}: {new[k]:.6g} at ({x:.6g}, {y:.6g}), where {other} "
                f"of {datum.field} has {before[k]:.6g}; let the values of both meet there"
            )
        seen[vertices], values[vertices] = 1.0, new


def _facets_left_out(mesh, datum, label):
    """The facets that carry a label and are on no part of a `ByPart`."""
    parts = [mesh.boundary_facets(part_key(name)) for name in datum.parts]
    return np.setdiff1d(mesh.boundary_facets(label), np.concatenate([*parts, []]))
