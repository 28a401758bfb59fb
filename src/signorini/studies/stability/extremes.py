"""Extremes: scales, domains and places far from one, thousands of critical points, contact sets
without choice.
"""

import warnings
from dataclasses import replace

import numpy as np

from signorini.errors.reference import ReferenceErrors
from signorini.exceptions import SignoriniError, SolverError
from signorini.fem.elements import ELEMENTS
from signorini.fem.problem import discretize, discretize_on
from signorini.mesh.grid import SIDES, Grid
from signorini.scene.statement import ProblemStatement
from signorini.solvers import METHODS, kkt_residual, solve

_LABELS = ("contact", "neumann", "dirichlet", "neumann")
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
    """
    rows = []
    for element in ELEMENTS:
        problem, coarse = (discretize(_statement(), element, n) for n in (_N, _N // 2))
        for method in METHODS:
            if applies(problem, method):
                base = _numbers(problem, coarse, method)
                for power in powers:
                    scaled = _numbers(_times(problem, power), _times(coarse, power), method)
                    different = sum(
                        int(np.sum(np.ldexp(a, power) != b))
                        for a, b in zip(base, scaled, strict=True)
                    )
                    rows.append(
                        {
                            "element": element,
                            "method": method,
                            "power": power,
                            "different": different,
                        }
                    )
    return rows


def _numbers(problem, coarse, method):
    """u, contact force, and the errors of a coarser solution."""
    solution, coarse_u = solve(problem, method), solve(coarse, method).u
    found = ReferenceErrors(problem.mesh, problem.element, solution.u).of(
        coarse.mesh, coarse.element, coarse_u
    )
    return solution.u, solution.multiplier, np.array(list(found.values()))


def _times(problem, power):
    return replace(
        problem, **{k: np.ldexp(getattr(problem, k), power) for k in ("b", "lower", "fixed_values")}
    )


def domains(sizes, offsets):
    """The same body in other units of length, and at other places: the same u, or an error that
    names the reason.

    Returns
    -------
    list of dict
        Per element, route and ``size`` or ``offset``: ``change``, largest relative change of u; or
        ``refused``, the first words of the error.
    """
    rows = []
    cases = [("size", size, size, 0.0) for size in sizes] + [
        ("offset", offset, 1.0, offset) for offset in offsets
    ]
    for element in ELEMENTS:
        base = discretize(_statement(), element, _N)
        for method in METHODS:
            if not applies(base, method):
                continue
            u = solve(base, method).u
            for kind, value, size, offset in cases:
                row = {
                    "element": element,
                    "method": method,
                    "kind": kind,
                    "value": value,
                    "change": None,
                    "refused": "",
                }
                try:
                    other = solve(discretize(_statement(size, offset), element, _N), method).u
                    row["change"] = float(np.max(np.abs(other - u)) / np.max(np.abs(u)))
                except SignoriniError as error:
                    row["refused"] = str(error)
                rows.append(row)
    return rows


def _statement(size=1.0, offset=0.0):
    """The unit square's problem, told in coordinates X = offset + size x."""
    x, y = (f"(({name} - ({offset!r}))/({size!r}))" for name in "xy")
    data = {name: text.format(x=x, y=y) for name, text in _WAVES.items()} | {"dirichlet": 0}
    data |= {"f": f"({data['f']})/({size!r})**2", "g": f"({data['g']})/({size!r})"}
    domain = {
        "origin": [offset, offset],
        "size": [size, size],
        "diagonal": "falling",
        "cells": "per-side",
    }
    mapping = {"domain": domain, "boundary": dict(zip(SIDES, _LABELS, strict=True)), "data": data}
    return ProblemStatement.from_mapping(mapping | {"load_quadrature": "exact"})


def many_critical_points(periods, cells=16):
    """A strip of so many periods of a wave that lifts and presses: two critical points to a period.

    Returns
    -------
    list of dict
        Per element: ``periods``, ``contact`` unknowns, ``critical_points`` found, ``iterations``,
        ``residual``.
    """
    rows = []
    for element in ELEMENTS:
        for count in periods:
            grid = Grid(cells * count, cells, (0.0, 0.0), (float(count), 1.0), "falling", _LABELS)
            problem = discretize_on(grid, element, _data({"f": "20*sin(2*pi*x)"}))
            solution = solve(problem)
            changes = int(np.sum(solution.active[1:] != solution.active[:-1]))
            what = {
                "element": element,
                "periods": count,
                "contact": problem.contact.size,
                "critical_points": changes,
            }
            rows.append(
                what
                | {
                    "iterations": solution.iterations,
                    "residual": kkt_residual(problem, solution.u)[0],
                }
            )
    return rows


def contact_sets():
    """Contact sets that leave no choice: empty, full, a single unknown.

    Returns
    -------
    list of dict
        Per element, route and case: ``contact`` unknowns, those ``active``, those ``expected`` to
        be, ``iterations``.
    """
    rows = []
    for element in ELEMENTS:
        for case, data in {
            "empty": {"f": 1},
            "full": {"f": -1},
            "zero": {},
            "single": {"f": 1},
        }.items():
            problem = _on_grid(element, data)
            size = problem.contact.size
            if case == "single":
                problem = replace(problem, lower=np.where(np.arange(size) == size // 3, 1.0, 0.0))
            expected = {"empty": 0, "full": size, "zero": size, "single": 1}[case]
            for method in METHODS:
                if applies(problem, method):
                    solution = solve(problem, method)
                    what = {"element": element, "method": method, "case": case, "contact": size}
                    active = int(solution.active.sum())
                    rows.append(
                        what
                        | {
                            "active": active,
                            "expected": expected,
                            "iterations": solution.iterations,
                        }
                    )
    return rows


def _on_grid(element, data):
    return discretize_on(
        Grid(_N, _N, (0.0, 0.0), (1.0, 1.0), "falling", _LABELS), element, _data(data)
    )


def _data(data):
    zero = {"f": 0, "g": 0, "dirichlet": 0, "obstacle": 0}
    return ProblemStatement.from_mapping(
        {"domain": {}, "boundary": {}, "data": zero | data, "load_quadrature": "exact"}
    )


def applies(problem, method):
    """Whether a route of `METHODS` takes a problem."""
    try:
        solve(problem, method)
    except SolverError as error:
        if "does not apply" in str(error):
            return False
        raise
    return True


def walk(examples):
    """A random walk over the space of scenes, each solution held against BVLS on the condensed
    problem.

    Parameters
    ----------
    examples : int

    Returns
    -------
    list of dict
        Per problem and route: ``element``, ``dofs``, ``contact``, ``active``, ``condition`` of the
        condensed matrix, ``difference`` of the two solutions relative to the larger of u and the
        minimum without contact, ``residual``, ``status``. A refusal counts as the status
        ``refused``.
    """
    from hypothesis import HealthCheck, Phase, given, settings

    from signorini.studies.stability.scenes import problems

    rows = []

    @settings(
        max_examples=examples,
        derandomize=True,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(problems())
    def visit(problem):
        rows.extend(compare(problem))

    visit()
    return rows


def compare(problem):
    """A problem solved by every route that applies, and by BVLS; see `walk`."""
    u, condition, size = oracle(problem)
    rows = []
    for method in METHODS:
        row = {
            "element": problem.element,
            "dofs": problem.b.size,
            "contact": problem.contact.size,
            "method": method,
        }
        row |= {
            "active": None,
            "condition": condition,
            "difference": None,
            "residual": None,
            "status": "refused",
            "stored": 0.0,
        }
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                solution = solve(problem, method)
        except SolverError as error:
            if "does not apply" not in str(error):
                rows.append(row)
            continue
        row |= {
            "active": int(solution.active.sum()),
            "residual": solution.residual,
            "status": solution.status,
        }
        row |= {
            "stored": np.finfo(float).eps
            * float(np.max(np.abs(solution.u)) / (np.ptp(solution.u) or np.inf))
        }
        rows.append(row | {"difference": float(np.max(np.abs(solution.u - u))) / size})
    return rows


def oracle(problem):
    """The minimiser by dense elimination and bounded least squares (BVLS) on Cholesky's factor.

    Parameters
    ----------
    problem : Problem
        Small, with contact unknowns.

    Returns
    -------
    u : ndarray, shape (ndof,)
    condition : float
        Of the stiffness matrix on the free unknowns, one of them held where no Dirichlet part holds
        the body.
    size : float
        Of the terms that u is made of, unit of u.
    """
    A, c, i = problem.A.toarray(), problem.contact, np.setdiff1d(problem.free, problem.contact)
    u = np.zeros(problem.b.size)
    u[problem.fixed], u[c] = problem.fixed_values, problem.lower
    load = problem.b - A @ u
    coupling = np.linalg.solve(A[np.ix_(i, i)], A[np.ix_(i, c)])
    S = A[np.ix_(c, c)] - A[np.ix_(c, i)] @ coupling
    w = _bounded(0.5 * (S + S.T), load[c] - coupling.T @ load[i], floating=not problem.fixed.size)
    u[c] += w
    u[i] += np.linalg.solve(A[np.ix_(i, i)], load[i]) - coupling @ w
    held = problem.free[: -1 if not problem.fixed.size else None]
    K = A[np.ix_(held, held)]
    sizes = (u, np.linalg.solve(K, load[held]), problem.lower)
    return (
        u,
        float(np.linalg.cond(K)),
        max(float(np.max(np.abs(v), initial=0.0)) for v in sizes) or 1.0,
    )


def _bounded(S, q, floating):
    """Minimise w'Sw/2 - q'w over w >= 0; a floating body touches somewhere, so every unknown is
    held in turn.
    """
    from scipy.optimize import lsq_linear

    if floating:
        best = []
        for k in range(q.size):
            rest, w = np.arange(q.size) != k, np.zeros(q.size)
            w[rest] = _bounded(S[np.ix_(rest, rest)], q[rest], floating=False)
            best.append((0.5 * w @ S @ w - q @ w, k, w))
        return min(best)[2]
    if not q.size:
        return q
    L = np.linalg.cholesky(S)
    return lsq_linear(
        L.T, np.linalg.solve(L, q), (0, np.inf), method="bvls", tol=1e-15, max_iter=1000
    ).x
