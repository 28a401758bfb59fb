"""Which route solves a problem, and why."""

import importlib

from signorini.exceptions import NotApplicableError, SolverError
from signorini.memory import fits

# Route name -> module and function; imported when used, because importing SciPy costs more than a
# coarse solve.
METHODS = {
    "fourier": ("signorini.solvers.fourier", "solve_fourier"),
    "direct": ("signorini.solvers.direct", "solve_direct"),
    "multigrid": ("signorini.solvers.multigrid", "solve_multigrid"),
}
# Routes that need packages of their own, and are taken where asked for alone.
EXTRAS = {"petsc": ("signorini.solvers.petsc", "solve_petsc")}
ALL_METHODS = METHODS | EXTRAS

# Contact dofs from which their dense matrix costs more than levels: of few dofs, without jumps of
# the coefficient or with them; and of many, on a mesh that was not refined. Measured.
_THIN_FROM, _DENSE_CONTACT_UP_TO = {False: 400, True: 800}, 1500
# Dofs up to which a factorisation is faster than a hierarchy, by the accuracy that is wanted;
# measured.
_DIRECT_UP_TO = {"full": 20_000, "discretisation": 2_000}
REQUESTED = "asked for"


def choose_route(problem, method, accuracy="full"):
    """The route for a problem, and why that one.

    Parameters
    ----------
    problem : Problem
    method : str
        Of `ALL_METHODS`, or "auto" for the cheapest that applies.
    accuracy : {"full", "discretisation"}
        That is wanted.

    Returns
    -------
    method, reason : str

    Raises
    ------
    SolverError
        If the method is unknown, or none can hold the problem.
    NotApplicableError
        If the method does not apply.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> choose_route(discretize(load_scene("config/scenes/paper.yaml"), "CR", 8), "auto")
    ('fourier', 'uniform grid, equal conditions beside the contact side')
    """
    if method not in ("auto", *ALL_METHODS):
        raise SolverError(
            f"solver.method: unknown method {method!r}; known: auto, {', '.join(ALL_METHODS)}"
        )
    if method != "auto":
        if why_not := _why_not(method, problem):
            raise NotApplicableError(
                f"solver.method: {method} does not apply, {why_not}; use auto or direct"
            )
        return method, REQUESTED
    why_not = _why_not("fourier", problem)
    if why_not:
        return _general_route(problem, why_not, accuracy)
    beside = "equal conditions beside the contact side"
    condition = beside if problem.contact.size else "no contact part: plain Poisson"
    return "fourier", f"uniform grid, {condition}"


def _general_route(problem, why_not, accuracy):
    """The same where the fourier route does not apply, and why it does not."""
    if problem.b.size <= _DIRECT_UP_TO[accuracy] and not _is_thin(problem):
        return "direct", why_not
    from signorini.solvers.conditioning import is_nested

    if is_nested(problem.mesh):
        return "multigrid", f"{why_not}, but refined"
    return _unrefined_route(problem, why_not)


def _unrefined_route(problem, why_not):
    """The same on a mesh without coarser ones, or with stretched cells."""
    from signorini.solvers.conditioning import has_jumps, is_regular

    regular, jumps = is_regular(problem.mesh), has_jumps(problem.coefficient)
    if regular and not jumps and not _is_small(problem):
        return (
            "multigrid",
            f"{why_not}, but no cell is stretched, no coefficient jumps",
        )
    if _is_thin(problem) or (regular and problem.contact.size > _DENSE_CONTACT_UP_TO):
        return "multigrid", f"{why_not}, and its contact matrix too large to be dense"
    if factors_fit(problem):
        return "direct", f"{why_not}, and {_what_slows_levels(regular, jumps)}"
    if stretched := _why_not("multigrid", problem):
        raise SolverError(
            f"domain: too large for a factorisation, and {stretched}; "
            "stretch cells less, or use fewer"
        )
    return "multigrid", f"{why_not}, and too large for a factorisation"


def factors_fit(problem):
    """Whether this machine can hold the factors of a problem.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> factors_fit(discretize(load_scene("config/scenes/paper.yaml"), "CR", 8))
    True
    """
    return fits(problem.mesh.number_of_triangles, problem.finite_element.facts.direct_bytes)


def factors_may_be_surer(problem):
    """Whether the direct route is worth its time where multigrid is not sure of all.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> factors_may_be_surer(discretize(load_scene("config/scenes/paper.yaml"), "CR", 8))
    True
    """
    from signorini.solvers.conditioning import is_nested

    dense = problem.contact.size <= _DENSE_CONTACT_UP_TO
    return _is_small(problem) or (dense and not is_nested(problem.mesh))


def _is_small(problem):
    return problem.b.size <= _DIRECT_UP_TO["full"]


def _is_thin(problem):
    """Whether so many of few dofs are in contact that a dense matrix of them costs more than
    levels.
    """
    from signorini.solvers.conditioning import has_jumps, is_regular

    if not _is_small(problem) or problem.contact.size <= min(_THIN_FROM.values()):
        return False
    many = problem.contact.size > _THIN_FROM[has_jumps(problem.coefficient)]
    return many and is_regular(problem.mesh)


def _what_slows_levels(regular, jumps):
    if not regular:
        return "of stretched cells"
    return "not refined where the coefficient jumps" if jumps else "not refined"


def _why_not(method, problem):
    """Why a route does not apply to a problem, or None; the direct one always does."""
    module = importlib.import_module(ALL_METHODS[method][0])
    return module.why_not(problem) if hasattr(module, "why_not") else None
