"""The work of a solve, counted: it tells a slower method from a busy machine.

Solvers report what they do by `count`. Within a block `counting` it is added up; elsewhere `count`
does nothing.
"""

from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass
class Work:
    """What was done so far.

    Attributes
    ----------
    products : int
        Products with the whole matrix, by stencil or by sparse matrix, those of the proof included.
    cycles : int
        Multigrid cycles from the finest level.
    factorisations : int
        Eliminations of all free unknowns off the contact part, by a sparse factorisation or by a
        sweep over the rows.
    steps : int
        Active sets examined.
    inner : int
        Products with the matrix condensed to the contact unknowns.
    """

    products: int = 0
    cycles: int = 0
    factorisations: int = 0
    steps: int = 0
    inner: int = 0


_work = ContextVar("work", default=None)


@contextmanager
def counting():
    """Count within a block; the work of a nested block is not counted in the outer one.

    Yields
    ------
    Work

    Examples
    --------
    >>> with counting() as work:
    ...     count(products=2)
    ...     count(products=1, steps=1)
    >>> work
    Work(products=3, cycles=0, factorisations=0, steps=1, inner=0)
    """
    work = Work()
    before = _work.set(work)
    try:
        yield work
    finally:
        _work.reset(before)


def count(**done):
    """Add to the counts of the innermost `counting` block, if there is one.

    Parameters
    ----------
    **done : int
        By the names of `Work`.

    Examples
    --------
    >>> with counting() as work:
    ...     count(steps=2)
    ...     count(steps=1)
    >>> work.steps
    3
    """
    work = _work.get()
    if work is not None:
        for name, more in done.items():
            setattr(work, name, getattr(work, name) + more)
