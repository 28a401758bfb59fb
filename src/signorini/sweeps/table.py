"""All points of a sweep in one table: a row for each point, element and level."""

from signorini.sweeps.names import FAILED


def sweep_rows(section, records):
    """The rows of sweep.csv.

    Parameters
    ----------
    section : dict
        The section ``sweep`` of a scene.
    records : sequence of dict
        See `records.solve_points`.

    Returns
    -------
    list of dict
        ``point``, its name; the swept keys; the columns of `Solver.rows`, None where a point does
        not have them; and ``failed``, the message of a point that could not be solved, which has
        one row.

    Examples
    --------
    >>> solved = {"point": "f=1", "values": {"data.f": 1}, "rows": [{"n": 2}], "failed": None}
    >>> failed = {"point": "f=2", "values": {"data.f": 2}, "rows": [], "failed": "no"}
    >>> for row in sweep_rows({"data.f": [1, 2]}, [solved, failed]):
    ...     print(row)
    {'point': 'f=1', 'data.f': 1, 'n': 2, 'failed': None}
    {'point': 'f=2', 'data.f': 2, 'n': None, 'failed': 'no'}
    """
    columns = _columns(records)
    rows = []
    for record in records:
        place = {"point": record["point"]} | {key: record["values"][key] for key in section}
        for found in record["rows"] or [{}]:
            own = {name: found.get(name) for name in columns}
            rows.append(place | own | {FAILED: record["failed"]})
    return rows


def failures(records):
    """The points that could not be solved, as lines for a person.

    Parameters
    ----------
    records : sequence of dict
        See `records.solve_points`.

    Returns
    -------
    list of str

    Examples
    --------
    >>> record = {"point": "f=1", "values": {"data.f": 1}, "failed": "unbounded"}
    >>> failures([record, record | {"failed": None}])
    ['point f=1 (data.f = 1): unbounded']
    """
    lines = []
    for record in records:
        if record["failed"]:
            values = ", ".join(f"{key} = {value}" for key, value in record["values"].items())
            lines.append(f"point {record['point']} ({values}): {record['failed']}")
    return lines


def _columns(records):
    """The columns of all rows, each next to its neighbours in the rows that have it."""
    layouts = {tuple(row): None for record in records for row in record["rows"]}
    columns = []
    for layout in layouts:
        place = 0
        for name in layout:
            if name in columns:
                place = columns.index(name) + 1
            else:
                columns.insert(place, name)
                place += 1
    return columns
