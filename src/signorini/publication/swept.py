"""The numbers of a sweep that a manuscript can ask for: their words, and their values."""

import statistics

from signorini.mesh.boundary import labels_of
from signorini.scene.table import computed_norms
from signorini.sweeps.finest import finest_rows
from signorini.sweeps.names import CONTACT, QUANTITY, RATE

SWEEP, LEAST, MEDIAN, GREATEST = "sweep", "least", "median", "greatest"
PLACES = (f"at_{LEAST}", f"at_{GREATEST}")  # the swept value there


def swept_words(document, star):
    """The words of the keys of a sweep's numbers, without `SWEEP`.

    Parameters
    ----------
    document : dict
        A validated scene with a sweep.
    star : str
        What stands for the number of a point.

    Yields
    ------
    tuple of str
        Column of sweep.csv, element, and which number of the column.

    Examples
    --------
    >>> from signorini import load_scene
    >>> document = load_scene("config/scenes/punch-widths.yaml").document
    >>> ("l2", "CR", "greatest") in set(swept_words(document, "*"))
    True
    """
    places = PLACES if _is_over_numbers(document[SWEEP]) else ()
    for name in _columns(document):
        for element in document["elements"]:
            for word in (LEAST, MEDIAN, GREATEST, *places, star):
                yield name, element, word


def _columns(document):
    """The columns of sweep.csv whose numbers have keys."""
    norms = computed_norms(document) if document["truth"]["kind"] != "none" else ()
    rates = [f"{RATE}{norm}" for norm in norms if len(document["levels"]) > 1]
    contact = CONTACT if "contact" in labels_of(document["boundary"]) else ()
    return [*norms, *rates, *contact, *(f"{QUANTITY}{name}" for name in document["quantities"])]


def _is_over_numbers(section):
    """Whether a sweep has one key, and its values are numbers: so has the place of an extreme."""
    if len(section) != 1:
        return False
    (values,) = section.values()
    return isinstance(values, dict) or all(isinstance(value, int | float) for value in values)


def swept_values(document, rows):
    """The numbers of a sweep on the finest level of each point.

    Parameters
    ----------
    document : dict
        A validated scene with a sweep.
    rows : sequence of mapping
        Of sweep.csv, as text.

    Returns
    -------
    dict
        Words as in `swept_words`, the number of a point in place of the star, counted from 1 in the
        order of the rows -> text.

    Examples
    --------
    >>> from signorini import load_scene
    >>> document = load_scene("config/scenes/punch-widths.yaml").document
    >>> row = {"truth.parameters.half_width": "0.2", "element": "CR", "n": "8", "failed": ""}
    >>> rows = [row | {"point": "a", "l2": "0.5"}, row | {"point": "b", "l2": "0.25"}]
    >>> found = swept_values(document, rows)
    >>> found["l2", "CR", "least"], found["l2", "CR", 1], found["l2", "CR", "median"]
    ('0.25', '0.5', '0.375')
    """
    number = {point: k for k, point in enumerate(dict.fromkeys(row["point"] for row in rows), 1)}
    finest = finest_rows(rows)
    found = {}
    for name in _columns(document):
        for element in document["elements"]:
            own = [row for row in finest if row["element"] == element and row.get(name)]
            found |= {(name, element, number[row["point"]]): row[name] for row in own}
            extremes = _extremes(document[SWEEP], own, name) if own else {}
            found |= {(name, element, word): text for word, text in extremes.items()}
    return found


def _extremes(section, rows, name):
    """Least, median and greatest number of a column, and where, if the places are numbers."""
    values = [float(row[name]) for row in rows]
    least, greatest = (rows[values.index(value)] for value in (min(values), max(values)))
    median = repr(statistics.median(values))
    found = {LEAST: least[name], MEDIAN: median, GREATEST: greatest[name]}
    if _is_over_numbers(section):
        (key,) = section
        found |= dict(zip(PLACES, (least[key], greatest[key]), strict=True))
    return found
