"""Points of a sweep in bundles: one for each job of a workflow, and few enough that starting jobs
costs little beside the points.
"""

import json
from itertools import pairwise

from signorini.exceptions import SceneError
from signorini.scene.sweep import sweep_points

MOST_BUNDLES = 4  # unless more are asked for
FEWEST_POINTS = 25  # likewise, in a bundle; starting a job costs half a second
# Sections that the discrete problems depend on: points that agree in them share their solutions.
STATED = ("domain", "boundary", "data", "load_quadrature", "levels", "truth", "constraint")


def bundles(section, most=None):
    """The points of a sweep, bundled.

    Parameters
    ----------
    section : dict
        The section ``sweep`` of a scene.
    most : int, optional
        Largest number of bundles. Without it there are so few that starting a job for each costs
        little: `MOST_BUNDLES` at most, none with less than `FEWEST_POINTS` unless it is the only
        one.

    Returns
    -------
    tuple of tuple of Point
        Points that state the same problem are neighbours in one bundle.

    Examples
    --------
    >>> made = bundles({"data.f": {"from": 1, "to": 60, "count": 60}})
    >>> [len(bundle) for bundle in made]
    [30, 30]
    """
    units = {}
    for point in sweep_points(section):
        units.setdefault(_stated(point), []).append(point)
    count = sum(map(len, units.values()))
    if most is None:
        most = max(1, min(MOST_BUNDLES, count // FEWEST_POINTS))
    return _split(list(units.values()), most)


def bundle(section, number, most=None):
    """One of the bundles, by its number from 1.

    Parameters
    ----------
    section, most
        See `bundles`.
    number : int

    Returns
    -------
    tuple of Point

    Raises
    ------
    SceneError
        If there is no such bundle.

    Examples
    --------
    >>> from signorini import load_scene
    >>> section = load_scene("config/scenes/punch-widths.yaml").document["sweep"]
    >>> len(bundle(section, 1, most=2))
    13
    """
    return numbered(bundles(section, most), number)


def numbered(made, number):
    """One of the bundles that were made, by its number from 1.

    Parameters
    ----------
    made : tuple of tuple of Point
        As `bundles` returns them.
    number : int

    Returns
    -------
    tuple of Point

    Raises
    ------
    SceneError
        If there is no such bundle.

    Examples
    --------
    >>> numbered((("a", "b"), ("c",)), 2)
    ('c',)
    """
    if not 1 <= number <= len(made):
        raise SceneError(f"bundle {number}: the sweep has bundles 1 to {len(made)}")
    return made[number - 1]


def _stated(point):
    """The values on which the discrete problems of a point depend, as text."""
    stated = {key: value for key, value in point.values.items() if key.split(".")[0] in STATED}
    return json.dumps(stated, sort_keys=True)


def _split(units, number):
    """Units in order, in so many bundles, or as many as there are units; all units are as large."""
    number = min(number, len(units))
    ends = [k * len(units) // number for k in range(number + 1)]
    return tuple(
        tuple(point for unit in units[start:end] for point in unit) for start, end in pairwise(ends)
    )
