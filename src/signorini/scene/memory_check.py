"""Whether a level fits this machine, judged before any work on it, from its domain, element and
route.

Meshes and routes judge for themselves too, but not before all that they start from has been made.
"""

from signorini.exceptions import MeshError
from signorini.memory import ROUTES, fits, shortage


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
    triangles = domain.count_triangles(n) if domain else _count_roughly(statement.domain, n)
    route = "multigrid" if method == "auto" else method
    if fits(triangles, ROUTES[route][element]):
        return
    others = [
        other for other in ROUTES if other != "fourier" or _fourier_applies(statement, element, n)
    ]
    held = [other for other in others if fits(triangles, ROUTES[other][element])]
    if method == "auto":
        if held:
            return
        route = others[0]
    remedy = f"set solver.method to {' or '.join(held)}, or " if held else ""
    raise MeshError(
        f"levels: n = {n} for {element} by solver.method {method} {shortage(triangles, ROUTES[route][element])}; "
        f"{remedy}choose smaller levels"
    )


def _count_roughly(domain, n):
    """Triangles of level n of a section ``domain``: twice its area in cells, which Netgen exceeds
    by an eighth.
    """
    kind = domain.get("kind", "rectangle")
    if kind == "mesh":
        return 0
    if kind == "polygon":
        return 2 * n**2 * (_area(domain["corners"]) - sum(map(_area, domain["holes"])))
    width, height = (1, 1) if domain["cells"] == "per-side" else domain["size"]
    return (4 if domain["diagonal"] == "criss-cross" else 2) * n**2 * width * height


def _area(corners):
    """Of a simple polygon, in either sense of rotation; unit of length squared."""
    sides = zip(corners, corners[1:] + corners[:1], strict=True)
    return 0.5 * abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in sides))


def _fourier_applies(statement, element, n):
    """Whether the fourier route solves this level: asked of a problem without data, on a grid that
    costs nothing.
    """
    if (
        statement.domain.get("kind", "rectangle") != "rectangle"
        or not statement.triangulations.uniform
    ):
        return False
    if getattr(statement.data.coefficient, "constant", None) != 1.0:
        return False
    import numpy as np

    from signorini.fem.problem import Problem
    from signorini.solvers.fourier import why_not

    grid, values, dofs = statement.triangulations.level(n), np.zeros(0), np.zeros(0, dtype=int)
    return why_not(Problem(element, grid, values, dofs, values, dofs, values)) is None
