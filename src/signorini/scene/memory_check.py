"""Whether a level fits this machine, judged before any work on it.

All that is known of a level then is its domain, element and route. Meshes and routes judge for
themselves too, but not before all that they start from has been made.
"""

import math

from signorini.exceptions import MeshError
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.memory import fits, shortage

_ROUTES = ("fourier", "multigrid", "direct")  # the frugal first


def check_level(statement, element, n, method, domain=None):
    """Refuse a level that the route asked for cannot hold.

    Parameters
    ----------
    statement : ProblemStatement
    element : {"P1", "CR"}
    n : int
        The level, n = 1/h.
    method : {"auto", "fourier", "direct", "multigrid"}
        As in `solvers.solve`.
    domain : Rectangle or Refined, optional
        `statement.triangulations`, where it has been made already. Without it the triangles of a
        polygon are counted by its area and those of a mesh file not at all: nothing is meshed, and
        NumPy not loaded unless a level is refused.

    Raises
    ------
    MeshError
        Saying what is needed, what there is, and which route would do.
    """
    triangles = domain.count_triangles(n) if domain else count_roughly(statement.domain, n)
    route = "multigrid" if method == "auto" else method
    bytes_by = ELEMENT_FACTS[element].bytes_by
    if fits(triangles, bytes_by(route)):
        return
    applicable = [
        other for other in _ROUTES if other != "fourier" or fourier_applies(statement, element, n)
    ]
    fitting = [other for other in applicable if fits(triangles, bytes_by(other))]
    if method == "auto":
        if fitting:
            return
        route = applicable[0]
    missing = shortage(triangles, bytes_by(route))
    remedy = f"set solver.method to {' or '.join(fitting)}, or " if fitting else ""
    raise MeshError(
        f"levels: n = {n} for {element} by solver.method {method} {missing}; "
        f"{remedy}choose smaller levels"
    )


def count_roughly(domain, n):
    """Triangles of level n of a section ``domain``: twice its area in cells.

    Netgen makes an eighth more.

    Parameters
    ----------
    domain : dict
        The section ``domain``.
    n : int

    Returns
    -------
    float
        Zero for a mesh file, which is not read.

    Examples
    --------
    >>> square = {"kind": "rectangle", "size": [1, 1], "cells": "per-unit", "diagonal": "falling"}
    >>> [count_roughly(square, n) for n in (1, 512)]
    [2, 524288]
    """
    kind = domain.get("kind", "rectangle")
    if kind == "mesh":
        return 0
    if kind == "polygon":
        return 2 * n**2 * (_area(domain["corners"]) - math.fsum(map(_area, domain["holes"])))
    width, height = (1, 1) if domain["cells"] == "per-side" else domain["size"]
    return (4 if domain["diagonal"] == "criss-cross" else 2) * n**2 * width * height


def _area(corners):
    """Of a simple polygon, in either sense of rotation; unit of length squared."""
    sides = zip(corners, corners[1:] + corners[:1], strict=True)
    return 0.5 * abs(math.fsum(ax * by - bx * ay for (ax, ay), (bx, by) in sides))


def fourier_applies(statement, element, n):
    """Whether the fourier route solves this level.

    It is asked of the grid alone, which costs nothing.

    Parameters
    ----------
    statement : ProblemStatement
    element : {"P1", "CR"}
    n : int
        The level, n = 1/h.

    Returns
    -------
    bool
    """
    is_rectangle = statement.domain.get("kind", "rectangle") == "rectangle"
    if not is_rectangle or not statement.triangulations.uniform:
        return False
    if getattr(statement.data.coefficient, "constant", None) != 1.0:
        return False
    from signorini.solvers.fourier import why_not_on

    grid = statement.triangulations.level(n)
    return why_not_on(grid, element) is None
