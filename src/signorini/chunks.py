"""Long arrays taken chunk by chunk, so that temporaries stay small and in the processor's cache."""

_SIZE = 2**15


def chunk_slices(count, size=_SIZE):
    """Slices that together cover ``range(count)``.

    Parameters
    ----------
    count : int
    size : int, optional
        The most entries of a slice.

    Yields
    ------
    slice

    Examples
    --------
    >>> list(chunk_slices(5, 2))
    [slice(0, 2, None), slice(2, 4, None), slice(4, 5, None)]
    """
    for start in range(0, count, size):
        yield slice(start, min(start + size, count))
