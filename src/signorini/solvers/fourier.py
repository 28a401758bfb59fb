"""The fourier route: uniform rectangles with equal conditions on the two sides beside the contact side.

Along the contact side, cosines (or sines) diagonalise the stiffness matrix; away from it, each of them leaves a
tridiagonal matrix. One elimination sweep towards the contact side leaves S w - q = lambda there, S diagonal in
the same basis; the inequality is solved on that line alone, and one sweep back gives u. CR first eliminates its
edges parallel to the axes, which leaves the same matrix on the diagonal edges. No matrix is assembled. After
Buzbee, Golub and Nielson, On direct methods for solving Poisson's equations, SIAM J. Numer. Anal. 7 (1970).
"""

from dataclasses import dataclass

import numpy as np

from signorini.boundary import SIDES
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
    kinds: dict
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
    labels = dict(zip(SIDES, grid.labels, strict=True))
    hx, hy = grid.spacing
    for side in grid.sides("contact") or ("bottom", "left"):
        vertical = side in ("left", "right")
        beside = {labels[name] for name in _BESIDE["left" if vertical else "bottom"]}
        if len(beside) == 1:
            along, away = (grid.ny, grid.nx) if vertical else (grid.nx, grid.ny)
            kx, ky = hy / hx, hx / hy
            k = (ky, kx) if vertical else (kx, ky)
            return _Strip(side, labels, labels[side], labels[_OPPOSITE[side]], beside.pop(), along, away, *k)
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
    route = (_Vertices if problem.element == "P1" else _Edges)(problem.grid, _strip(problem.grid))
    line = _Line(guess, singular=problem.fixed.size == 0)
    u = _displacement(problem, route, _shifted_load(problem), line.settle)
    u[problem.fixed] = problem.fixed_values
    u[problem.contact] += problem.lower
    count(products=1)
    rest = apply_stiffness(problem.grid, problem.element, u)
    u += _displacement(problem, route, np.subtract(problem.b, rest, out=rest), line.hold)
    return u, line.active, line.iterations, 0.0


class _Line:
    """The contact line: its set is found once, and held when the solution is refined."""

    def __init__(self, guess, singular):
        self.guess, self.singular = guess, singular
        self.active, self.iterations = np.zeros(0, dtype=bool), 0

    def settle(self, operator, q):
        """The gap under the condensed load q, shape (nc,)."""
        result = solve_contact(operator, q, guess=self.guess, singular=self.singular)
        self.active, self.iterations = result.active, result.iterations
        return result.w

    def hold(self, operator, q):
        """The change of the gap under a further load, none in the contact set."""
        w, free = np.zeros(q.size), ~self.active
        if free.any():
            w[free] = operator.solve_free(free, q[free])
        return w


def _displacement(problem, route, load, settle):
    """What a load does: u, zero on the fixed dofs, whose gap on the contact line is ``settle(operator, q)``."""
    rows = route.reduce(load)
    if route.basis.weighted:
        rows /= route.basis.mass
    count(factorisations=1)
    factors, symbol = route.eliminate(route.basis.forward(rows, out=rows))
    gap = np.zeros(0)
    if problem.contact.size:
        gap = settle(contact_operator(route.basis, symbol), route.basis.mass * route.basis.backward(rows[0]))
        rows[0] = route.basis.forward(gap)
    else:
        rows[0] /= symbol
    for j in range(1, rows.shape[0]):
        rows[j] += factors[j] * rows[j - 1]
    del factors
    u = route.extend(route.basis.backward(rows, out=rows), load)
    u[problem.fixed] = 0.0
    u[problem.contact] = gap
    return u


def _shifted_load(problem):
    """The load less what the Dirichlet values and the obstacle take of it; the problem's own where that is nothing."""
    if not (np.any(problem.fixed_values) or np.any(problem.lower)):
        return problem.b
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    u[problem.contact] = problem.lower
    count(products=1)
    load = apply_stiffness(problem.grid, problem.element, u)
    return np.subtract(problem.b, load, out=load)


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
        return np.array(self.strip.turn(load.reshape(self._shape()))[self.rows, self.columns], order="C")

    def extend(self, rows, load):
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

    def _shares(self, sides):
        """What an edge hands to each of its cells, by rows (or columns) of edges that two sides end; none if held."""
        held = [self.strip.kinds[side] == "dirichlet" or (side == self.strip.side and self.line) for side in sides]
        shares = np.full((self.grid.nx if sides[0] == "left" else self.grid.ny) + 1, 0.5)
        shares[[0, -1]] = np.where(held, 0.0, 1.0)
        return shares

    def _blocks(self, load):
        """By blocks of rows of cells: the first and the one after the last, the load on their edges, their shares."""
        along_y, along_x = self._shares(("bottom", "top"))[:, None], self._shares(("left", "right"))
        for first, last in self.grid.row_blocks():
            yield first, last, *self.grid.split_edges(load, first, last), along_y[first : last + 1], along_x

    def reduce(self, load):
        rows = np.empty((self.strip.away + self.line, self.strip.along))
        cells = self.strip.back(rows[self.line :])
        if self.line:
            rows[0] = load[self.grid.side_facets(self.strip.side)]
        for first, last, h, v, d, share_h, share_v in self._blocks(load):
            h *= share_h
            v *= share_v
            cells[first:last] = d + h[:-1] + h[1:] + v[:, :-1] + v[:, 1:]
        return rows

    def extend(self, rows, load):
        u = np.zeros_like(load)
        cells = self.strip.back(rows[self.line :])
        hx, hy = self.grid.spacing
        k_h, k_v = hx / hy, hy / hx
        for first, last, h, v, _, share_h, share_v in self._blocks(load):
            d = cells[first:last]
            h /= 2.0 * k_h
            h[1:] += d
            h[:-1] += d
            if first > 0:
                h[0] += cells[first - 1]
            if last < self.grid.ny:
                h[-1] = 0.0  # the next block's first row
            v /= 2.0 * k_v
            v[:, 1:] += d
            v[:, :-1] += d
            self.grid.add_edges(u, first, share_h * h, share_v * v, d)
        if self.line:
            u[self.grid.side_facets(self.strip.side)] = rows[0]
        return u
