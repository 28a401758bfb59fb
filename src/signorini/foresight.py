"""Whether a level fits this machine, judged before any work on it, from its domain, element and route.

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
        `statement.triangulations`, where it has been made already.

    Raises
    ------
    MeshError
        Saying what is needed, what there is, and which route would do.
    """
    domain = domain or statement.triangulations
    triangles = domain.count_triangles(n)
    route = "multigrid" if method == "auto" else method
    if fits(triangles, ROUTES[route][element]):
        return
    others = [other for other in ROUTES if other != "fourier" or _fourier_applies(statement, element, n, domain)]
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


def _fourier_applies(statement, element, n, domain):
    """Whether the fourier route solves this level: asked of a problem without data, on a grid that costs nothing."""
    if not domain.uniform or getattr(statement.data.coefficient, "constant", None) != 1.0:
        return False
    import numpy as np

    from signorini.problem import Problem
    from signorini.solvers.fourier import obstruction

    values, dofs = np.zeros(0), np.zeros(0, dtype=int)
    return obstruction(Problem(element, domain.level(n), values, dofs, values, dofs, values)) is None
