"""Multigrid only as far as it pays, beside multigrid in full and the fastest route in full."""

from signorini.errors.norms import PAPER_NORMS
from signorini.studies.benchmark.columns import series
from signorini.studies.benchmark.routes import ROUGH, in_full

_STATES = ("total", "total_min", "total_max", "solve", "cycles", "products")


def as_far_as_it_pays(points):
    """Compare solves to discretisation accuracy with those in full, level by level.

    Parameters
    ----------
    points : sequence of dict
        Of `summary.with_errors`, with numbers.

    Returns
    -------
    list of dict
        ``scene``, ``element``, ``n``, ``dofs``; for each norm the error ``rough_l2`` and its ratio
        ``more_l2`` to that in full, None where there is none; ``rough_total``, ``rough_solve``,
        ``rough_cycles`` and so on, and those of multigrid in full, ``full_total`` and so on;
        ``less`` and ``solve_less``, how many times less time is taken in all and by the solve
        alone; ``fastest``, the route in full of least time, its seconds ``fastest_total`` and
        ``sooner``, how many times less time than these is taken; ``pays``, 1 where the ranges of
        the times say so, -1 where they say the opposite, else 0. Only levels on which both were
        measured, and not those where the library could not tell the discretisation error.
    """
    found = []
    curves = series(points)
    for (scene, element, route), rows in curves.items():
        if route != ROUGH:
            continue
        others = _others(curves, scene, element)
        found += [_compared(row, others[row["n"]]) for row in rows if _known(row, others)]
    return found


def _others(curves, scene, element):
    """n -> route -> its row, for the routes in full of a scene and element."""
    others = {}
    for (its_scene, its_element, route), rows in in_full(curves).items():
        if (its_scene, its_element) == (scene, element):
            for row in rows:
                others.setdefault(row["n"], {})[route] = row
    return others


def _known(row, others):
    return not row["note"] and "multigrid" in others.get(row["n"], {})


def _compared(rough, others):
    full, fastest = others["multigrid"], min(others.values(), key=lambda row: row["total"])
    return {
        **{key: rough[key] for key in ("scene", "element", "n", "dofs")},
        **_errors(rough, full),
        **{f"rough_{state}": rough[state] for state in _STATES},
        **{f"full_{state}": full[state] for state in _STATES},
        "less": full["total"] / rough["total"],
        "solve_less": full["solve"] / rough["solve"],
        "fastest": fastest["method"],
        "fastest_total": fastest["total"],
        "sooner": fastest["total"] / rough["total"],
        "pays": _pays(rough, fastest),
    }


def _errors(rough, full):
    errors = {}
    for norm in PAPER_NORMS:
        known = rough[norm] and full[norm]
        errors[f"rough_{norm}"] = rough[norm]
        errors[f"more_{norm}"] = rough[norm] / full[norm] if known else None
    return errors


def _pays(rough, fastest):
    if rough["total_max"] < fastest["total_min"]:
        return 1
    return -1 if rough["total_min"] > fastest["total_max"] else 0


def finest(rows):
    """The finest level with errors of each scene and element.

    Parameters
    ----------
    rows : sequence of dict
        Of `as_far_as_it_pays`.

    Returns
    -------
    list of dict

    Examples
    --------
    >>> row = {"scene": "corner", "element": "P1", "rough_h1": 0.1}
    >>> [found["n"] for found in finest([row | {"n": 8}, row | {"n": 16}])]
    [16]
    """
    last = {}
    for row in rows:
        if row["rough_h1"]:
            last[row["scene"], row["element"]] = row
    return list(last.values())
