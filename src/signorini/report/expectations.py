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

    Examples
    --------
    >>> rates = [{"element": "P1", "norm": "l2", "slope": 1.96}]
    >>> check_expectations({"slopes": {"l2": 2}, "tolerance": 0.1}, [], rates, "errors.csv")
    'as expected: P1 l2 1.96'
    """
    rates = [row for row in rates if row["norm"] in expected["slopes"]]
    sizes = [
        (float(row[norm]), row["element"], row["n"], norm)
        for row in errors
        for norm in RATED
        if row.get(norm)
    ]
    bound = expected.get("errors_below", float("inf"))
    wrong = [*_no_slopes(rates), *_wrong_slopes(rates, expected), *_large_errors(sizes, bound)]
    if wrong:
        raise SignoriniError(
            f"{source}: not as the scene expects: {'; '.join(wrong)}; "
            "correct the scene, or its section expect"
        )
    slopes = [f"{row['element']} {row['norm']} {row['slope']:.2f}" for row in rates]
    return f"as expected: {', '.join(slopes) or f'largest error {max(sizes)[0]:.1e}'}"


def _no_slopes(rates):
    for row in rates:
        trouble = trouble_of(row)
        if trouble != SOUND:
            yield f"{row['element']} {row['norm']} {_NO_SLOPE[trouble]}"


def _wrong_slopes(rates, expected):
    tolerance = expected["tolerance"]
    for row in rates:
        slope = expected["slopes"][row["norm"]]
        # "not <=", so that NaN is wrong, too.
        if trouble_of(row) == SOUND and not abs(row["slope"] - slope) <= tolerance:
            yield (
                f"{row['element']} {row['norm']} slope {row['slope']:.3f}, "
                f"expected {slope:g} within {tolerance:g}"
            )


def _large_errors(sizes, bound):
    for size, element, n, norm in sizes:
        if not size < bound:
            yield f"{element} n = {n} {norm} error {size:.2e}, expected below {bound:g}"
