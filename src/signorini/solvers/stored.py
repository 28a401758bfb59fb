"""Solutions as files."""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import MeshError
from signorini.fem.elements import find_element
from signorini.storage import read_npz, write_npz


@dataclass(frozen=True, eq=False)
class StoredSolution:
    """A solution as `read_solution` returns it; see `solvers.Solution` for what the parts mean.

    ``dofs`` counts the free degrees of freedom; ``contact``, ``lower``, ``threshold`` and ``upper``
    are those of the `Problem`; ``h`` has the unit of length.
    """

    element: str
    n: int
    h: float
    dofs: int
    u: np.ndarray
    multiplier: np.ndarray
    active: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    residual: float
    accuracy: float
    multiplier_accuracy: float
    undecided: np.ndarray
    status: str
    iterations: int
    method: str
    threshold: np.ndarray | None = None
    upper: bool = False
    algebraic_error: float | None = None
    discretisation_error: float | None = None

    @property
    def force(self):
        """Contact force on each contact dof, an integral of k du/dnu, (nc,), unit of k u."""
        return self.multiplier if self.threshold is None else self.multiplier + self.threshold


def stored(problem, solution, n, h):
    """A solution as it would be stored.

    Parameters
    ----------
    problem : Problem
    solution : Solution
        Of `problem`.
    n : int
        Level.
    h : float
        Mesh width, unit of length.

    Returns
    -------
    StoredSolution

    Examples
    --------
    >>> from signorini import discretize, load_scene, solve
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> record = stored(problem, solve(problem), n=8, h=problem.h)
    >>> record.element, record.n, record.dofs, record.status
    ('P1', 8, 72, 'solved')
    """
    return StoredSolution(
        element=problem.element,
        n=n,
        h=h,
        dofs=problem.free.size,
        u=solution.u,
        multiplier=solution.multiplier,
        active=solution.active,
        contact=problem.contact,
        lower=problem.lower,
        residual=solution.residual,
        accuracy=solution.accuracy,
        multiplier_accuracy=solution.multiplier_accuracy,
        undecided=solution.undecided,
        status=solution.status,
        iterations=solution.iterations,
        method=solution.method,
        threshold=problem.threshold,
        upper=problem.upper,
        algebraic_error=solution.algebraic_error,
        discretisation_error=solution.discretisation_error,
    )


def write_solution(path, problem, solution, n, h):
    """Store a solution.

    Parameters
    ----------
    path : str or Path
    problem, solution, n, h
        See `stored`.

    Examples
    --------
    >>> from signorini import discretize, load_scene, solve
    >>> from tempfile import TemporaryDirectory
    >>> problem = discretize(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> with TemporaryDirectory() as folder:
    ...     write_solution(f"{folder}/u.npz", problem, solve(problem), n=8, h=problem.h)
    ...     again = read_solution(f"{folder}/u.npz")
    >>> again.status, again.dofs
    ('solved', 72)
    """
    write_stored(path, stored(problem, solution, n, h))


def write_stored(path, record):
    """Store a `StoredSolution`, so that `read_solution` reads it.

    Parameters
    ----------
    path : str or Path
    record : StoredSolution
    """
    parts = vars(record)
    kept = {key: value for key, value in parts.items() if value is not _ABSENT.get(key, _KEPT)}
    write_npz(path, kind="solution", **kept)


# Parts that most solutions do not have, and what says so: they are not written then.
_KEPT = object()
_ABSENT = {
    "threshold": None,
    "upper": False,
    "algebraic_error": None,
    "discretisation_error": None,
}


def read_solution(path):
    """Read what `write_solution` stored.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or not a solution.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> solution = solve_level(load_scene("config/scenes/paper.yaml"), "CR", 8)
    >>> with TemporaryDirectory() as folder:
    ...     write_stored(f"{folder}/u.npz", solution)
    ...     again = read_solution(f"{folder}/u.npz")
    >>> bool(np.all(again.u == solution.u)), again.residual == solution.residual
    (True, True)
    """
    arrays = read_npz(path, kind="solution")
    return StoredSolution(
        **{key: value if value.ndim else value.item() for key, value in arrays.items()}
    )


def mesh_of(domain, solution):
    """The mesh of a stored solution.

    Parameters
    ----------
    domain : Rectangle or Refined
    solution : StoredSolution

    Returns
    -------
    Grid or Triangulation

    Raises
    ------
    MeshError
        If the solution cannot be one on this domain: another mesh width, number of unknowns, or
        contact part.

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> mesh = mesh_of(scene.problem_statement.triangulations, solve_level(scene, "CR", 8))
    >>> mesh.number_of_triangles
    128
    """
    mesh = domain.level(solution.n)
    element = find_element(solution.element)
    belongs = (
        solution.u.shape == (element.size(mesh),)
        and solution.h == domain.mesh_size(solution.n)
        and np.array_equal(solution.contact, _contact_dofs(mesh, element))
    )
    if not belongs:
        raise MeshError(
            f"{solution.element} n = {solution.n}, {solution.u.size} unknowns: not a solution on "
            f"this mesh, which has {element.size(mesh)} there; give the mesh of its scene"
        )
    return mesh


def _contact_dofs(mesh, element):
    fixed = element.boundary_dofs(mesh, "dirichlet")
    return np.setdiff1d(element.boundary_dofs(mesh, "contact"), fixed, assume_unique=True)
