"""The page of the theory study: the numbers that fill ``page.md.j2``."""

import math

from signorini.report.document import render
from signorini.studies.theory.estimates import ESTIMATES

PAGE = "studies/theory/page.md.j2"
_BETTER = 0.5  # order in h from which on a constant that falls says that more is true
_BOUNDED = 0.12  # order in h up to which a constant is called bounded
_TERMS = ("D1", "D2", "A")


def page(layout, estimates, terms, traces, quick=False):
    """Put the page together.

    Parameters
    ----------
    layout : {"markdown", "latex"}
    estimates, terms : list of dict
        Of `estimates.estimates_of`, each row with its ``scene``; numbers are numbers.
    traces : list of dict
        Of `traces.trace_rows`.
    quick : bool, optional
        Whether these are coarse levels only.

    Returns
    -------
    str
    """
    scenes = list(dict.fromkeys(row["scene"] for row in estimates))
    constants = {
        each.name: {scene: _constants(estimates, each.name, scene) for scene in scenes}
        for each in ESTIMATES
    }
    return render(
        PAGE,
        layout,
        scenes=scenes,
        levels=sorted({int(row["n"]) for row in estimates}),
        constants=constants,
        verdicts={name: verdict(found) for name, found in constants.items()},
        last_change={
            name: max(_last_change(row) for row in of.values()) for name, of in constants.items()
        },
        edges=_edges(terms, scenes),
        shares=_shares(terms, scenes),
        traces=_sharp(traces),
        half=_half(traces),
        quick=quick,
    )


def _constants(estimates, statement, scene):
    """The constants of a statement on a scene, coarsest first."""
    return [
        row["constant"]
        for row in estimates
        if row["statement"] == statement and row["scene"] == scene
    ]


def order(values):
    """The power of h with which positive numbers fall, from the first to the last level.

    Parameters
    ----------
    values : sequence of float
        Each of half the mesh width of the one before.

    Returns
    -------
    float or None
        None where one of the ends is not positive, or there is one level only.

    Examples
    --------
    >>> order([8.0, 4.0, 2.0])
    1.0
    """
    if len(values) < 2 or min(values[0], values[-1]) <= 0.0:
        return None
    return math.log2(values[0] / values[-1]) / (len(values) - 1)


def _worst_order(constants):
    """The least order over the scenes that have one."""
    return min((o for o in map(order, constants.values()) if o is not None), default=None)


def verdict(constants):
    """What numbers say of a statement.

    Parameters
    ----------
    constants : dict of str to sequence of float
        Scene -> smallest constants, coarsest first.

    Returns
    -------
    {"better", "bounded", "falls", "grows"}
        "falls" is less than half an order, "better" is more, on every scene where the left side is
        positive.
    """
    least = _worst_order(constants)
    if least is None or least >= _BETTER:
        return "better"
    if least > _BOUNDED:
        return "falls"
    return "bounded" if least >= -_BOUNDED else "grows"


def _last_change(values):
    """Relative change over the last halving of h."""
    return abs(values[-1] / values[-2] - 1.0) if len(values) > 1 and values[-2] else 0.0


def _edges(terms, scenes):
    """Contact edges on the finest level: scene -> binding, free, mixed."""
    finest = {scene: [row for row in terms if row["scene"] == scene][-1] for scene in scenes}
    names = ("binding", "free", "mixed")
    return {scene: [int(row[name]) for name in names] for scene, row in finest.items()}


def _shares(terms, scenes):
    """Scene -> term -> its share of the squared error on the coarsest and the finest level."""
    found = {}
    for scene in scenes:
        rows = [row for row in terms if row["scene"] == scene]
        ends = rows[0], rows[-1]
        found[scene] = {term: [row[term] / row["error"] ** 2 for row in ends] for term in _TERMS}
    return found


def _sharp(traces):
    """The best constants of Lemma 3.1 and (3.5), by the largest space."""
    of_space = [row for row in traces if row["space"] == "polynomials"]
    return {row["statement"]: row["constant"] for row in of_space}


def _half(traces):
    """Constants of (3.6): h -> number of cosines -> (greatest, counterexample)."""
    found = {}
    for row in traces:
        if row["statement"] == "(3.6)":
            of_size = found.setdefault(row["h"], {}).setdefault(int(row["size"]), {})
            of_size[row["space"]] = row["constant"]
    return found
