"""What the stability suite promises, held against what it measured."""

from signorini.studies.stability.proof import (
    ERROR,
    OVERESTIMATE,
    RESIDUAL,
    UNDERESTIMATE,
    answered,
    estimated,
)
from signorini.studies.stability.round_off import EPS

DIGITS = 11
STEPS = 3


def claims(success, statuses, digits, extremes):
    """Hold every promise against the rows measured.

    Parameters
    ----------
    success, statuses, digits : list of dict
        Of `stability_success.measure`, `stability_proof.statuses` and `stability_digits.digits`.
    extremes : dict
        Kind of extremes -> rows of `stability_extremes`.

    Returns
    -------
    list of dict
        ``claim``, ``measured``, ``limit``, ``met``.
    """
    ours = [row for row in success if row["solver"].startswith("ours")]
    unasked = [row for row in ours if row["solver"] == "ours"]
    return [
        _all(
            f"generated problems solved, KKT residual at most {RESIDUAL:g}; or called inaccurate or refused where "
            "double precision can do no better",
            unasked,
            answered,
        ),
        _all("the same by every route that applies", ours, answered),
        _number(
            f"solutions called solved with an error of u or of the contact forces above {ERROR:g}, or a contact set "
            "that is wrong",
            sum(row["wrong"] for row in statuses),
            0,
        ),
        _number(
            "contact unknowns decided for the wrong side, in any answer",
            int(sum(row["wrong_side"] for row in statuses)),
            0,
        ),
        *_estimates([row for row in ours if row["claimed"]]),
        _all(
            f"numbers of Table 5.1 with at least {DIGITS} stable digits",
            digits,
            lambda row: row["digits"] >= DIGITS,
        ),
        *_places(extremes),
        *_contact(extremes),
        *_walk(extremes["walk"]),
    ]


def _estimates(answers):
    span = (
        f"at least 1/{UNDERESTIMATE:g} of the error; at most {OVERESTIMATE:g} times it, where no contact unknown is "
        "undecided"
    )
    return [
        _all(
            f"accuracy {of}, as stated: {span}",
            answers,
            lambda row, which=which: estimated(row, which),
        )
        for which, of in (("", "of u"), ("multiplier_", "of the contact forces"))
    ]


def _places(extremes):
    moved = [row for row in extremes["offsets"] if not row["refused"]]
    refused = [row for row in extremes["offsets"] if row["refused"]]
    shift = max(row["change"] / (EPS * row["value"]) for row in moved)
    powers = [row["power"] for row in extremes["scaling"]]
    sizes = [row["value"] for row in extremes["sizes"]]
    return [
        _all(
            f"data times 2^k, k from {min(powers):.0f} to {max(powers):.0f}: u, force and errors scale bit for bit",
            extremes["scaling"],
            lambda row: row["different"] == 0,
        ),
        _number(
            f"unit of length from {min(sizes):g} to {max(sizes):g}: relative change of u",
            max(row["change"] for row in extremes["sizes"]),
            1e-12,
        ),
        _number(
            "body moved: relative change of u, in units of eps times offset over size", shift, 1
        ),
        _all(
            "body moved until the coordinates cannot resolve its cells: refused for that reason",
            refused,
            lambda row: "coordinate resolution" in row["refused"],
        ),
    ]


def _contact(extremes):
    points = extremes["critical-points"]
    return [
        _number(
            f"up to {max(row['critical_points'] for row in points):.0f} critical points: KKT residual",
            max(row["residual"] for row in points),
            RESIDUAL,
        ),
        _all(
            f"contact sets empty, full, of one unknown: found, in at most {STEPS} steps",
            extremes["contact-sets"],
            lambda row: row["active"] == row["expected"] and row["iterations"] <= STEPS,
        ),
    ]


def _walk(rows):
    solved = [row for row in rows if row["status"] != "refused"]
    distance = max(row["difference"] / (1e-14 * row["condition"]) for row in solved)
    return [
        _all("random scenes solved, to what u has room for", rows, _solved_or_stored),
        _number(
            "random scenes: distance from BVLS, in units of 1e-14 times condition", distance, 1
        ),
    ]


def _solved_or_stored(row):
    """Whether a row is solved; or inaccurate where rounding u alone, beside a constant, takes what
    is missing.
    """
    return row["status"] == "solved" or (
        row["status"] == "inaccurate" and row["stored"] > 0.1 * ERROR
    )


def _all(claim, rows, good):
    count = sum(map(good, rows))
    return {
        "claim": claim,
        "measured": f"{count} of {len(rows)}",
        "limit": "all",
        "met": 0 < count == len(rows),
    }


def _number(claim, value, limit):
    shown = str(value) if isinstance(value, int) else f"{value:.1e}"
    return {"claim": claim, "measured": shown, "limit": f"{limit:g}", "met": bool(value <= limit)}
