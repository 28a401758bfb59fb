"""The errors of a scene between the bounds of one fine enclosure, beside published ones."""

from dataclasses import dataclass, replace

from signorini.certificate.certify import certify_level
from signorini.certificate.coarse import CoarseErrors
from signorini.certificate.critical import enclosed_critical_points
from signorini.fem.problem import discretize_on
from signorini.solvers.select import solve

_EXACTLY = {"load_quadrature": "exact", "load_precision": "double"}


@dataclass(frozen=True, eq=False)
class Fine:
    """An enclosure on a fine mesh, of the exact load.

    Attributes
    ----------
    n : int
        Its level.
    errors : CoarseErrors
    radius, dual, primal : float
        The radius of the ball, and the interval of the energy J(u).
    critical : ndarray, shape (k, 2)
        Intervals of x that contain a critical point each.
    """

    n: int
    errors: CoarseErrors
    radius: float
    dual: float
    primal: float
    critical: object


def fine_enclosure(statement, n, method="auto"):
    """Solve and certify a fine level under the exact load.

    Parameters
    ----------
    statement : ProblemStatement
    n : int
    method : str, optional

    Returns
    -------
    Fine
    """
    mesh, exactly = statement.triangulations.level(n), replace(statement, **_EXACTLY)
    u = [solve(discretize_on(mesh, element, exactly), method).u for element in ("P1", "CR")]
    found, enclosure = certify_level(mesh, statement.data, *u)
    certificate = found["P1"]
    return Fine(
        n=n,
        errors=CoarseErrors(enclosure),
        radius=float(enclosure.radius),
        dual=certificate.dual,
        primal=certificate.primal,
        critical=enclosed_critical_points(enclosure),
    )


def rows_of(fine, domain, solutions, published):
    """A row for each solution: its interval, and what was published.

    Parameters
    ----------
    fine : Fine
    domain : Rectangle or Refined
    solutions : sequence of StoredSolution
    published : dict of (str, str, int) to float
        (norm, element, n) -> error; of the full norm ``"h1"``, less that in ``"l2"``, the energy
        error follows by Pythagoras.

    Returns
    -------
    list of dict
        ``element``, ``n``, ``lower``, ``upper``, ``printed`` and ``beyond``: by how much the
        printed error is off the nearest end of the interval, relative to that; 0 within, None
        where nothing was published.
    """
    return [_row(fine, domain, solution, published) for solution in solutions]


def _row(fine, domain, solution, published):
    mesh = domain.level(solution.n)
    low, high = fine.errors.of(mesh, solution.element, solution.u)
    printed = printed_energy(published, solution.element, solution.n)
    row = {"element": solution.element, "n": solution.n, "lower": low, "upper": high}
    return row | {"printed": printed, "beyond": _beyond(printed, low, high)}


def printed_energy(published, element, n):
    """The energy error that published errors in H1 and L2 imply, or None.

    Parameters
    ----------
    published : dict of (str, str, int) to float
        (norm, element, n) -> published error.
    element : {"P1", "CR"}
    n : int

    Returns
    -------
    float or None

    Examples
    --------
    >>> printed_energy({("h1", "CR", 2): 5.0, ("l2", "CR", 2): 3.0}, "CR", 2)
    4.0
    """
    full, part = (published.get((norm, element, n)) for norm in ("h1", "l2"))
    return None if full is None or part is None else (full**2 - part**2) ** 0.5


def _beyond(printed, low, high):
    if printed is None:
        return None
    return min(printed / low - 1.0, 0.0) + max(printed / high - 1.0, 0.0)


def advantage(rows, n):
    """By how much CR's error is smaller than P1's on a level: the interval, and as printed.

    Parameters
    ----------
    rows : sequence of dict
        Of `rows_of`.
    n : int

    Returns
    -------
    low, high, printed : float
        1 - E_CR / E_P1; `printed` is None where nothing was published.

    Examples
    --------
    >>> rows = [
    ...     {"element": "P1", "n": 8, "lower": 1.0, "upper": 1.0, "printed": 1.0},
    ...     {"element": "CR", "n": 8, "lower": 0.75, "upper": 0.75, "printed": 0.5},
    ... ]
    >>> advantage(rows, 8)
    (0.25, 0.25, 0.5)
    """
    p1, cr = (next(r for r in rows if (r["element"], r["n"]) == (e, n)) for e in ("P1", "CR"))
    printed = None
    if p1["printed"] is not None and cr["printed"] is not None:
        printed = 1.0 - cr["printed"] / p1["printed"]
    return 1.0 - cr["upper"] / p1["lower"], 1.0 - cr["lower"] / p1["upper"], printed
