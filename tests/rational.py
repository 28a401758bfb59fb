"""Small Signorini problems solved by rational numbers: without any rounding, and by trying every
contact set.
"""

from fractions import Fraction
from itertools import product

import numpy as np

from signorini.fem.elements import find_element
from signorini.mesh.grid import Grid


def exact_solution(problem):
    """The solution of a problem with few contact dofs, its data taken as exact.

    Returns
    -------
    u, multiplier : list of Fraction
    active : tuple of bool
    """
    A, c = _matrix(problem), list(problem.contact)
    inner = [k for k in problem.free if k not in set(c)]
    u = [Fraction(0)] * problem.b.size
    for dofs, values in ((problem.fixed, problem.fixed_values), (problem.contact, problem.lower)):
        for dof, value in zip(dofs, values, strict=True):
            u[dof] = Fraction(float(value))
    load = _residual(A, problem.b, u)
    order = inner + c
    system = [[A[i][j] for j in order] + [load[i]] for i in order]
    _eliminate(system, len(inner))
    S = [row[len(inner) :] for row in system[len(inner) :]]
    gap, active = _contact(S)
    moved = _back(system, len(inner), gap)
    for dof, value in zip(order, moved + gap, strict=True):
        u[dof] += value
    return u, [-r for r in (_residual(A, problem.b, u)[k] for k in c)], active


def _matrix(problem):
    """The stiffness matrix, by cotangents of exact coordinates."""
    mesh, dofs = problem.mesh, find_element(problem.element).triangle_dofs(problem.mesh)
    A = [[Fraction(0)] * problem.b.size for _ in range(problem.b.size)]
    x, y = _coordinates(mesh)
    for triangle, vertices in enumerate(mesh.t.T):
        p = [(x[v], y[v]) for v in vertices]
        edges = [
            (p[k - 1][0] - p[k - 2][0], p[k - 1][1] - p[k - 2][1]) for k in range(3)
        ]  # opposite vertex k
        area = abs(edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]) / 2
        factor = Fraction(
            1 if problem.coefficient is None else float(problem.coefficient[triangle])
        ) / (4 * area)
        places = dofs[:, triangle] if problem.element == "P1" else dofs[[1, 2, 0], triangle]
        factor *= 1 if problem.element == "P1" else 4
        for i, j in product(range(3), repeat=2):
            A[places[i]][places[j]] += factor * (
                edges[i][0] * edges[j][0] + edges[i][1] * edges[j][1]
            )
    return A


def _coordinates(mesh):
    if not isinstance(mesh, Grid):
        return [[Fraction(float(value)) for value in row] for row in mesh.p]
    along = [
        [Fraction(float(start)) + Fraction(float(size)) * k / n for k in range(n + 1)]
        for start, size, n in zip(mesh.origin, mesh.size, (mesh.nx, mesh.ny), strict=True)
    ]
    return [x for _ in along[1] for x in along[0]], [y for y in along[1] for _ in along[0]]


def _residual(A, b, u):
    return [
        Fraction(float(value)) - sum(a * v for a, v in zip(row, u, strict=True) if a)
        for value, row in zip(b, A, strict=True)
    ]


def _eliminate(system, count):
    for k in range(count):
        for i in range(k + 1, len(system)):
            if factor := system[i][k] / system[k][k]:
                system[i] = [a - factor * b for a, b in zip(system[i], system[k], strict=True)]


def _back(system, count, kept):
    values = list(kept)
    for k in range(count - 1, -1, -1):
        known = sum(a * v for a, v in zip(system[k][k + 1 : -1], values, strict=True))
        values.insert(0, (system[k][-1] - known) / system[k][k])
    return values[:count]


def _contact(rows):
    """The one w >= 0 with S w - q >= 0 and no product of the two, and where w = 0; rows are those
    of S and q.
    """
    size = len(rows)
    for active in product((False, True), repeat=size):
        free = [k for k in range(size) if not active[k]]
        system = [[rows[i][j] for j in free] + [rows[i][-1]] for i in free]
        try:
            _eliminate(system, len(free))
            values = _back(system, len(free), [])
        except ZeroDivisionError:  # nothing holds the body
            continue
        w = [Fraction(0)] * size
        for k, value in zip(free, values, strict=True):
            w[k] = value
        force = [sum(s * v for s, v in zip(row[:-1], w, strict=True)) - row[-1] for row in rows]
        if min([*w, *(force[k] for k in range(size) if active[k])]) >= 0:
            return w, active
    raise AssertionError("no contact set; the matrix is positive definite, so there is one")


def rounded(values):
    """Rational numbers in extended precision."""
    return np.array([_rounded(value) for value in values])


def _rounded(value):
    high = float(value)
    return np.longdouble(high) + np.longdouble(float(value - Fraction(high)))
