"""The suite's tables: frames of what the jobs measured, grouped and summarised."""

import numpy as np

from signorini.errors.norms import PARTS_OF_H1
from signorini.fem.elements import ELEMENTS
from signorini.report.curves import EPS
from signorini.studies.stability.verdicts import accurate, answered, estimated

TOLERANCES = (1e-6, 1e-9)
SHIFT = 0.01  # seconds; of the shifted geometric mean
_KIND = ["family", "element"]
_CELL = ["element", "n", "norm"]
_LAST = 4  # levels that an order is fitted to


def solvers(rows, time_limit):
    """What every solver achieved.

    Parameters
    ----------
    rows : pandas.DataFrame
        Of `success.measure`.
    time_limit : float
        What a problem counts that is not solved to the last of `TOLERANCES`, in seconds.

    Returns
    -------
    list of dict
        Per solver: ``problems``; ``solved_1e-06`` and ``solved_1e-09``, shares claimed solved with
        a residual of at most that; ``ordinary_1e-09``, the same without the loads tiny and huge;
        ``unclaimed``, problems with a residual of at most 1e-9 that the solver reports as failed;
        ``wrong``, problems called solved with a residual above 1e-6; ``warned``, answers with such
        a residual that the solver calls inaccurate (ours alone can); ``seconds``, shifted geometric
        mean; ``median_iterations`` and ``most_iterations``.
    """
    groups = dict(list(rows.groupby("solver")))
    return [
        {"solver": name} | _achieved(groups[name], time_limit) for name in in_order(rows["solver"])
    ]


def in_order(names):
    """Names of solvers without repetition, ours first.

    Examples
    --------
    >>> in_order(["bvls", "ours", "ours/direct"])
    ['ours', 'ours/direct', 'bvls']
    """
    return sorted(dict.fromkeys(names), key=lambda name: not name.startswith("ours"))


def solved_to(rows, tolerance=TOLERANCES[-1]):
    """Whether each is claimed solved, with a residual of at most a tolerance.

    Parameters
    ----------
    rows : pandas.DataFrame
    tolerance : float, optional
        Dimensionless, as `kkt_residual` is.

    Returns
    -------
    pandas.Series of bool
    """
    return (rows["claimed"] > 0) & (rows["residual"] <= tolerance)


def _achieved(rows, time_limit):
    loose, tight = (solved_to(rows, tolerance) for tolerance in TOLERANCES)
    claimed, warned = rows["claimed"] > 0, rows["status"] == "inaccurate"
    spent = rows["seconds"].where(tight, time_limit).to_numpy()
    return {
        "problems": len(rows),
        "solved_1e-06": float(loose.mean()),
        "solved_1e-09": float(tight.mean()),
        "ordinary_1e-09": float(tight[~rows["load"].isin(["tiny", "huge"])].mean()),
        "unclaimed": int((~claimed & (rows["residual"] <= TOLERANCES[-1])).sum()),
        "wrong": int((claimed & ~loose & ~warned).sum()),
        "warned": int((claimed & ~loose & warned).sum()),
        "seconds": float(np.expm1(np.mean(np.log1p(spent / SHIFT))) * SHIFT),
        "median_iterations": float(rows["iterations"].median()),
        "most_iterations": int(rows["iterations"].max()),
    }


def _by_kind(rows):
    """Our solves by every route, of each family and element."""
    ours = rows[rows["solver"].str.startswith("ours/")]
    for kind, own in ours.groupby(_KIND, sort=False):
        yield dict(zip(_KIND, kind, strict=True)), own


def statuses(rows):
    """What our statuses are worth, over all routes.

    Returns
    -------
    list of dict
        Per family and element: ``solutions``; ``solved``, ``inaccurate`` and ``refused``, how many
        are called so; ``solved_error``, ``solved_multiplier_error`` and ``inaccurate_error``, the
        largest true errors among them; ``wrong``, solved but not `accurate`, or with a contact dof
        on the wrong side; ``needed``, inaccurate and not `accurate`; ``unneeded``, not `answered`;
        ``wrong_side``, ``undecided`` and ``needless``, contact dofs of all answers.
    """
    return [kind | _status(own) for kind, own in _by_kind(rows)]


def _status(rows):
    solved, inaccurate, refused = (
        rows[rows["status"] == name] for name in ("solved", "inaccurate", "refused")
    )
    right = accurate(solved) & (solved["wrong_side"] == 0)
    counted = rows.loc[rows["status"] != "refused", ["wrong_side", "undecided", "needless"]].sum()
    return {
        "solutions": len(rows),
        "solved": len(solved),
        "solved_error": _most(solved["error"], 0.0),
        "solved_multiplier_error": _most(solved["multiplier_error"], 0.0),
        "wrong": int((~right).sum()),
        "inaccurate": len(inaccurate),
        "inaccurate_error": _most(inaccurate["error"], None),
        "needed": int((~accurate(inaccurate)).sum()),
        "refused": len(refused),
        "unneeded": int((~answered(rows)).sum()),
        **counted,
    }


def _most(values, otherwise):
    return float(values.max()) if values.size else otherwise


def estimates(rows):
    """How well our solutions know their errors, over all routes.

    Returns
    -------
    list of dict
        Per family and element, for u and, under the prefix ``multiplier_``, for the multiplier:
        ``median``, the median of accuracy over error; ``least`` and ``most``, its extremes, an
        error below the floor counting as so much in the last; ``missed``, answers not `estimated`.
    """
    kinds = []
    for kind, own in _by_kind(rows):
        answers = own[own["claimed"] > 0]
        row = kind | {"answers": len(answers)}
        for which in ("", "multiplier_"):
            row |= {f"{which}{name}": value for name, value in _ratios(answers, which).items()}
        kinds.append(row)
    return kinds


def _ratios(answers, which):
    stated, error, floor = (answers[f"{which}{name}"] for name in ("accuracy", "error", "floor"))
    exact = (stated / error)[error > 0]
    return {
        "median": float(exact.median()) if exact.size else None,
        "least": float(exact.min()) if exact.size else None,
        "most": float((stated / np.fmax(error, floor)).max()) if len(answers) else None,
        "missed": int((~estimated(answers, which)).sum()),
    }


def digits(rows):
    """Digits of the table that no variant changes.

    Parameters
    ----------
    rows : pandas.DataFrame
        Of `digits.variant`, ``auto`` among them.

    Returns
    -------
    list of dict
        Per cell ``element``, ``n``, ``norm`` and ``value``; ``digits`` = -log10 of the largest
        relative change, at most that of one rounding; and the same per variant,
        ``digits_<variant>``.
    """
    base = rows[rows["variant"] == "auto"].set_index(_CELL)["value"]
    others = rows[rows["variant"] != "auto"].join(base.rename("base"), on=_CELL)
    others["change"] = (others["value"] / others["base"] - 1.0).abs()
    changes = others.pivot_table("change", _CELL, "variant", aggfunc="max")
    stable = -np.log10(changes[others["variant"].unique()].clip(lower=EPS))
    return [
        dict(zip(_CELL, cell, strict=True))
        | {"value": value, "digits": stable.loc[cell].min()}
        | stable.loc[cell].add_prefix("digits_").to_dict()
        for cell, value in base.items()
    ]


def crossings(rows):
    """Where the error would meet round-off if both went on as on the finest levels.

    Parameters
    ----------
    rows : pandas.DataFrame
        Of `round_off.errors`: the families smooth, and patch, which is round-off alone.

    Returns
    -------
    list of dict
        Per ``element`` and ``norm``: ``order`` of the error, ``floor`` on the finest level, the
        growth ``floor_order`` of the floor, and ``h``, the mesh width where they would meet; the
        last two None for a floor of zero.
    """
    by_kind = dict(list(rows.sort_values("n").set_index("n").groupby(_KIND)))
    meetings = []
    for element in [element for element in ELEMENTS if ("smooth", element) in by_kind]:
        for norm in PARTS_OF_H1:
            smooth, floor = (by_kind[family, element][norm] for family in ("smooth", "patch"))
            (order, error), (slope, least) = (_power(own.tail(_LAST)) for own in (smooth, floor))
            meeting = (least / error) ** (1.0 / (order - slope)) if least else None
            row = {"element": element, "norm": norm, "order": -order, "floor": floor.iloc[-1]}
            meetings.append(row | {"floor_order": slope, "h": 1.0 / meeting if meeting else None})
    return meetings


def growth(rows, column, by="n"):
    """Fit powers by least squares: ``column = factor * by**exponent``.

    Parameters
    ----------
    rows : pandas.DataFrame
    column, by : str

    Returns
    -------
    dict
        Element to (exponent, factor), where there are at least two positive values.
    """
    powers = {
        element: _power(own.set_index(by)[column])
        for element, own in rows.groupby("element", sort=False)
    }
    return {element: power for element, power in powers.items() if power[0] is not None}


def _power(values):
    """Exponent and factor of a power of the index."""
    positive = values[values > 0]
    if len(positive) < 2:
        return None, None
    exponent, offset = np.polyfit(np.log(positive.index), np.log(positive.to_numpy()), 1)
    return float(exponent), float(np.exp(offset))
