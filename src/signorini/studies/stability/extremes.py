"""Extremes: scales and places far from one, many critical points, contact sets without choice."""

from dataclasses import replace

import numpy as np

from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import SignoriniError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.generated.statements import grid, square, statement
from signorini.solvers import kkt_residual, solve
from signorini.solvers.attempts import solutions

_WAVES = {
    "f": "6*sin(5*{x} + 2*{y}) + 3*cos(7*{y}) - 2",
    "g": "cos(3*{x} - {y}) - 0.8",
    "obstacle": "0.1*cos(6*{x}) - 0.1",
}
_N = 16


def scaling(powers):
    """Load, obstacle and Dirichlet values times 2**k: u, force and errors must scale bit for bit.

    Returns
    -------
    list of dict
        Per element, route and power: ``different``, numbers that differ in any bit after scaling
        back.

    Examples
    --------
    Powers of two change no bit:

    >>> {row["different"] for row in scaling([3, -7])}
    {0}
    """
    rows = []
    for element in ELEMENTS:
        problem, coarse = (discretize(_waves(), element, n) for n in (_N, _N // 2))
        for method, _ in solutions(problem):
            identity = {"element": element, "method": method}
            base = _numbers(problem, coarse, method)
            for power in powers:
                scaled = _numbers(_times(problem, power), _times(coarse, power), method)
                different = int(np.sum(np.ldexp(base, power) != scaled))
                rows.append(identity | {"power": power, "different": different})
    return rows


def _numbers(problem, coarse, method):
    """u, contact force, and the errors of a coarser solution."""
    solution, coarse_u = solve(problem, method), solve(coarse, method).u
    truth = ReferenceErrors(problem.mesh, problem.element, solution.u)
    errors = truth.of(coarse.mesh, coarse.element, coarse_u)
    return np.concatenate([solution.u, solution.multiplier, list(errors.values())])


def _times(problem, power):
    names = ("b", "lower", "fixed_values")
    return replace(problem, **{name: np.ldexp(getattr(problem, name), power) for name in names})


def domains(sizes, offsets):
    """The same body in other units of length, and at other places.

    It must have the same u, or an error that names the reason.

    Parameters
    ----------
    sizes, offsets : sequence of float
        Side lengths of the square, and both coordinates of its corner.

    Returns
    -------
    list of dict
        Per element, route and ``size`` or ``offset``: ``change``, largest relative change of u; or
        ``refused``, the first words of the error.
    """
    cases = [("size", size, _waves(size=size)) for size in sizes]
    cases += [("offset", offset, _waves(offset=offset)) for offset in offsets]
    rows = []
    for element in ELEMENTS:
        for method, base in solutions(discretize(_waves(), element, _N)):
            identity = {"element": element, "method": method}
            for kind, value, moved in cases:
                row = identity | {"kind": kind, "value": value}
                rows.append(row | _change_of_u(moved, element, method, base.u))
    return rows


def _change_of_u(statement, element, method, before):
    """The largest relative change of u, or why there is none."""
    try:
        u = solve(discretize(statement, element, _N), method).u
    except SignoriniError as error:
        return {"change": None, "refused": str(error)}
    return {"change": float(np.max(np.abs(u - before)) / np.max(np.abs(before))), "refused": ""}


def _waves(size=1.0, offset=0.0):
    """The unit square's problem, told in coordinates X = offset + size x."""
    x, y = (f"(({name} - ({offset!r}))/({size!r}))" for name in "xy")
    data = {name: text.format(x=x, y=y) for name, text in _WAVES.items()}
    data |= {"f": f"({data['f']})/({size!r})**2", "g": f"({data['g']})/({size!r})"}
    return statement(data, domain=square(size, offset))


def many_critical_points(periods, cells=16):
    """A strip of so many periods of a wave that lifts and presses: two critical points to a period.

    Parameters
    ----------
    periods : sequence of int
    cells : int, optional
        Per period.

    Returns
    -------
    list of dict
        Per element: ``periods``, ``contact`` unknowns, ``critical_points`` found, ``iterations``,
        ``residual``.
    """
    rows = []
    for element in ELEMENTS:
        for count in periods:
            strip = grid(cells * count, cells, width=float(count))
            problem = discretize_on(strip, element, statement({"f": "20*sin(2*pi*x)"}))
            solution = solve(problem)
            row = {"element": element, "periods": count, "contact": problem.contact.size}
            row["critical_points"] = int(np.sum(solution.active[1:] != solution.active[:-1]))
            row["iterations"] = solution.iterations
            rows.append(row | {"residual": kkt_residual(problem, solution.u)[0]})
    return rows


def contact_sets():
    """Contact sets that leave no choice: empty, full, a single unknown.

    Returns
    -------
    list of dict
        Per element, route and case: ``contact`` unknowns, those ``active``, those ``expected`` to
        be, ``iterations``.

    Examples
    --------
    Every contact set without a choice is found:

    >>> all(row["active"] == row["expected"] for row in contact_sets())
    True
    """
    return [
        {"element": element, "method": method, "case": case, "contact": problem.contact.size}
        | {"active": int(solution.active.sum()), "expected": expected}
        | {"iterations": solution.iterations}
        for element in ELEMENTS
        for case, (problem, expected) in _without_choice(element).items()
        for method, solution in solutions(problem)
    ]


def _without_choice(element):
    """Case -> (problem, how many unknowns must be in contact)."""
    lifted, pressed, unloaded = (
        discretize_on(grid(_N, _N), element, statement({"f": f})) for f in (1, -1, 0)
    )
    size = lifted.contact.size
    peak = np.where(np.arange(size) == size // 3, 1.0, 0.0)
    return {
        "empty": (lifted, 0),
        "full": (pressed, size),
        "zero": (unloaded, size),
        "single": (replace(lifted, lower=peak), 1),
    }
