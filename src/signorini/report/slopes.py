"""Slopes picked from the rows of rates.csv."""

from signorini.errors.rates import SOUND


def slopes_by_series(rates, kind):
    """Return the slopes of one kind, sound or not.

    Parameters
    ----------
    rates : sequence of mapping
        Rows of rates.csv.
    kind : {"mean", "fit"}

    Returns
    -------
    dict
        (norm, element) -> slope as it stands in the row, dimensionless.

    Examples
    --------
    >>> rates = [{"element": "CR", "norm": "l2", "kind": "mean", "slope": "1.98"}]
    >>> slopes_by_series(rates, "mean")
    {('l2', 'CR'): '1.98'}
    """
    return {(row["norm"], row["element"]): row["slope"] for row in rates if row["kind"] == kind}


def slopes_of(rates, norm, kind):
    """Return the sound slopes of one norm and kind, for the legend of a figure.

    Parameters
    ----------
    rates : sequence of mapping
        Rows of rates.csv.
    norm : str
    kind : {"mean", "fit"}

    Returns
    -------
    dict
        Element -> slope, dimensionless. An element whose errors are round-off is left out.

    Examples
    --------
    >>> row = {"element": "P1", "norm": "l2", "kind": "mean", "slope": 1.9, "floor": "0"}
    >>> slopes_of([row, row | {"element": "CR", "floor": "1"}], "l2", "mean")
    {'P1': 1.9}
    """
    wanted = (norm, kind, SOUND)
    return {
        row["element"]: row["slope"]
        for row in rates
        if (row["norm"], row["kind"], row["floor"]) == wanted
    }
