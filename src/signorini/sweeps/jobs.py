"""Jobs of the workflow, and what many of them take together: time, memory, disk."""

import heapq
import math
from collections import Counter
from dataclasses import dataclass

_SUMMED = ("seconds", "disk")


@dataclass(frozen=True)
class Job:
    """A job of the workflow.

    Parameters
    ----------
    rule : str
    solves : int
    seconds : float
        Of processor time, with its start.
    memory, disk : float
        Bytes: at the peak, and of what it writes.
    """

    rule: str
    solves: int
    seconds: float
    memory: float
    disk: float


def by_rule(jobs):
    """What the jobs of each rule come to.

    Parameters
    ----------
    jobs : sequence of Job

    Returns
    -------
    list of dict
        ``rule``, ``jobs``, ``solves``, ``seconds`` and ``disk`` in all, ``memory`` of the largest.

    Examples
    --------
    >>> by_rule([Job("solve", 1, 0.5, 2e8, 1e4), Job("solve", 1, 1.5, 4e8, 2e4)])[0]["seconds"]
    2.0
    """
    counts = Counter(job.rule for job in jobs)
    rows = []
    for rule, count in counts.items():
        alike = [job for job in jobs if job.rule == rule]
        solves = sum(job.solves for job in alike)
        sums = {key: math.fsum(getattr(job, key) for job in alike) for key in _SUMMED}
        row = {"rule": rule, "jobs": count, "solves": solves} | sums
        rows.append(row | {"memory": peak_memory(alike, 1)})
    return rows


def elapsed(jobs, cores):
    """Seconds until all jobs are done, the longest first, each by one core.

    Parameters
    ----------
    jobs : sequence of Job
    cores : int

    Returns
    -------
    float

    Examples
    --------
    >>> jobs = [Job("solve", 1, seconds, 1e8, 0) for seconds in (1.0, 3.0, 2.0)]
    >>> elapsed(jobs, 1), elapsed(jobs, 2), elapsed(jobs, 64)
    (6.0, 3.0, 3.0)
    """
    free = [0.0] * min(cores, len(jobs))
    for seconds in sorted((job.seconds for job in jobs), reverse=True):
        heapq.heapreplace(free, free[0] + seconds)
    return max(free)


def peak_memory(jobs, cores):
    """Bytes of the largest jobs, as many as there are cores, at their peaks at once.

    Parameters
    ----------
    jobs : sequence of Job
    cores : int

    Returns
    -------
    float

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> jobs = [SimpleNamespace(memory=size) for size in (5.0, 1.0, 3.0)]
    >>> peak_memory(jobs, cores=2)
    8.0
    """
    return math.fsum(heapq.nlargest(cores, (job.memory for job in jobs)))
