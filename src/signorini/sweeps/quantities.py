"""What a sweep tells of the contact part of each solution."""

from signorini.fem.contact_line import critical_places
from signorini.fem.functionals import binding_length


def contact_quantities(mesh, solution):
    """What happens on the contact part, in a few numbers.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution

    Returns
    -------
    dict
        ``resultant``: the contact force in all, unit of k u. ``contact_length``: the length on
        which the constraint binds. ``critical_count``: the number of critical points.
        ``first_critical``, ``last_critical``: the arc length of the first and of the last one along
        the contact part, unit of length; None where there is none.

    Examples
    --------
    A punch of half width 0.6, below which du/dnu = sqrt(0.36 - x**2), presses by 0.18 pi:

    >>> from math import pi
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(64)
    >>> found = contact_quantities(mesh, solve_level(scene, "CR", 64))
    >>> round(found["resultant"] / pi, 3), found["critical_count"]
    (0.18, 2)
    """
    places = critical_places(mesh, solution)[0].tolist()
    return {
        "resultant": float(solution.force.sum()),
        "contact_length": binding_length(mesh, solution),
        "critical_count": len(places),
        "first_critical": min(places, default=None),
        "last_critical": max(places, default=None),
    }
