"""What a scene expects of its own results."""

from signorini.errors.norms import RATED, REFERENCE
from signorini.errors.rates import NO_LOGARITHM, ROUND_OFF, SOUND, trouble_of
from signorini.exceptions import SignoriniError

_NO_SLOPE = {
    ROUND_OFF: "errors are round-off and have no slope, expect errors_below instead",
    REFERENCE: "errors have no slope, the finest level is the reference itself; raise truth.n",
    NO_LOGARITHM: "distances have no slope, one is zero or infinite; expect none",
}


def check_expectations(expected, errors, rates, source):
    """Compare results with the section ``expect`` of a scene.

    Parameters
    ----------
    expected : dict
        ``slopes`` (norm -> slope), ``tolerance``, and perhaps ``errors_below``.
    errors, rates : sequence of mapping
        Rows of errors.csv (text) and rates.csv, of one kind of slope, slopes as numbers or None.
    source : str or Path
        The file to name in errors.

    Returns
    -------
    str
        One line that says what was found.

    Raises
    ------
    SignoriniError
        Listing all that is off.
    """
    rates = [row for row in rates if row["norm"] in expected["slopes"]]
    wrong = [
        f"{row['element']} {row['norm']} {_NO_SLOPE[trouble_of(row)]}"
        for row in rates
        if trouble_of(row) != SOUND
    ]
    near = f"within {expected['tolerance']:g}"
    wrong += [
        f"{row['element']} {row['norm']} slope {row['slope']:.3f}, expected {expected['slopes'][row['norm']]:g} {near}"
        for row in rates
        if trouble_of(row) == SOUND
        and not abs(row["slope"] - expected["slopes"][row["norm"]]) <= expected["tolerance"]
    ]
    bound = expected.get("errors_below", float("inf"))
    sizes = [
        (float(row[norm]), row["element"], row["n"], norm)
        for row in errors
        for norm in RATED
        if row.get(norm)
    ]
    wrong += [
        f"{element} n = {n} {norm} error {size:.2e}, expected below {bound:g}"
        for size, element, n, norm in sizes
        if not size < bound
    ]
    if wrong:
        found = "; ".join(wrong)
        raise SignoriniError(
            f"{source}: not as the scene expects: {found}; correct the scene, or its section expect"
        )
    found = [f"{row['element']} {row['norm']} {row['slope']:.2f}" for row in rates]
    return "as expected: " + (", ".join(found) if found else f"largest error {max(sizes)[0]:.1e}")
