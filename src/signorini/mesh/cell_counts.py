"""How many cells a level cuts a rectangle into; arithmetic alone, for the check of scenes."""

from signorini.exceptions import MeshError

_WHOLE = 1e-9  # relative distance up to which a count of cells is a whole number


def count_cells(size, cells, n):
    """Cells along x and y of a rectangle at level n.

    Parameters
    ----------
    size : sequence of float
        Side lengths, unit of length.
    cells : {"per-unit", "per-side"}
        Whether level n has n cells per unit of length or n along each side.
    n : int

    Returns
    -------
    tuple of int

    Raises
    ------
    MeshError
        If a side is not a whole number of cells.

    Examples
    --------
    >>> count_cells([1.5, 1.0], "per-unit", 4)
    (6, 4)
    >>> count_cells([1.5, 1.0], "per-side", 4)
    (4, 4)
    """
    if cells == "per-side":
        return n, n
    counts = [n * side for side in size]
    for axis, count in zip("xy", counts, strict=True):
        if round(count) < 1 or abs(count - round(count)) > _WHOLE * count:
            raise MeshError(
                f"domain.size: level n = {n} cuts the {axis} side into {count:.6g} cells; "
                "choose n so that n times the side is a whole number, "
                "or set domain.cells to per-side"
            )
    return round(counts[0]), round(counts[1])
