"""Ways in which a program could have differed from ours in the last digits.

Each is a choice beyond the five that the table shows. Made for the reference alone or for all
solutions, it moves the errors by some units of their last printed digits.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from signorini.fem.function import Function
from signorini.fem.load import assemble_load, triangle_integrals
from signorini.fem.mirror import mirrored
from signorini.fem.precision import LoadPrecision, to_single
from signorini.fem.problem import discretize_on
from signorini.fem.quadrature import triangle_rule
from signorini.formula import Formula
from signorini.solvers import solve
from signorini.studies.sensitivity.relaxation import relax
from signorini.studies.sensitivity.slowest_mode import slowest_mode

NONE, SINGLE = "none", "load in single precision"
MODE, SOR = "too low in its slowest mode", "projected SOR"
_OMEGA, _TOLERANCE, _SHIFT = 1.9, 1e-12, 6e-9


@dataclass(frozen=True)
class Hypothesis:
    """A way to compute a discrete solution.

    Parameters
    ----------
    name : str
        In words.
    solution : callable
        From a `ProblemStatement`, an element and a level to (mesh, u).
    of_all : bool
        Whether it makes sense for all solutions, or for the reference alone.
    quick : bool
        Whether the quick variant of the study has it.
    """

    name: str
    solution: Callable
    of_all: bool = True
    quick: bool = False


def plain(statement, element, n):
    """The solution as the library computes it; (mesh, u).

    Parameters
    ----------
    statement : ProblemStatement
    element : {"P1", "CR"}
    n : int

    Returns
    -------
    mesh : Grid or Triangulation
    u : ndarray, shape (ndof,)
    """
    problem = _problem(statement, element, n)
    return problem.mesh, solve(problem).u


def _problem(statement, element, n):
    return discretize_on(statement.triangulations.level(n), element, statement)


def _restated(change, statement, element, n):
    """Solve another statement."""
    return plain(change(statement), element, n)


def _reloaded(load, statement, element, n):
    """Solve with another load vector."""
    problem = _problem(statement, element, n)
    return problem.mesh, solve(problem.with_data(b=load(statement, problem))).u


def _rounded(change, statement, element, n):
    """Change the solution afterwards."""
    mesh, u = plain(statement, element, n)
    return mesh, change(u)


def _solved(solver, statement, element, n):
    """Solve the same problem in another way."""
    problem = _problem(statement, element, n)
    if problem.upper:
        return problem.mesh, -solver(mirrored(problem))
    return problem.mesh, solver(problem)


# Other statements.


def _in_single(statement):
    return replace(statement, load_precision="single")


def _with_pi(text, statement):
    """pi cut or rounded to a number."""
    f = re.sub(r"\bpi\b", text, statement.data.f.text)
    return _with_f(statement, Formula(f, "data.f"))


def _with_points(change, statement):
    """f at points whose coordinates are changed."""
    f = statement.data.f
    return _with_f(statement, Function(lambda x, y: f(change(x), change(y)), "data.f"))


def _with_f(statement, f):
    return replace(statement, data=replace(statement.data, f=f))


# Other loads.


def _with_precision(precision, statement, problem):
    data = statement.data
    element, rule = problem.finite_element, statement.load_quadrature
    return assemble_load(problem.mesh, element, data.f, data.g, rule, precision)


def _assembled_in_single(statement, problem):
    return to_single(problem.b)


def _added_in_single(statement, problem):
    """Shares and their sums in single precision, cell after cell from the bottom row up."""
    mesh, element = problem.mesh, problem.finite_element
    points, weights = triangle_rule(statement.load_quadrature)
    f = Function(lambda x, y: to_single(statement.data.f(x, y)), "data.f")
    shares = triangle_integrals(mesh, f, points, element.shape(points) * weights)
    cell_by_cell = [_by_cells(mesh, part) for part in (element.triangle_dofs(mesh), shares)]
    dofs, shares = cell_by_cell
    b = np.zeros(problem.b.size, dtype=np.float32)
    np.add.at(b, dofs, shares.astype(np.float32))
    return b.astype(float)


def _by_cells(grid, values):
    """Values (3, nt) of a grid, the two triangles of a cell after each other; (3 nt,)."""
    return values.reshape(3, 2, -1).transpose(2, 1, 0).ravel()


def _with_weight(third, statement, problem):
    """A weight that is not quite a third."""
    return 3.0 * third * problem.b


# Other solvers.


def _relaxed(problem):
    return relax(problem, _OMEGA, _TOLERANCE).u


def _penalised(penalty, problem):
    """The constraint by a penalty: where it binds, u is below the obstacle by force / penalty."""
    pushed = problem
    for _ in range(3):  # each is nearer by a factor of about the penalty
        multiplier = solve(pushed).multiplier
        pushed = problem.with_data(lower=problem.lower - multiplier / penalty)
    return solve(pushed).u


def _lowered(problem):
    """Too low in the slowest mode of a solver that stops early."""
    return solve(problem).u - _SHIFT * slowest_mode(problem)


def _decimals(number):
    return Hypothesis(
        f"solutions stored with {number} decimals",
        partial(_rounded, partial(np.round, decimals=number)),
    )


def _pi(text):
    return Hypothesis(f"pi = {text}", partial(_restated, partial(_with_pi, text)))


def _thirds(text):
    third = float(text)
    return (
        Hypothesis(f"weight {text}", partial(_reloaded, partial(_with_weight, third))),
        Hypothesis(
            f"abscissae {text}",
            partial(_restated, partial(_with_points, lambda x: 3.0 * third * x)),
        ),
    )


def _penalty(size):
    name = f"contact by a penalty of {_number(size)}"
    return Hypothesis(name, partial(_solved, partial(_penalised, size)))


def _number(value):
    """As 6e-9 or 1e12."""
    digit, exponent = f"{value:.0e}".split("e")
    return f"{digit}e{int(exponent)}"


def _load(name, load):
    return Hypothesis(f"{SINGLE}: {name}", partial(_reloaded, load))


HYPOTHESES = (
    Hypothesis(NONE, plain, quick=True),
    Hypothesis(SINGLE, partial(_restated, _in_single), quick=True),
    _load("f alone", partial(_with_precision, LoadPrecision(values=to_single))),
    _load("shares of triangles alone", partial(_with_precision, LoadPrecision(shares=to_single))),
    _load("the assembled vector alone", _assembled_in_single),
    _load("f, shares and their sums", _added_in_single),
    Hypothesis(
        "coordinates in single precision", partial(_restated, partial(_with_points, to_single))
    ),
    Hypothesis(
        "pi in single precision",
        partial(_restated, partial(_with_pi, repr(float(to_single(np.pi))))),
    ),
    *map(_pi, ("3.1415926", "3.1415927", "3.14159265")),
    *_thirds(".333333"),
    *_thirds(".33333333"),
    *map(_decimals, (8, 9, 10)),
    Hypothesis("solutions in single precision", partial(_rounded, to_single)),
    *map(_penalty, (1e6, 1e8, 1e10, 1e12)),
    Hypothesis(f"{MODE}, by {_number(_SHIFT)}", partial(_solved, _lowered), of_all=False),
    Hypothesis(
        f"{SOR}, omega = {_OMEGA:g}, until moves are below {_number(_TOLERANCE)}",
        partial(_solved, _relaxed),
    ),
)
