"""Which elements a figure shows."""

from signorini.figures.style import ELEMENT_STYLES


def elements_in(rows):
    """Return the names of the elements in rows of a table, in the order of their appearance.

    Parameters
    ----------
    rows : sequence of mapping
        With ``element``.

    Returns
    -------
    list of str

    Raises
    ------
    ValueError
        If an element has no style here.

    Examples
    --------
    >>> elements_in([{"element": "CR"}, {"element": "P1"}, {"element": "CR"}])
    ['CR', 'P1']
    """
    names = list(dict.fromkeys(row["element"] for row in rows))
    for name in names:
        if name not in ELEMENT_STYLES:
            known = ", ".join(ELEMENT_STYLES)
            raise ValueError(f"no style for the element {name!r}; known: {known}")
    return names
