"""Certificates of one level of a problem, from stored solutions or from none; and their files."""

from dataclasses import dataclass, replace

import numpy as np

from signorini.certificate.certify import certify_level
from signorini.errors.exact import ExactErrors
from signorini.exceptions import SolverError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.problem import discretize_on
from signorini.solvers.select import solve
from signorini.storage import read_npz, write_npz

_EXACTLY = {"load_quadrature": "exact", "load_precision": "double"}
# What is kept of a `Certificate`, an array over the elements each.
NUMBERS = (
    *("upper", "lower", "l2", "oscillation", "contact", "gap", "primal", "dual", "steps"),
    "contributions",
)


@dataclass(frozen=True, eq=False)
class Level:
    """Certificates of one level.

    Attributes
    ----------
    n : int
    h : float
        Mesh width, unit of length.
    radius : float
        |grad u - m| <= radius for the middle m of the pair, see `Enclosure`.
    elements : list of str
    dofs : ndarray of int, shape (k,)
        Free degrees of freedom of each element.
    error : ndarray, shape (k,)
        The energy error against an exact solution; NaN where there is none.
    numbers : dict of str to ndarray
        Each of `NUMBERS`; NaN for an L2 bound that there is not.
    corners, facets : ndarray, shape (3, 2, nt)
        m, as in `fields`: its vectors at the corners, and those in front of the products of two
        barycentric coordinates; unit of u per length.
    """

    n: int
    h: float
    radius: float
    elements: list
    dofs: np.ndarray
    error: np.ndarray
    numbers: dict
    corners: np.ndarray
    facets: np.ndarray

    def of_triangles(self, element):
        """What is certified of every triangle, for programs that draw triangles.

        Parameters
        ----------
        element : {"P1", "CR"}
            One of `elements`.

        Returns
        -------
        dict
            ``contribution`` (nt,), the part in the square of the upper bound; ``middle_gradient``
            (nt, 3), the mean of m, its third component 0, unit of u per length.
        """
        mean = self.corners.mean(axis=0) + self.facets.sum(axis=0) / 12.0  # of lambda_i lambda_j
        gradient = np.zeros((mean.shape[1], 3))
        gradient[:, :2] = mean.T
        own = self.elements.index(element)
        return {
            "contribution": self.numbers["contributions"][own],
            "middle_gradient": gradient,
        }

    def rows(self):
        """Rows of certificates.csv, a dict for each element."""
        return [self._row(k) for k in range(len(self.elements))]

    def _row(self, k):
        own = {name: self.numbers[name][k].item() for name in NUMBERS if name != "contributions"}
        own["steps"] = int(own["steps"])
        error = float(self.error[k])
        row = {"element": self.elements[k], "n": self.n, "h": self.h, "dofs": int(self.dofs[k])}
        row |= own | {"radius": self.radius, "error": error}
        for name, bound in (("effectivity", "upper"), ("lower_ratio", "lower")):
            row[name] = own[bound] / error if error > 0.0 else None
        return {name: None if value != value else value for name, value in row.items()}


def loads_exactly(statement):
    """Whether the load of a statement is that of its f, as far as quadrature can tell.

    Parameters
    ----------
    statement : ProblemStatement

    Returns
    -------
    bool

    Examples
    --------
    The paper's centroid rule is none that is exact:

    >>> from signorini import load_scene
    >>> scenes = [load_scene(f"config/scenes/{name}.yaml") for name in ("paper", "punch")]
    >>> [loads_exactly(scene.problem_statement) for scene in scenes]
    [False, True]
    """
    exact = replace(statement, **_EXACTLY)
    same = all(getattr(statement, name) == getattr(exact, name) for name in _EXACTLY)
    return same or statement.data.f.constant == 0.0


def certified_level(statement, mesh, solutions, *, n, h, method="auto", elements=("P1", "CR")):
    """The certificates of stored solutions of both elements.

    Parameters
    ----------
    statement : ProblemStatement
    mesh : Grid or Triangulation
        Of the level.
    solutions : dict of str to StoredSolution or Solution
        By element.
    n : int
    h : float
    method : str, optional
        The route of a solve of CR under the exact load, where that of the statement is not.
    elements : sequence of str, optional
        Those to be certified.

    Returns
    -------
    Level

    Raises
    ------
    SolverError
        If a solution is of status inaccurate or of another level, or is none.
    SceneError, FormulaError, MeshError
        If the data admit no bound.
    """
    for element, solution in solutions.items():
        _check_solved(solution, element, n)
    data, u = statement.data, {name: found.u for name, found in solutions.items()}
    equilibrated, published, A = u["CR"], None, None
    if not loads_exactly(statement):
        problem = discretize_on(mesh, "CR", replace(statement, **_EXACTLY))
        equilibrated, published = solve(problem, method).u, u["CR"]
        A = None if problem.grid is not None else problem.A
    found, enclosure = certify_level(mesh, data, u["P1"], equilibrated, published=published, A=A)
    numbers = {
        name: np.array([_number(getattr(found[element], name)) for element in elements])
        for name in NUMBERS
    }
    corners, facets = _middle(enclosure, -1.0 if data.constraint == "upper" else 1.0)
    return Level(
        n=n,
        h=h,
        radius=float(enclosure.radius),
        elements=list(elements),
        dofs=np.array([_free_dofs(solutions[element]) for element in elements]),
        error=np.array([_error(statement, mesh, name, u[name]) for name in elements]),
        numbers=numbers,
        corners=corners,
        facets=facets,
    )


def _number(value):
    return np.nan if value is None else value


def _free_dofs(solution):
    return solution.problem.free.size if hasattr(solution, "problem") else solution.dofs


def _check_solved(solution, element, n):
    if solution.status != "solved":
        raise SolverError(
            f"certificate: the {element} solution of level {n} is {solution.status}; a bound needs "
            "one that is solved: choose another solver.method, or stretch cells less"
        )
    own = getattr(solution, "element", element), getattr(solution, "n", n)
    if own != (element, n):
        raise SolverError(
            f"certificate: a solution of {own[0]}, level {own[1]}, is not that of {element}, "
            f"level {n}; give the solutions of one level"
        )


def _error(statement, mesh, element, u):
    """The energy error against an exact solution."""
    if statement.exact is None:
        return np.nan
    weight = coefficient_on(mesh, statement.data.coefficient)
    return ExactErrors(statement.exact, ["energy"]).of(mesh, element, u, weight)["energy"]


def _middle(enclosure, sign):
    """Vectors of m at the corners and of its facet parts, both (3, 2, nt)."""
    found = np.empty((2, 3, 2, enclosure.topology.count))
    for piece in enclosure.topology.pieces():
        vectors = enclosure.middle_on(piece).vectors(piece)
        for part, values in zip(found, vectors, strict=True):
            part[..., piece.cells] = sign * values / piece.coefficient
    return found


def write_level(path, level):
    """Store a `Level`.

    Parameters
    ----------
    path : str or Path
        Of an .npz file.
    level : Level
    """
    parts = vars(level) | {f"number_{name}": value for name, value in level.numbers.items()}
    del parts["numbers"]
    write_npz(path, kind="certificate", **parts)


def read_level(path):
    """Read what `write_level` stored.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or no certificate.
    """
    arrays = read_npz(path, kind="certificate")
    numbers = {name: arrays.pop(f"number_{name}") for name in NUMBERS}
    parts = {name: value if value.ndim else value.item() for name, value in arrays.items()}
    return Level(**parts | {"numbers": numbers, "elements": parts["elements"].tolist()})
