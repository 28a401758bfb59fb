"""The rows of a sweep on the finest level of each point."""

from signorini.sweeps.names import FAILED


def finest_rows(rows):
    """Of each point and element the row of the finest level, in the order of the rows.

    Parameters
    ----------
    rows : sequence of mapping
        Of sweep.csv, texts or numbers; those of points that failed are left out.

    Returns
    -------
    list of mapping

    Examples
    --------
    >>> row = {"point": "f=1", "element": "CR", "failed": ""}
    >>> [found["n"] for found in finest_rows([row | {"n": 4}, row | {"n": 8}])]
    [8]
    """
    finest = {}
    for row in rows:
        if row[FAILED]:
            continue
        place = row["point"], row["element"]
        if place not in finest or int(row["n"]) > int(finest[place]["n"]):
            finest[place] = row
    return list(finest.values())
