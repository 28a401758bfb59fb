"""Numbers that a discrete solution is computed for: lengths, places and fluxes on the boundary."""

import numpy as np

from signorini.fem.contact_line import binding_pieces, critical_places
from signorini.mesh.boundary_trace import find_boundary_trace


def contact_length(problem, solution):
    """Length of the contact part on which the constraint binds, to half a mesh width at each end.

    Parameters
    ----------
    problem : Problem
    solution : StoredSolution

    Returns
    -------
    float
        Unit of length.

    Examples
    --------
    Under a punch that is 1.2 wide:

    >>> from signorini import discretize, load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> contact_length(discretize(scene, "CR", 64), solve_level(scene, "CR", 64))
    1.21875
    """
    return binding_length(problem.mesh, solution)


def binding_length(mesh, solution):
    """As `contact_length`, of a solution on its mesh.

    Parameters
    ----------
    mesh : Grid or Triangulation
    solution : StoredSolution

    Returns
    -------
    float
        Unit of length.

    Examples
    --------
    The whole bottom side of the patch test is in contact:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/patch.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> binding_length(mesh, solve_level(scene, "CR", 4))
    1.0
    """
    pieces = binding_pieces(mesh, solution)
    return float(np.hypot(*(pieces[:, 1] - pieces[:, 0]).T).sum())


def free_length(problem, solution):
    """Length of the contact part on which the constraint does not bind; see `contact_length`.

    Parameters
    ----------
    problem : Problem
    solution : StoredSolution

    Returns
    -------
    float
        Unit of length.

    Examples
    --------
    Both lengths make the whole side:

    >>> from signorini import discretize, load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> problem, solution = discretize(scene, "P1", 64), solve_level(scene, "P1", 64)
    >>> free_length(problem, solution) + contact_length(problem, solution)
    2.0
    """
    whole = find_boundary_trace(problem.mesh, "contact").length.sum()
    return float(whole) - contact_length(problem, solution)


def critical_point(problem, solution, which=1, coordinate="s"):
    """Where the constraint starts or ends to bind, known to half a mesh width.

    Parameters
    ----------
    problem : Problem
    solution : StoredSolution
    which : int
        Counted from 1 along the contact part, which contact_line.csv lists in order.
    coordinate : {"s", "x", "y"}
        Arc length along the contact part, or a coordinate.

    Returns
    -------
    float or None
        Unit of length; None where there are fewer such points.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> problem, solution = discretize(scene, "CR", 64), solve_level(scene, "CR", 64)
    >>> [critical_point(problem, solution, which, "x") for which in (1, 2, 3)]
    [-0.609375, 0.609375, None]
    """
    places = critical_places(problem.mesh, solution)
    if which > places.shape[1]:
        return None
    return float(places["sxy".index(coordinate), which - 1])


def flux(problem, solution, through="contact"):
    """Integral of k du/dnu over all parts of the boundary with a label.

    On the contact part it is the sum of the contact forces, on the Dirichlet part that of the
    residuals. With the integrals of f and g the two sum up to zero, as they do for the exact
    solution.

    Parameters
    ----------
    problem : Problem
    solution : StoredSolution
    through : {"contact", "dirichlet"}

    Returns
    -------
    float
        Unit of k u.

    Examples
    --------
    The fluxes through both parts and the load, whose integral is 0 here, balance:

    >>> from signorini import discretize, load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> problem, solution = discretize(scene, "CR", 32), solve_level(scene, "CR", 32)
    >>> abs(sum(flux(problem, solution, part) for part in ("contact", "dirichlet"))) < 1e-13
    True
    """
    return float(_FLUXES[through](problem, solution))


def excess(problem, solution):
    """Integral of k du/dnu less its threshold over the contact part: the sum of the multiplier.

    Parameters
    ----------
    problem : Problem
    solution : StoredSolution

    Returns
    -------
    float
        Unit of k u; without a threshold the flux through the contact part.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> problem, solution = discretize(scene, "CR", 32), solve_level(scene, "CR", 32)
    >>> excess(problem, solution) == flux(problem, solution, "contact")
    True
    """
    return float(solution.multiplier.sum())


def _contact_flux(problem, solution):
    threshold = 0.0 if problem.contact_load is None else problem.contact_load.sum()
    return solution.multiplier.sum() + threshold


def _dirichlet_flux(problem, solution):
    return (problem.apply(solution.u) - problem.b)[problem.fixed].sum()


_FLUXES = {"contact": _contact_flux, "dirichlet": _dirichlet_flux}
