"""Published numbers against computed ones."""

from dataclasses import dataclass
from decimal import Decimal, InvalidOperation

from signorini.exceptions import SignoriniError
from signorini.wording import cut

EXACT = Decimal("0.5")  # units of the last printed digit: up to here all printed digits agree


def compare(published, numbers):
    """Compare every published number with the computed one.

    Parameters
    ----------
    published : iterable of Published
    numbers : mapping
        Key -> computed number as text, as `numbers.read_numbers` returns it.

    Returns
    -------
    list of dict
        One row per published number: cell, published, computed, units (the difference, in units of
        the last printed digit), ok (1 or 0).

    Raises
    ------
    SignoriniError
        If a published number has no computed counterpart.

    Examples
    --------
    >>> from signorini.publication.published import Published
    >>> compare([Published("l2", "P1", "2", "0.101", "1")], {"l2, P1, 2": "0.1014"})[0]["units"]
    '0.400'
    """
    return [_row(number, numbers) for number in published]


def _row(number, numbers):
    computed = numbers.get(number.key)
    if not computed:
        raise SignoriniError(
            f"check: {number.cell} was not computed; "
            "restore levels, elements and norms of the scene"
        )
    units = (_finite(computed, number.cell) - Decimal(number.value)) / number.unit
    return {
        "cell": number.cell,
        "published": number.value,
        "computed": computed,
        "units": f"{units:.3f}",
        "ok": int(abs(units) <= Decimal(number.tolerance)),
    }


def _finite(text, cell):
    """A computed number, which NaN or a word is not."""
    try:
        value = Decimal(text)
    except InvalidOperation:
        value = Decimal("nan")
    if not value.is_finite():
        raise SignoriniError(
            f"check: {cell}: {cut(text)!r} is no number; delete the table that has it, and rerun"
        )
    return value


def verdict(rows, source):
    """Say in one line how well the published numbers were met.

    Parameters
    ----------
    rows : sequence of mapping
        What `compare` returned, numbers or text.
    source : str or Path
        The file to name in errors.

    Returns
    -------
    str

    Raises
    ------
    SignoriniError
        If a row is not ok: naming each such cell and its distance.

    Examples
    --------
    >>> check = [{"cell": "a", "units": "-0.68", "ok": "1"}]
    >>> print(verdict(check, "check.csv"))
    all 1 published numbers met, 0 of 1 errors to the last printed digit; largest distance ...
    """
    _refuse_missed(rows, source)
    summary = check_summary(rows)
    errors = [row for row in rows if "slope" not in row["cell"].split()]
    exact = f"{_count_exact(errors)} of {len(errors)} errors to the last printed digit"
    worst = max(rows, key=_distance)
    return (
        f"all {summary.total} published numbers met{f', {exact}' if errors else ''}; "
        f"largest distance {worst['units']} units of the last digit ({worst['cell']})"
    )


def _refuse_missed(rows, source):
    missed = [row for row in rows if not _is_met(row)]
    if not missed:
        return
    cells = "; ".join(
        f"{row['cell']}: published {row['published']}, computed {row['computed']}, "
        f"{row['units']} units off"
        for row in missed
    )
    raise SignoriniError(
        f"{source}: {len(missed)} of {len(rows)} published numbers not met: {cells}; "
        "change the scene, or what was typed wrong, or allow a larger tolerance there"
    )


@dataclass(frozen=True)
class CheckSummary:
    """How many published numbers were met, and the largest deviation in units of the last digit."""

    total: int
    matched: int
    exact: int
    largest: float
    largest_cell: str

    def __str__(self):
        return (
            f"{self.matched} of {self.total} published numbers matched, "
            f"{self.exact} of them in every digit; largest deviation {self.largest:.2f} "
            f"units of the last digit ({self.largest_cell})"
        )


def check_summary(check):
    """Sum up the rows of ``check.csv``.

    Parameters
    ----------
    check : sequence of mapping
        Rows with ``cell``, ``units`` (deviation in units of the last printed digit) and ``ok``.

    Returns
    -------
    CheckSummary
        A number is exact if it is at most half a unit off.

    Raises
    ------
    ValueError
        If there are no rows.

    Examples
    --------
    >>> summary = check_summary([{"cell": "a", "units": "-0.68", "ok": 1}])
    >>> summary.matched, summary.exact, summary.largest
    (1, 0, 0.68)
    """
    if not check:
        raise ValueError("check: no published number was compared")
    worst = max(check, key=_distance)
    return CheckSummary(
        total=len(check),
        matched=sum(map(_is_met, check)),
        exact=_count_exact(check),
        largest=float(_distance(worst)),
        largest_cell=worst["cell"],
    )


def _count_exact(rows):
    return sum(_distance(row) <= EXACT for row in rows)


def _distance(row):
    """From the published number, in units of its last printed digit."""
    return abs(Decimal(str(row["units"])))


def _is_met(row):
    return str(row["ok"]).lower() in ("true", "1")
