"""What the stability suite promises, beside what it measured."""

from signorini.report.curves import EPS
from signorini.report.document import environment
from signorini.studies.stability.verdicts import ERROR, LIMITS, RESIDUAL, answered, estimated

DIGITS = 11
STEPS = 3
_SENTENCES = "studies/stability/claims.txt.j2"


def claims(success, statuses, digits, extremes):
    """Hold every promise against the rows measured.

    Parameters
    ----------
    success : pandas.DataFrame
        Of `success.measure`.
    statuses, digits : list of dict
        Of `summaries.statuses` and `summaries.digits`.
    extremes : dict
        Kind of extremes -> frame of its rows.

    Returns
    -------
    list of dict
        ``claim``, ``measured``, ``limit``, ``met``.
    """
    checked = _solves(success, statuses)
    checked["digits"] = _all(row["digits"] >= DIGITS for row in digits)
    checked |= _scales(**{kind: extremes[kind] for kind in ("scaling", "sizes", "offsets")})
    checked |= _contact(extremes["critical-points"], extremes["contact-sets"])
    checked |= _walk(extremes["walk"])
    sentences = _sentences(extremes)
    return [{"claim": sentences[name]} | row for name, row in checked.items()]


def _sentences(extremes):
    text = (
        environment()
        .get_template(_SENTENCES)
        .render(
            limits=LIMITS,
            digits=DIGITS,
            steps=STEPS,
            powers=extremes["scaling"]["power"],
            sizes=extremes["sizes"]["value"],
            critical_points=extremes["critical-points"]["critical_points"],
        )
    )
    return dict(line.split(": ", 1) for line in text.splitlines())


def _solves(success, statuses):
    ours = success[success["solver"].str.startswith("ours")]
    answers = ours[ours["claimed"] > 0]
    return {
        "answered": _all(answered(ours[ours["solver"] == "ours"])),
        "routes": _all(answered(ours)),
        "wrong": _number(sum(row["wrong"] for row in statuses), 0),
        "wrong_side": _number(int(sum(row["wrong_side"] for row in statuses)), 0),
        "accuracy": _all(estimated(answers)),
        "force_accuracy": _all(estimated(answers, "multiplier_")),
    }


def _scales(scaling, sizes, offsets):
    moved, refused = (offsets[(offsets["refused"] == "") == solved] for solved in (True, False))
    return {
        "scaling": _all(scaling["different"] == 0),
        "sizes": _number(sizes["change"].max(), 1e-12),
        "moved": _number((moved["change"] / (EPS * moved["value"])).max(), 1),
        "unresolved": _all(refused["refused"].str.contains("coordinate resolution")),
    }


def _contact(points, sets):
    as_expected = (sets["active"] == sets["expected"]) & (sets["iterations"] <= STEPS)
    return {
        "critical_points": _number(points["residual"].max(), RESIDUAL),
        "contact_sets": _all(as_expected),
    }


def _walk(rows):
    """Inaccurate is right where rounding u alone, beside a constant, takes what is missing."""
    no_room = (rows["status"] == "inaccurate") & (rows["stored"] > 0.1 * ERROR)
    distance = rows["difference"] / (1e-14 * rows["condition"])
    return {
        "walk": _all((rows["status"] == "solved") | no_room),
        "bvls": _number(distance[rows["status"] != "refused"].max(), 1),
    }


def _all(good):
    good = list(good)
    measured = f"{sum(good)} of {len(good)}"
    return {"measured": measured, "limit": "all", "met": bool(good) and all(good)}


def _number(value, limit):
    shown = str(value) if isinstance(value, int) else f"{value:.1e}"
    return {"measured": shown, "limit": f"{limit:g}", "met": bool(value <= limit)}
