"""The tables of a scene, errors.csv and rates.csv, with every row that belongs to the scene."""

from signorini.errors.norms import RATED
from signorini.errors.rates import KINDS
from signorini.storage import read_csv


def read_errors(path, sections, numbers=()):
    """Read errors.csv.

    Parameters
    ----------
    path : str or Path
    sections : mapping
        Sections ``elements`` and ``levels`` of the scene: there must be one row for each pair.
    numbers : sequence of str, optional
        Columns that become float; see `read_csv`.

    Returns
    -------
    list of dict

    Raises
    ------
    StorageError
        As `read_csv`.
    """
    return read_csv(path, numbers, every={"element": sections["elements"], "n": sections["levels"]})


def read_rates(path, sections, numbers=()):
    """Read rates.csv.

    Parameters
    ----------
    path : str or Path
    sections : mapping
        Sections ``elements`` and ``norms`` of the scene: there must be a row for each element,
        each norm whose slope is taken, and each kind of slope.
    numbers : sequence of str, optional
        Columns that become float; see `read_csv`.

    Returns
    -------
    list of dict

    Raises
    ------
    StorageError
        As `read_csv`.
    """
    norms = [norm for norm in sections["norms"] if norm in RATED]
    every = {"element": sections["elements"], "norm": norms, "kind": KINDS}
    return read_csv(path, numbers, every=every)
