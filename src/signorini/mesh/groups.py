"""Groups of cells of a mesh file, by name and by number."""

import numpy as np

# Cell data that many formats use for group numbers: these need no name of the data before them.
_MARKERS = ("gmsh:physical", "medit:ref", "su2:tag", "cell_tags")
_MAX_GROUPS = 1000


class Groups:
    """Groups of one kind of cell.

    A name that is also another group's number is kept apart from it.
    """

    def __init__(self):
        self._members = {}

    def add(self, origin, text, members):
        """Add cells to a group.

        Parameters
        ----------
        origin : {"name", "number"}
            What `text` is.
        text : str
            The group's name or number.
        members : ndarray of int
            Numbers of the cells.

        Examples
        --------
        >>> groups = Groups()
        >>> groups.add("name", "rim", np.array([4, 2]))
        >>> groups.resolved()["rim"].tolist()
        [2, 4]
        """
        if len(members):
            self._members.setdefault((text, origin), []).append(members)

    def add_physical(self, number, members, titles, dimension):
        """Add a physical group of Gmsh under its names and its number.

        Parameters
        ----------
        number : int
        members : ndarray of int
            Numbers of the cells.
        titles : list of (int, int, str)
            Dimension, number and name of all groups of the file.
        dimension : int
            Of the cells: 1 or 2.

        Examples
        --------
        >>> groups = Groups()
        >>> groups.add_physical(7, np.array([0, 1]), [(1, 7, "rim")], dimension=1)
        >>> sorted(groups.resolved())
        ['7', 'rim']
        """
        for title in (name for *key, name in titles if key == [dimension, number]):
            self.add("name", title, members)
        self.add("number", str(number), members)

    def resolved(self):
        """Text to write in a scene -> its cells, increasing.

        Examples
        --------
        Where a name and a number are the same text, and not the same cells, both are told apart:

        >>> groups = Groups()
        >>> groups.add("name", "2", np.array([0]))
        >>> groups.add("number", "2", np.array([1]))
        >>> sorted(groups.resolved())
        ['name=2', 'number=2']
        """
        cells = {
            key: np.unique(np.concatenate(parts)).astype(np.int64)
            for key, parts in self._members.items()
        }
        clashing = {text for text, origin in cells if origin == "name" and not _agree(cells, text)}
        return {
            f"{origin}={text}" if text in clashing else text: members
            for (text, origin), members in cells.items()
        }


def _agree(cells, text):
    """Whether a name and a number that read the same, if there are both, are the same cells."""
    named = cells[text, "name"]
    return np.array_equal(cells.get((text, "number"), named), named)


def meshio_groups(mesh, blocks, data, titles, dimension, numbers):
    """The groups of one kind of cell of a meshio mesh.

    Parameters
    ----------
    mesh : meshio.Mesh
    blocks : list of int
        The mesh's blocks of such cells.
    data : dict of str to ndarray of int
        See `integer_data`.
    titles : list of (int, int, str)
        Dimension, number and name of Gmsh's physical groups.
    dimension : int
        Of the cells: 1 or 2.
    numbers : ndarray of int
        The number of each cell once equal ones are merged.

    Returns
    -------
    Groups
    """
    groups = Groups()
    for name, members in _cell_sets(mesh, blocks).items():
        groups.add("name", name, numbers[members])
    # Number of a family of a .med file -> names of the groups that its cells are in.
    families = {int(tag): names for tag, names in getattr(mesh, "cell_tags", {}).items()}
    for name, values in data.items():
        plain = len(data) == 1 or name in _MARKERS
        for value in map(int, np.unique(values)[:_MAX_GROUPS]):
            members = numbers[np.flatnonzero(values == value)]
            if name == "gmsh:physical":
                groups.add_physical(value, members, titles, dimension)
                continue
            for title in families.get(value, ()) if name == "cell_tags" else ():
                groups.add("name", title, members)
            groups.add("number", str(value) if plain else f"{name}={value}", members)
    return groups


def integer_data(mesh, blocks):
    """The cell data that may be markers: one integer for each cell of some blocks.

    Parameters
    ----------
    mesh : meshio.Mesh
    blocks : list of int

    Returns
    -------
    dict of str to ndarray of int
    """
    markers = {}
    for name, data in mesh.cell_data.items():
        parts = [np.asarray(data[k]) for k in blocks]
        if parts and all(v.dtype.kind in "iub" and v.size == len(v) for v in parts):
            markers[name] = np.concatenate([v.ravel() for v in parts])
    return markers


def _cell_sets(mesh, blocks):
    """Name -> numbers of the cells in that set, counted over some blocks."""
    offsets = np.cumsum([0, *(len(mesh.cells[k].data) for k in blocks)])
    cells = {}
    for name, sets in mesh.cell_sets.items():
        if name.startswith("gmsh:"):
            continue
        parts = [
            start + np.asarray(sets[k], dtype=np.int64)
            for start, k in zip(offsets[:-1], blocks, strict=True)
            if sets[k] is not None
        ]
        cells[name] = np.concatenate([np.zeros(0, dtype=np.int64), *parts])
    return cells


def titles_kept(mesh):
    """Names of Gmsh's physical groups that another format has kept: see `gmsh.physical_names`."""
    titles = []
    for name, tag in mesh.field_data.items():
        pair = np.ravel(tag)
        if pair.size == 2 and np.all(np.isfinite(pair.astype(float))):
            number, dimension = pair
            titles.append((int(dimension), int(number), name))
    return titles


def merged_cells(cells, entities, data):
    """The cells without repetition.

    MSH 2.2 writes a cell of several groups once for each of them. The same cell twice in one group
    is an error, which is left for the check of the mesh to find.

    Parameters
    ----------
    cells : ndarray of int, shape (k, width)
        Vertices of each cell.
    entities : ndarray of int, shape (k,), or 0
        The geometrical entity of each cell: equal cells on two of them are not merged.
    data : dict of str to ndarray of int
        See `integer_data`.

    Returns
    -------
    cells : ndarray of int, shape (k', width)
    numbers : ndarray of int, shape (k,)
        The new number of each cell.

    Examples
    --------
    Without groups nothing is told twice:

    >>> cells, numbers = merged_cells(np.array([[0, 1, 2], [1, 3, 2]]), 0, {})
    >>> numbers.tolist()
    [0, 1]
    """
    numbers = np.arange(len(cells))
    if len(cells) == 0 or cells.shape[1] != 3 or "gmsh:physical" not in data:
        return cells, numbers
    rows = np.column_stack([entities + 0 * numbers, cells])
    unique, first, same = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    same = same.ravel()
    in_group = np.column_stack([same, data["gmsh:physical"]])
    if len(unique) == len(rows) or len(np.unique(in_group, axis=0)) < len(rows):
        return cells, numbers
    order = np.sort(first)
    return cells[order], np.searchsorted(order, first)[same]
