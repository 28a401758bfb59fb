"""Memory that a level needs, predicted before the work: a job that is killed says nothing."""

import os

from signorini.exceptions import MeshError

# Bytes per triangle of a level, the least measured on 2**15 to 2**23 triangles: of a grid with its
# load, discretised and solved by the fourier route, and of any other mesh, discretised.
GRID, MESH = 30, 85
_MOST = 2**30  # triangles whose facets 32 bits can number


def check_memory(triangles, bytes_each, what):
    """Refuse a number of triangles that this machine cannot hold.

    Parameters
    ----------
    triangles : int
    bytes_each : int
        Memory that each needs at least.
    what : str
        What needs it, for the message.

    Raises
    ------
    MeshError
        If there is less memory, in the machine or allowed to this process.

    Examples
    --------
    >>> check_memory(1000, MESH, "n = 8")
    """
    if not fits(triangles, bytes_each):
        raise MeshError(
            f"levels: {what} {shortage(triangles, bytes_each)}; choose smaller levels, "
            "or for a rectangle set domain.cells to per-side"
        )


def fits(triangles, bytes_each):
    """Whether this machine can hold a number of triangles.

    Parameters
    ----------
    triangles : int
    bytes_each : int
        Memory that each needs at least.

    Returns
    -------
    bool

    Examples
    --------
    >>> fits(1000, GRID), fits(2**31, GRID)
    (True, False)
    """
    return triangles * bytes_each <= _memory() and triangles <= _MOST


def shortage(triangles, bytes_each):
    """What a number of triangles needs and what there is, in words.

    Parameters
    ----------
    triangles : int
    bytes_each : int
        Memory that each needs at least.

    Returns
    -------
    str

    Examples
    --------
    >>> shortage(2**31, 1)
    'has 2147 million triangles, more than the 1074 million that can be numbered'
    """
    count = _plain(triangles)
    if triangles * bytes_each <= _memory():
        return f"has {count} triangles, more than the {_plain(_MOST)} that can be numbered"
    needed, given = _plain(triangles * bytes_each / 1e9), _plain(_memory() / 1e9)
    return (
        f"has {count} triangles and needs at least {needed} GB of memory, "
        f"but there are {given} GB here"
    )


def _plain(size):
    """A number to the last digit before the point, and a small one to two digits.

    No reader wants 2.8e+02.
    """
    if 1e7 <= size < 1e11:
        return f"{size / 1e6:.0f} million"
    return f"{size:.0f}" if 10 <= size < 1e11 else f"{size:.2g}"


def _memory():
    """Bytes of memory that this process may use; infinite where the system does not tell."""
    limits = [float("inf")]
    if hasattr(os, "sysconf") and "SC_PHYS_PAGES" in os.sysconf_names:
        limits.append(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    try:
        import resource
    except ImportError:  # Windows
        return min(limits)
    soft, _ = resource.getrlimit(resource.RLIMIT_AS)
    return min([*limits, *[soft] * (soft != resource.RLIM_INFINITY)])
