"""Tables: CSV files with a header, read as lists of dicts."""

import csv
import io
from collections import Counter
from itertools import product

from signorini.exceptions import StorageError
from signorini.storage.files import read_bytes, read_sealed, write_text


def write_csv(path, rows):
    """Write a table, and its digest; floats keep every digit.

    Parameters
    ----------
    path : path-like
    rows : list of dict
        At least one, all with the same keys; None becomes an empty field.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_csv(f"{folder}/errors.csv", [{"element": "P1", "n": 2, "l2": 0.1}])
    ...     read_csv(f"{folder}/errors.csv", numbers=["l2"])
    [{'element': 'P1', 'n': '2', 'l2': 0.1}]
    """
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_text(path, text.getvalue())


def read_csv(path, numbers=(), every=None):
    """Read the list of dicts that `write_csv` wrote.

    Parameters
    ----------
    path : path-like
    numbers : sequence of str, optional
        Columns that become float, or None where empty; the others are text.
    every : dict of str to sequence, optional
        Columns and values, each combination of which must have one row: ``{"element": ["P1"], "n":
        [2, 4]}``.

    Returns
    -------
    list of dict

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or lacks a row.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     write_csv(f"{folder}/a.csv", [{"n": 2, "l2": 0.5}, {"n": 4, "l2": 0.125}])
    ...     [row["l2"] for row in read_csv(f"{folder}/a.csv", numbers=["l2"])]
    [0.5, 0.125]
    """
    return _parsed(path, read_sealed(path), numbers, every or {})


def read_table(path, numbers=()):
    """Read a table that anyone wrote, which has no digest.

    Parameters
    ----------
    path, numbers
        As of `read_csv`.

    Returns
    -------
    list of dict

    Raises
    ------
    StorageError
        If the file is missing or cut off.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "mine.csv").write_text("n,l2\\n2,0.1\\n")
    ...     read_table(f"{folder}/mine.csv", numbers=["l2"])
    [{'n': '2', 'l2': 0.1}]
    """
    return _parsed(path, read_bytes(path), numbers, {})


def _parsed(path, content, numbers, every):
    try:
        rows = _complete_rows(content.decode("utf-8"))
        if every:
            _check_combinations(rows, every)
        for row in rows:
            row.update({key: float(row[key]) if row[key] else None for key in numbers})
    except (KeyError, TypeError, ValueError, csv.Error) as error:
        raise StorageError(
            f"{path}: not a readable table ({error}); mend it, or delete it and rerun"
        ) from error
    return rows


def _complete_rows(text):
    """The rows of a table, of which there is one at least, and none is cut off."""
    rows = list(csv.DictReader(io.StringIO(text)))
    # A line with too few fields has values None, one with too many the key None.
    whole = all(None not in (*row, *row.values()) for row in rows)
    if not (rows and whole and text.endswith("\n")):
        raise ValueError("a line is missing, or cut off")
    return rows


def _check_combinations(rows, every):
    """Refuse a table that has not exactly one row for each combination of values."""
    counts = Counter(tuple(row[column] for column in every) for row in rows)
    for values in product(*every.values()):
        count = counts[tuple(map(str, values))]
        if count != 1:
            wanted = [f"{column} {value}" for column, value in zip(every, values, strict=True)]
            rows_found = f"{count} rows" if count else "no row"
            raise ValueError(f"{rows_found} for {', '.join(wanted)}")
