"""Published numbers against computed ones."""

from decimal import Decimal

from signorini.exceptions import SignoriniError


def compare(published, errors, rates):
    """Compare every published number with the computed one.

    Parameters
    ----------
    published : sequence of mapping
        Rows with cell, quantity (error or slope), norm, element, n, value as printed, unit of the
        last printed digit, and tolerance in those units, all text.
    errors, rates : sequence of mapping
        Rows of errors.csv and rates.csv, all text.

    Returns
    -------
    list of dict
        One row per published number: cell, published, computed, units (the difference, in units of
        the last printed digit), ok (1 or 0).

    Raises
    ------
    SignoriniError
        If a published number has no computed counterpart.
    """
    computed = {
        ("error", norm, row["element"], row["n"]): row[norm]
        for row in errors
        for norm in ("l2", "h1")
    }
    computed |= {
        ("slope", row["norm"], row["element"], ""): row["slope"]
        for row in rates
        if row["kind"] == "mean"
    }
    return [_row(number, computed) for number in published]


def _row(number, computed):
    key = (number["quantity"], number["norm"], number["element"], number["n"])
    if not computed.get(key):
        raise SignoriniError(
            f"check: {number['cell']} was not computed; restore levels, elements and norms of the scene"
        )
    units = (Decimal(computed[key]) - Decimal(number["value"])) / Decimal(number["unit"])
    return {
        "cell": number["cell"],
        "published": number["value"],
        "computed": computed[key],
        "units": f"{units:.3f}",
        "ok": int(abs(units) <= Decimal(number["tolerance"])),
    }


def verdict(rows, source):
    """One line that says how well the published numbers were met.

    Raises
    ------
    SignoriniError
        If a row is not ok: naming each such cell and its distance.
    """
    wrong = [row for row in rows if not int(row["ok"])]
    if wrong:
        cells = "; ".join(
            f"{row['cell']}: published {row['published']}, computed {row['computed']}, {row['units']} units off"
            for row in wrong
        )
        raise SignoriniError(
            f"{source}: {len(wrong)} of {len(rows)} published numbers not met: {cells}"
        )
    errors = [row for row in rows if not row["cell"].endswith("slope")]
    exact = sum(abs(Decimal(row["units"])) <= Decimal("0.5") for row in errors)
    worst = max(rows, key=lambda row: abs(Decimal(row["units"])))
    return (
        f"all {len(rows)} published numbers met, {exact} of {len(errors)} errors to the last printed digit; "
        f"largest distance {worst['units']} units of the last digit ({worst['cell']})"
    )
