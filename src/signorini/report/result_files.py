"""The tables of a scene, errors.csv and rates.csv, with every row that the scene asks for."""

from signorini.errors.norms import RATED
from signorini.errors.rates import KINDS
from signorini.storage import read_csv


def read_errors(path, asked, numbers=()):
    """Read errors.csv.

    Parameters
    ----------
    path : str or Path
    asked : mapping
        ``elements`` and ``levels``: there must be one row for each pair.
    numbers : sequence of str, optional
        Columns that become float; see `read_csv`.

    Raises
    ------
    StorageError
        As `read_csv`.
    """
    return read_csv(path, numbers, every={"element": asked["elements"], "n": asked["levels"]})


def read_rates(path, asked, numbers=()):
    """Read rates.csv in the same way: a row for each of ``elements``, of the rated ``norms``, and
    each kind of slope.

    Raises
    ------
    StorageError
        As `read_csv`.
    """
    norms = [norm for norm in asked["norms"] if norm in RATED]
    return read_csv(
        path, numbers, every={"element": asked["elements"], "norm": norms, "kind": KINDS}
    )
