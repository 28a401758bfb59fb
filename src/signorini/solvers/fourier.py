"""The fourier route: uniform rectangles with equal conditions on the two sides beside the contact side.

Along the contact side, cosines (or sines) diagonalise the stiffness matrix; away from it, each of them leaves a
tridiagonal matrix. One elimination sweep towards the contact side leaves S w - q = lambda there, S diagonal in
the same basis; the inequality is solved on that line alone, and one sweep back gives u. CR first eliminates its
edges parallel to the axes, which leaves the same matrix on the diagonal edges. No matrix is assembled. After
Buzbee, Golub and Nielson, On direct methods for solving Poisson's equations, SIAM J. Numer. Anal. 7 (1970).
"""

from dataclasses import dataclass

import numpy as np

from signorini.solvers import transforms
from signorini.solvers.contact import solve_contact
from signorini.solvers.count import count
from signorini.solvers.spectral import contact_operator
from signorini.stencil import apply_stiffness

_OPPOSITE = {"bottom": "top", "top": "bottom", "left": "right", "right": "left"}
_BESIDE = {"bottom": ("left", "right"), "left": ("bottom", "top")}


@dataclass(frozen=True)
class _Strip:
    """A grid turned so that its contact side lies at row 0; `along` runs on that side, `away` from it."""

    side: str
    near: str
    far: str
    beside: str
    along: int
    away: int
    k_along: float
    k_away: float

    def turn(self, rows):
        """Turn an array of the grid (row 0 at the bottom) so that row 0 lies on the contact side; undone by `back`."""
        rows = rows[:, ::-1].T if self.side == "right" else rows.T if self.side == "left" else rows
        return rows[::-1] if self.side == "top" else rows

    def back(self, rows):
        rows = rows[::-1] if self.side == "top" else rows
        return rows.T[:, ::-1] if self.side == "right" else rows.T if self.side == "left" else rows


def obstruction(problem):
    """Say why the route does not apply to a problem, or None where it does."""
    grid = problem.grid
    if grid is None:
        return "the mesh is not a uniform grid" if problem.coefficient is None else "the coefficient is not 1"
    if len(grid.sides("contact")) > 1:
        return "more than one side is in contact"
    if min(grid.nx, grid.ny) < 2:
        return "the grid is a single cell wide"
    return None if _strip(grid) else "the two sides beside the contact side differ in kind"


def _strip(grid):
    labels = dict(zip(("bottom", "right", "top", "left"), grid.labels, strict=True))
    hx, hy = grid.spacing
    for side in grid.sides("contact") or ("bottom", "left"):
        vertical = side in ("left", "right")
        beside = {labels[name] for name in _BESIDE["left" if vertical else "bottom"]}
        if len(beside) == 1:
            along, away = (grid.ny, grid.nx) if vertical else (grid.nx, grid.ny)
            kx, ky = hy / hx, hx / hy
            k = (ky, kx) if vertical else (kx, ky)
            return _Strip(side, labels[side], labels[_OPPOSITE[side]], beside.pop(), along, away, *k)
    return None


def solve_fourier(problem, guess=None):
    """Solve a problem for which `obstruction` is None.

    Parameters
    ----------
    problem : Problem
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind.

    Returns
    -------
    u : ndarray, shape (ndof,)
    active : ndarray of bool, shape (nc,)
    iterations : int
        Active-set steps.
    accuracy : float
        Zero: no matrix entry is rounded, and stretched cells cost no digits.

    Raises
    ------
    SolverError
        If the active-set iteration does not end.
    """
    strip = _strip(problem.grid)
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    u[problem.contact] = problem.lower
    load = _load(problem, u)
    route = (_Vertices if problem.element == "P1" else _Edges)(problem.grid, strip)
    rows = route.basis.forward(route.reduce(load) / route.basis.mass)
    count(factorisations=1)
    factors, symbol = route.eliminate(rows)
    gap, active, iterations = np.zeros(0), np.zeros(0, dtype=bool), 0
    if problem.contact.size:
        q = route.basis.mass * route.basis.backward(rows[0])
        singular = problem.fixed.size == 0
        result = solve_contact(contact_operator(route.basis, symbol), q, guess=guess, singular=singular)
        gap, active, iterations = result.w, result.active, result.iterations
        rows[0] = route.basis.forward(gap)
    else:
        rows[0] /= symbol
    for j in range(1, rows.shape[0]):
        rows[j] += factors[j] * rows[j - 1]
    u += route.extend(route.basis.backward(rows))
    u[problem.contact] = problem.lower + gap
    return u, active, iterations, 0.0


def _load(problem, u):
    """b - A u, where u may be zero throughout."""
    if not u.any():
        return problem.b
    count(products=1)
    return problem.b - apply_stiffness(problem.grid, problem.element, u)


class _Route:
    """Rows of unknowns, row 0 on or next to the contact side, coupled to the rows above and below alone.

    Row j couples with row j - 1 by ``-k_away coupling[j]``; its diagonal is ``mass[j] k_along eigenvalue``, and k_away
    times its couplings to both neighbours and `held`, a whole number.
    """

    def eliminate(self, rows):
        """Eliminate from the far side, in place: rows[j] then holds what back substitution needs.

        A pivot is its coupling to the next row and an excess, which is summed from positive terms alone: nothing
        cancels, however stretched the cells.

        Returns
        -------
        factors : ndarray, shape of `rows`
            Back substitution is rows[j] += factors[j] rows[j - 1].
        symbol : ndarray
            What is left of the diagonal of row 0: the eigenvalues of S.
        """
        eigenvalues = self.strip.k_along * self.basis.eigenvalues
        coupling, held = self.strip.k_away * self.coupling, self.strip.k_away * self.held
        factors = np.empty_like(rows)
        excess = self.mass[-1] * eigenvalues + held[-1]
        for j in range(rows.shape[0] - 1, 0, -1):
            pivot = coupling[j] + excess
            np.divide(coupling[j], pivot, out=factors[j])
            rows[j - 1] += factors[j] * rows[j]
            rows[j] /= pivot
            excess = self.mass[j - 1] * eigenvalues + (held[j - 1] + factors[j] * excess)
        return factors, excess


def _held(diagonal, coupling):
    """What is left of each row's diagonal without the couplings to its neighbours, in units of k_away."""
    held = diagonal.copy()
    held[1:] -= coupling[1:]
    held[:-1] -= coupling[1:]
    return held


class _Vertices(_Route):
    """P1: a row of vertices at a time."""

    def __init__(self, grid, strip):
        self.grid, self.strip = grid, strip
        fixed_sides = strip.beside == "dirichlet"
        self.basis = (transforms.vertex_sines if fixed_sides else transforms.vertex_cosines)(strip.along)
        self.columns = slice(1, -1) if fixed_sides else slice(None)
        self.rows = slice(int(strip.near == "dirichlet"), strip.away + int(strip.far != "dirichlet"))
        self.mass = np.ones(strip.away + 1)
        self.mass[[0, -1]] = 0.5
        self.mass = self.mass[self.rows]
        self.coupling = np.ones(self.mass.size)
        self.held = _held(2.0 * self.mass, self.coupling)

    def _shape(self):
        return self.grid.ny + 1, self.grid.nx + 1

    def reduce(self, load):
        return np.ascontiguousarray(self.strip.turn(load.reshape(self._shape()))[self.rows, self.columns])

    def extend(self, rows):
        u = np.zeros(self._shape())
        self.strip.turn(u)[self.rows, self.columns] = rows
        return u.ravel()


class _Edges(_Route):
    """CR: a row of diagonal edges at a time, and the edges of the contact side as row 0.

    An edge parallel to an axis couples with the diagonal edges of its one or two cells alone; it is eliminated
    exactly: half its load to each of two, all of it to one.
    """

    def __init__(self, grid, strip):
        self.grid, self.strip = grid, strip
        fixed_sides = strip.beside == "dirichlet"
        self.basis = (transforms.midpoint_sines if fixed_sides else transforms.midpoint_cosines)(strip.along)
        self.line = int(strip.near != "dirichlet")
        end = {"dirichlet": 2.0, "contact": 2.0, "neumann": 0.0}
        below, above = np.ones(strip.away), np.ones(strip.away)
        below[0], above[-1] = 2.0, end[strip.far]
        self.mass = np.ones(strip.away + self.line)
        self.coupling = np.ones(self.mass.size)
        if self.line:
            self.mass[0] = 0.0
            self.coupling[1] = 2.0
        self.held = _held(np.concatenate([[2.0] * self.line, below + above]), self.coupling)

    def _turned(self, u):
        h, v, d = self.grid.split_edges(u)
        across, beside = (v, h) if self.strip.side in ("left", "right") else (h, v)
        return tuple(self.strip.turn(part) for part in (across, beside, d))

    def reduce(self, load):
        self.across, self.beside, d = self._turned(load)
        weight = 0.0 if self.strip.beside == "dirichlet" else 1.0
        sides = self.beside * _ends(self.beside.shape[1], weight, weight)
        far = 0.0 if self.strip.far == "dirichlet" else 1.0
        rows = self.across * _ends(self.across.shape[0], 0.0, far)[:, None]
        cells = d + sides[:, :-1] + sides[:, 1:] + rows[:-1] + rows[1:]
        return np.concatenate([self.across[: self.line], cells])

    def extend(self, rows):
        d = rows[self.line :]
        fixed_far, fixed_sides = self.strip.far == "dirichlet", self.strip.beside == "dirichlet"
        across, beside = np.zeros_like(self.across), np.zeros_like(self.beside)
        across[:1] = rows[:1] if self.line else 0.0
        across[1:-1] = 0.5 * (d[:-1] + d[1:]) + self.across[1:-1] / (4.0 * self.strip.k_away)
        across[-1] = 0.0 if fixed_far else d[-1] + self.across[-1] / (2.0 * self.strip.k_away)
        beside[:, 1:-1] = 0.5 * (d[:, :-1] + d[:, 1:]) + self.beside[:, 1:-1] / (4.0 * self.strip.k_along)
        for end in (0, -1):
            beside[:, end] = 0.0 if fixed_sides else d[:, end] + self.beside[:, end] / (2.0 * self.strip.k_along)
        across, beside, d = (self.strip.back(part) for part in (across, beside, d))
        h, v = (beside, across) if self.strip.side in ("left", "right") else (across, beside)
        return self.grid.join_edges(h, v, d)


def _ends(size, first, last):
    weights = np.full(size, 0.5)
    weights[0], weights[-1] = first, last
    return weights
