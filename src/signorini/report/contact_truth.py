"""The truth along the contact part, beside what the elements found there."""

import numpy as np

from signorini.errors.contact import contact_resultant
from signorini.fem.elements import find_element
from signorini.mesh.curved import curves_of

_SAME_PLACE = 1e-9  # of the size of the contact part: nearer points are one


def with_exact(rows, mesh, exact):
    """Rows of contact_line.csv with an exact solution beside them.

    Parameters
    ----------
    rows : sequence of dict
        What `signorini.fem.contact_line.contact_rows` returns, of one or more solutions.
    mesh : Grid or Triangulation
        On which the exact contact force is integrated.
    exact : ExactSolution

    Returns
    -------
    list of dict
        The rows with ``exact``, u at their places; and, where no side stands for a curve,
        ``true_resultant``, the integral of k du/dnu over the contact part, the same in each row.

    Examples
    --------
    u = 1 - y is 1 on the contact side, and presses by 1 in all:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> from signorini.fem.contact_line import contact_rows
    >>> scene = load_scene("config/scenes/patch.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> rows = contact_rows(mesh, solve_level(scene, "CR", 4))
    >>> row = with_exact(rows, mesh, scene.problem_statement.exact)[0]
    >>> row["exact"], row["true_resultant"]
    (1.0, 1.0)
    """
    values = exact.value(*_places(rows))
    found = [row | {"exact": float(value)} for row, value in zip(rows, values, strict=True)]
    if curves_of(mesh):
        return found
    resultant = contact_resultant(mesh, exact)
    return [row | {"true_resultant": resultant} for row in found]


def with_reference(rows, mesh, reference):
    """Rows of contact_line.csv with a finer solution beside them.

    Parameters
    ----------
    rows : sequence of dict
        What `signorini.fem.contact_line.contact_rows` returns, of one or more solutions.
    mesh : Grid or Triangulation
        The reference's; its level is an even multiple of those of the rows, so that every place of
        theirs is a vertex of it.
    reference : StoredSolution

    Returns
    -------
    list of dict
        The rows with ``reference``, u at their places, None where the reference has no contact dof;
        and ``true_resultant``, its whole contact force, the same in each row.
    """
    nodes = find_element(reference.element).nodes(mesh, reference.contact)
    nearest = _nearest(np.stack(_places(rows)), nodes)
    values = reference.u[reference.contact][nearest]
    pairs = zip(nearest < 0, values, strict=True)
    nearest_values = [None if missing else float(u) for missing, u in pairs]
    resultant = float(reference.force.sum())
    return [
        row | {"reference": value, "true_resultant": resultant}
        for row, value in zip(rows, nearest_values, strict=True)
    ]


def _places(rows):
    return [np.array([row[name] for row in rows]) for name in "xy"]


def _nearest(points, nodes):
    """The number of the node at each point, -1 where there is none."""
    from scipy.spatial import KDTree

    near = _SAME_PLACE * np.ptp(nodes, axis=1).max()
    _, nearest = KDTree(nodes.T).query(points.T, distance_upper_bound=near)
    return np.where(nearest < nodes.shape[1], nearest, -1)
