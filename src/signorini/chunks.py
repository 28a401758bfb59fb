"""Long arrays worked through piece by piece, so that temporaries stay small and in the processor's
cache.
"""

_SIZE = 2**15


def blocks(count, size=_SIZE):
    """Slices that together cover ``range(count)``, of at most `size` each.

    Examples
    --------
    >>> list(blocks(5, 2))
    [slice(0, 2, None), slice(2, 4, None), slice(4, 5, None)]
    """
    for start in range(0, count, size):
        yield slice(start, min(start + size, count))
