"""A few points of a sweep, solved, to hold a forecast against."""

import time
from pathlib import Path

from signorini.sweeps.forecast import STARTS, points_job
from signorini.sweeps.records import solve_points


def spread(entries, count):
    """So many entries, from the first to the last, evenly.

    Parameters
    ----------
    entries : sequence
    count : int
        From 1; more than there are entries are all of them.

    Returns
    -------
    list

    Examples
    --------
    >>> spread(range(101), 5)
    [0, 25, 50, 75, 100]
    >>> spread("abc", 1), spread("abc", 7)
    (['a'], ['a', 'b', 'c'])
    """
    count = min(count, len(entries))
    last = max(count - 1, 1)
    return [entries[k * (len(entries) - 1) // last] for k in range(count)]


def sample_points(scene, points, folder):
    """Solve points as a job does, without its start.

    Parameters
    ----------
    scene : Scene
        With a sweep.
    points : sequence of Point
    folder : str or Path
        Empty; for their files.

    Returns
    -------
    solves : int
    forecast, measured : float
        Seconds of processor time.
    """
    solve_points(scene, points[:1], Path(folder, "start"), "")  # loads what a process loads once
    start = time.process_time()
    solve_points(scene, points, Path(folder, "points"), "")
    measured = time.process_time() - start
    job = points_job(scene, points)
    return job.solves, job.seconds - STARTS["sweep_points"], measured
