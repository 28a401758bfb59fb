"""Whether a reference solves the problem of the solution that is held against it."""

from dataclasses import replace
from typing import Any

import numpy as np

from signorini.api.parts import labels_of_parts
from signorini.api.types import Floats
from signorini.exceptions import SceneError
from signorini.fem.by_part import ByPart, values_at
from signorini.fem.data import BySubdomain, Data
from signorini.fem.elements import find_element
from signorini.fem.problem import Problem
from signorini.formula import Formula
from signorini.mesh.boundary import LABELS
from signorini.mesh.grid import Grid

_SAME = 1e-8  # relative, within which two formulas are one
_POINTS = 1000  # about so many of them are looked at
_ON_BOUNDARY = {
    "g": "neumann",
    "dirichlet": "dirichlet",
    "obstacle": "contact",
    "contact_flux": "contact",
}


def check_same_problem(reference: Problem, own: Problem) -> None:
    """Refuse a reference that solves another problem, as far as that shows.

    Labels of the boundary and the side of the constraint are compared; and of the data numbers and
    formulas, by their values where they act. Functions of a program are not: they may well depend
    on the mesh. Meshes that do not nest are not looked at.

    Parameters
    ----------
    reference, own : Problem

    Raises
    ------
    SceneError
        Naming what differs.

    Examples
    --------
    >>> import signorini
    >>> def problem(n, f):
    ...     return signorini.problem(signorini.rectangle(n), f=f, dirichlet="top")
    >>> check_same_problem(problem(8, "x/2"), problem(4, "0.5*x"))
    >>> check_same_problem(problem(8, -9), problem(4, 1))
    Traceback (most recent call last):
    signorini.exceptions.SceneError: truth: its f is another, -9 where the solution has 1, at ...
    """
    level = _level_of(reference.mesh, own.mesh)
    if level is None:
        return
    for label in LABELS:
        theirs, ours = (mesh.boundary_facets(label) for mesh in (level, own.mesh))
        if not np.array_equal(theirs, ours):
            raise SceneError(
                f"truth: its {label} part is another than that of the solution; "
                "solve both with the same parts of the boundary"
            )
    if own.contact.size and reference.upper != own.upper:
        raise SceneError(
            "truth: its constraint is on the other side of the obstacle; solve both with the same"
        )
    if reference.data is not None and own.data is not None:
        _check_data(own.mesh, reference.data, own.data)


def _level_of(finer: Any, mesh: Any) -> Any:
    """The mesh among those that one was refined from which has the triangles of another.

    None where there is none. Labels may differ.
    """
    while finer is not None and finer.number_of_triangles > mesh.number_of_triangles:
        finer = finer.coarser()
    if finer is None or type(finer) is not type(mesh):
        return None
    compared = replace(finer, labels=mesh.labels) if isinstance(mesh, Grid) else finer
    return finer if compared.same_as(mesh) else None


def _check_data(mesh: Any, theirs: Data, ours: Data) -> None:
    corners = mesh.t[:, :: _stride(mesh.number_of_triangles)]
    centroids = np.mean([mesh.points(vertices) for vertices in corners], axis=0)
    for field in ("f", "coefficient"):
        pair = getattr(theirs, field), getattr(ours, field)
        if all(isinstance(datum, Formula) for datum in pair):
            values = [datum(*centroids, check=False) for datum in pair]
            _compare(field, centroids, *values)
    _compare_subdomains(theirs.coefficient, ours.coefficient)
    known, element = labels_of_parts(mesh), find_element("CR")
    for field, label in _ON_BOUNDARY.items():
        pair = getattr(theirs, field), getattr(ours, field)
        if all(_is_known(datum, known) for datum in pair):
            facets = mesh.boundary_facets(label)
            facets = facets[:: _stride(facets.size)]
            values = [values_at(mesh, element, datum, facets, check=False) for datum in pair]
            _compare(field, element.nodes(mesh, facets), *values)


def _stride(count: int) -> int:
    return max(1, count // _POINTS)


def _is_known(datum: Any, known: Any) -> bool:
    """Whether the values of a datum are those of formulas alone, on parts that a mesh knows."""
    if isinstance(datum, ByPart):
        return set(datum.parts) <= set(known) and all(
            isinstance(own, Formula) for own in datum.parts.values()
        )
    return isinstance(datum, Formula)


def _compare(field: str, points: Floats, theirs: Floats, ours: Floats) -> None:
    finite = np.isfinite(theirs) & np.isfinite(ours)  # a pole in one of them is told elsewhere
    theirs, ours = (np.where(finite, values, 0.0) for values in (theirs, ours))
    size = np.maximum(np.abs(theirs), np.abs(ours)).max(initial=0.0)
    off = np.abs(theirs - ours) > _SAME * size
    if off.any():
        k = int(np.argmax(off))
        x, y = points[0][k], points[1][k]
        raise SceneError(
            f"truth: its {field} is another, {theirs[k]:.6g} where the solution has "
            f"{ours[k]:.6g}, at ({x:.6g}, {y:.6g}); solve both with the same data"
        )


def _compare_subdomains(theirs: Any, ours: Any) -> None:
    if not (isinstance(theirs, BySubdomain) and isinstance(ours, BySubdomain)):
        return
    for name, number in ours.numbers.items():
        other = theirs.numbers.get(name, number)
        if other != number:
            raise SceneError(
                f"truth: its coefficient.{name} is another, {other:g} where the solution has "
                f"{number:g}; solve both with the same data"
            )
