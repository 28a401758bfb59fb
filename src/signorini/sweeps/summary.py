"""What a sweep comes to: of each quantity on the finest level the least, the median and the
greatest value, and where.
"""

import pandas as pd

from signorini.errors.norms import RATED
from signorini.sweeps.names import CONTACT, QUANTITY, RATE

SUMMED = (*RATED, *(f"{RATE}{norm}" for norm in RATED), *CONTACT)
_COLUMNS = (
    "element",
    "quantity",
    "points",
    "least",
    "at_least",
    "median",
    "greatest",
    "at_greatest",
)


def summary(rows):
    """The summary of a sweep.

    Parameters
    ----------
    rows : sequence of dict
        See `table.sweep_rows`.

    Returns
    -------
    pandas.DataFrame
        A row for each element and quantity: the number of ``points`` that have it on their finest
        level, its ``least``, ``median`` and ``greatest`` value, and the names of the points with
        the first and the last, ``at_least`` and ``at_greatest``.

    Examples
    --------
    >>> row = {"element": "CR", "n": 4, "failed": None}
    >>> rows = [row | {"point": f"f={k}", "resultant": k / 2} for k in (1, 2, 4)]
    >>> summary(rows)[["least", "median", "greatest"]].values.tolist()
    [[0.5, 1.0, 2.0]]
    """
    table = pd.DataFrame(rows)
    solved = table[table["failed"].isna()]
    if not len(solved):
        return pd.DataFrame(columns=_COLUMNS)
    finest = solved.loc[solved.groupby(["point", "element"], sort=False)["n"].idxmax()]
    lines = []
    for element, own in finest.groupby("element", sort=False):
        own = own.set_index("point")
        names = [name for name in SUMMED if name in own]
        names += [name for name in own if name.startswith(QUANTITY)]
        lines += [_line(element, name, own[name]) for name in names]
    return pd.DataFrame([line for line in lines if line], columns=_COLUMNS)


def _line(element, name, column):
    """A row of the summary, or None where no point has the quantity."""
    values = pd.to_numeric(column).dropna()
    if not len(values):
        return None
    low, high = values.idxmin(), values.idxmax()
    return (
        *(element, name, len(values)),
        *(float(values[low]), low, float(values.median()), float(values[high]), high),
    )


def as_markdown(frame):
    """A summary as a Markdown table, numbers with five digits.

    Parameters
    ----------
    frame : pandas.DataFrame
        Of `summary`.

    Returns
    -------
    str

    Examples
    --------
    >>> import pandas as pd
    >>> print(as_markdown(pd.DataFrame({"n": [8], "l2": [0.123456789]})), end="")
    | n | l2 |
    | :--- | :--- |
    | 8 | 0.12346 |
    """
    lines = ["| " + " | ".join(frame.columns) + " |", "|" + " :--- |" * len(frame.columns)]
    for row in frame.itertuples(index=False):
        cells = [f"{value:.5g}" if isinstance(value, float) else str(value) for value in row]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
