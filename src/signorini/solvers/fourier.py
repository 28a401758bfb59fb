"""The fourier route: uniform rectangles with equal conditions on the two sides beside the contact
side.

Along the contact side, cosines (or sines) diagonalise the stiffness matrix; away from it, each of
them leaves a tridiagonal matrix. One elimination sweep towards the contact side leaves S w - q =
lambda there, S diagonal in the same basis; the inequality is solved on that line alone, and one
sweep back gives u. CR first eliminates its edges parallel to the axes, which leaves the same matrix
on the diagonal edges. No matrix is assembled. After Buzbee, Golub and Nielson, On direct methods
for solving Poisson's equations, SIAM J. Numer. Anal. 7 (1970).
"""

import numpy as np

from signorini.fem.residual import EPS
from signorini.fem.stencil import apply_stiffness
from signorini.solvers.contact import solve_contact
from signorini.solvers.extremes import largest
from signorini.solvers.line_elimination import EdgeLines, VertexLines
from signorini.solvers.oriented_grid import orient
from signorini.solvers.route_result import ErrorEstimates, assess, variation_of
from signorini.solvers.signs import Search, settle
from signorini.solvers.spectral import contact_operator
from signorini.work import count

_ELIMINATIONS = {"P1": VertexLines, "CR": EdgeLines}
_CORRECTIONS = 5
_CERTAIN = 1e-12  # a correction of which share of u is one to the last digits
_SAFETY = 8.0  # of a bound over the last correction


def why_not(problem):
    """Say why the route does not apply to a problem, or None where it does.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> why_not(problem) is None
    True
    >>> why_not(discretize(load_scene("config/scenes/l-shape.yaml"), "P1", 8))
    'the mesh is not a uniform grid'
    """
    grid = problem.grid
    if grid is None:
        return (
            "the mesh is not a uniform grid"
            if problem.coefficient is None
            else "the coefficient is not 1"
        )
    if reason := why_not_on(grid, problem.element):
        return reason
    return None if _is_of_sides(problem) else "contact or fixed dofs are not those of whole sides"


def why_not_on(grid, element):
    """The same of any problem on a grid with coefficient 1, whose dofs are those of its sides.

    Parameters
    ----------
    grid : Grid
    element : {"P1", "CR"}

    Returns
    -------
    str or None

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> why_not_on(Grid(4, 1, (0.0, 0.0), (1.0, 1.0), "falling", labels), "P1")
    'the grid is a single cell wide'
    """
    if element not in _ELIMINATIONS:
        return f"it eliminates no rows of {element}"
    if len(grid.sides("contact")) > 1:
        return "more than one side is in contact"
    if min(grid.nx, grid.ny) < 2:
        return "the grid is a single cell wide"
    return None if orient(grid) else "the two sides beside the contact side differ in kind"


def _is_of_sides(problem):
    """Whether contact and fixed dofs are those that the grid's labels name."""
    fixed, contact = (
        problem.finite_element.boundary_dofs(problem.grid, label)
        for label in ("dirichlet", "contact")
    )
    contact = np.setdiff1d(contact, fixed, assume_unique=True)
    return np.array_equal(problem.fixed, fixed) and np.array_equal(problem.contact, contact)


def solve_fourier(problem, guess=None):
    """Solve a problem for which `why_not` is None.

    Parameters
    ----------
    problem : Problem
    guess : ndarray of bool, shape (nc,), optional
        Contact dofs believed to bind.

    Returns
    -------
    RouteResult
        No matrix entry is rounded and no pivot cancels, so that the last correction is as large as
        any error left.

    Raises
    ------
    SolverError
        If the active-set iteration does not end.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> result = solve_fourier(problem)
    >>> result.accuracy < 1e-14, int(result.active.sum())
    (True, 3)
    """
    elimination = _ELIMINATIONS[problem.element](problem.grid, orient(problem.grid))
    line = _ContactLine(guess, singular=problem.fixed.size == 0)
    u = _displacement(problem, elimination, _shifted_load(problem), line.solve_contact_problem)
    u[problem.fixed] = problem.fixed_values
    u[problem.contact] += problem.lower
    return settle(_Search(problem, elimination, line, u))


class _Search(Search):
    """The solution by eliminations."""

    name = "fourier"

    def __init__(self, problem, elimination, line, u):
        super().__init__(u, line.active, line.iterations)
        self.problem, self.elimination, self.line = problem, elimination, line

    @property
    def force(self):
        """Contact forces, as the line has them."""
        return self.line.force

    def refine(self):
        """Correct u in place until corrections stop falling, mostly once."""
        problem, line, u, last = self.problem, self.line, self.u, np.inf
        for _ in range(_CORRECTIONS):
            before = line.force
            rest = _residual(problem, u)
            correction = _displacement(problem, self.elimination, rest, line.solve_with_fixed_set)
            # The correction goes to the gap before u rounds it off.
            self.gap = (u[problem.contact] - problem.lower) + correction[problem.contact]
            u += correction
            size, change = largest(correction), largest(line.force - before)
            if size <= _CERTAIN * variation_of(u) or size > 0.5 * last:
                break
            last = size
        return _errors(problem, u, size, change, line.stiffness)

    def result(self, errors):
        return assess(self.u, self.active, self.steps, self.gap, self.force, errors)

    def exchange(self, wrong):
        super().exchange(wrong)
        self._hold()

    def bind(self, near):
        super().bind(near)
        self._hold()

    def _hold(self):
        problem, self.line.active = self.problem, self.active
        self.u[problem.contact[self.active]] = problem.lower[self.active]


def _residual(problem, u):
    count(products=1)
    rest = apply_stiffness(problem.grid, problem.element, u)
    return np.subtract(problem.b, rest, out=rest)


def _errors(problem, u, correction, change, stiffness):
    """Errors of u and of the forces, by their last changes."""
    _, fluxes, _ = problem.contact_fluxes(u)
    force_scale = np.max(fluxes + np.abs(problem.b[problem.contact]), initial=0.0)
    force = max(change, EPS * force_scale)
    shape = problem.contact.shape
    gaps = np.full(shape, _SAFETY * max(correction, EPS * largest(u)))
    forces = np.full(shape, _SAFETY * force)
    return ErrorEstimates(correction, force, gaps, forces, forces, stiffness, force_scale)


class _ContactLine:
    """The contact line: its set is found once, and held when the solution is refined."""

    def __init__(self, guess, singular):
        self.guess, self.singular = guess, singular
        self.active, self.force, self.stiffness = np.zeros(0, dtype=bool), np.zeros(0), np.zeros(0)
        self.iterations = 0

    def solve_contact_problem(self, operator, q):
        """The gap under the condensed load q, shape (nc,)."""
        result = solve_contact(operator, q, guess=self.guess, singular=self.singular)
        self.active, self.iterations = result.active, result.iterations
        self.force, self.stiffness = self._force(operator, result.w, q), operator.diagonal()
        return result.w

    def solve_with_fixed_set(self, operator, q):
        """The change of the gap under a further load, none in the contact set."""
        w, free = np.zeros(q.size), ~self.active
        if free.any():
            w[free] = operator.solve_free(free, q[free])
        self.force = self._force(operator, w, q)
        return w

    def _force(self, operator, w, q):
        """The contact forces: the load condensed to a dof in contact is what presses on it."""
        return np.where(self.active, operator.apply(w) - q, 0.0)


def _displacement(problem, elimination, load, gap_under):
    """What a load does: u, zero on the fixed dofs, whose gap on the contact line is
    ``gap_under(operator, q)``.
    """
    basis = elimination.basis
    rows = elimination.condense(load)
    if basis.weighted:
        rows /= basis.mass
    count(factorisations=1)
    factors, symbol = elimination.eliminate(basis.forward(rows, out=rows))
    gap = np.zeros(0)
    if problem.contact.size:
        gap = gap_under(contact_operator(basis, symbol), basis.mass * basis.backward(rows[0]))
        rows[0] = basis.forward(gap)
    else:
        rows[0] /= symbol
    for j in range(1, rows.shape[0]):
        rows[j] += factors[j] * rows[j - 1]
    del factors
    u = elimination.back_substitute(basis.backward(rows, out=rows), load)
    u[problem.fixed] = 0.0
    u[problem.contact] = gap
    return u


def _shifted_load(problem):
    """The load less what the Dirichlet values and the obstacle take of it; the problem's own where
    that is nothing.
    """
    if not (np.any(problem.fixed_values) or np.any(problem.lower)):
        return problem.b
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    u[problem.contact] = problem.lower
    count(products=1)
    load = apply_stiffness(problem.grid, problem.element, u)
    return np.subtract(problem.b, load, out=load)
