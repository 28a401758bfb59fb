"""How many cells a level cuts a rectangle into; arithmetic alone, so that scenes are checked with
it.
"""

from signorini.exceptions import MeshError


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
    """
    if cells == "per-side":
        return n, n
    counts = [n * side for side in size]
    for axis, count in zip("xy", counts, strict=True):
        if round(count) < 1 or abs(count - round(count)) > 1e-9 * count:
            raise MeshError(
                f"domain.size: level n = {n} cuts the {axis} side into {count:.6g} cells; choose n so that "
                "n times the side is a whole number, or set domain.cells to per-side"
            )
    return round(counts[0]), round(counts[1])
