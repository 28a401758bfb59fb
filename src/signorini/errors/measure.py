"""From stored solutions to the rows of errors.csv."""

from signorini.errors.norms import CONTACT, REFERENCE
from signorini.errors.round_off import RoundOff, round_off_alone, round_off_bounds
from signorini.exceptions import SceneError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import read_coefficient


def against_reference(truth, domain, norms, quadrature, coefficient=1):
    """A function from a `StoredSolution` to its errors against a reference.

    Parameters
    ----------
    truth : StoredSolution
        The reference.
    domain : Rectangle or Refined
        Makes the mesh of each level.
    norms : sequence of str
        Of `norms.DOMAIN`.
    quadrature : str
        See `ReferenceErrors`.
    coefficient : object, optional
        The entry ``data.coefficient`` of the scene: the weight of the energy norm.

    Returns
    -------
    callable
        To a dict: norm -> error or None, and ``"floor"``, the names of the norms that are round-off
        alone, or ``"reference"`` for the truth itself.

    Examples
    --------
    A reference has no error against itself:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> truth, domain = solve_level(scene, "P1", 16), scene.problem_statement.triangulations
    >>> errors = against_reference(truth, domain, ["l2", "h1_semi"], "exact")
    >>> errors(truth)["l2"], errors(solve_level(scene, "P1", 8))["h1_semi"] > 0.1
    (0.0, True)
    """
    mesh, coefficient = domain.level(truth.n), read_coefficient(coefficient)
    measure = reference_measure(mesh, truth, norms, quadrature, _weight(mesh, coefficient, norms))

    def errors_of(solution):
        mesh = domain.level(solution.n)
        same = (solution.element, solution.n) == (truth.element, truth.n)
        return measure(mesh, solution, _weight(mesh, coefficient, norms), same)

    return errors_of


def reference_measure(mesh, truth, norms, quadrature="exact", weight=None):
    """Errors against a reference, by the meshes themselves.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The reference's.
    truth : StoredSolution
    norms, quadrature
        See `against_reference`.
    weight : ndarray, shape (nt,), optional
        The diffusion coefficient on the reference's mesh.

    Returns
    -------
    callable
        From a mesh that the reference's was refined from, a `StoredSolution` on it, the diffusion
        coefficient on it, and whether it is the reference itself, to a dict as in
        `against_reference`.

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> domain, truth = scene.problem_statement.triangulations, solve_level(scene, "P1", 16)
    >>> measure = reference_measure(domain.level(16), truth, ["l2"])
    >>> coarse, fine = (measure(domain.level(n), solve_level(scene, "P1", n))["l2"] for n in (4, 8))
    >>> fine < coarse
    True
    """
    from signorini.errors.reference import ReferenceErrors

    rounding = RoundOff.of(truth)
    errors = ReferenceErrors(mesh, truth.element, truth.u, norms, quadrature, weight)
    noise = round_off_bounds(mesh, rounding, norms, weight)

    def errors_of(mesh, solution, weight=None, same=False):
        both = rounding.together_with(RoundOff.of(solution))
        bounds = round_off_bounds(mesh, both, norms, weight)

        def unresolved(doubtful):
            parts = errors.unresolved(mesh, doubtful)
            return {norm: part if part > noise[norm] else 0.0 for norm, part in parts.items()}

        result = errors.of(mesh, solution.element, solution.u)
        if same:
            return result | {"floor": REFERENCE}
        return _with_round_off(result, bounds, unresolved)

    return errors_of


def against_exact(statement, domain, norms):
    """The same against an exact truth, with the errors on the contact part.

    Parameters
    ----------
    statement : ProblemStatement
        Has the exact solution, and the coefficient that is the weight of the energy norm.
    domain : Rectangle or Refined
        Makes the mesh of each level.
    norms : sequence of str
        Of `norms.RATED`.

    Returns
    -------
    callable
        From a `StoredSolution` to a dict as in `against_reference`. It raises `SceneError` where
        critical points are asked for and none of the exact ones lies on the contact part.

    Examples
    --------
    The error of CR in L2 falls by four where h is halved:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/smooth.yaml")
    >>> statement = scene.problem_statement
    >>> errors = against_exact(statement, statement.triangulations, ["l2"])
    >>> coarse, fine = (errors(solve_level(scene, "CR", n))["l2"] for n in (16, 32))
    >>> round(coarse / fine, 1)
    4.0
    """
    measure, coefficient = exact_measure(statement.exact, norms), statement.data.coefficient

    def errors_of(solution):
        mesh = domain.level(solution.n)
        return measure(mesh, solution, _weight(mesh, coefficient, norms))

    return errors_of


def exact_measure(exact, norms):
    """Errors against an exact solution, by the mesh itself.

    Parameters
    ----------
    exact : ExactSolution
    norms : sequence of str
        Of `norms.RATED`.

    Returns
    -------
    callable
        From a mesh, a `StoredSolution` on it, and the diffusion coefficient on it, None for 1, to a
        dict as in `against_exact`, also for what is raised.

    Examples
    --------
    Nothing of an affine solution is lost:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/patch.yaml")
    >>> measure = exact_measure(scene.problem_statement.exact, ["l2"])
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> measure(mesh, solve_level(scene, "CR", 4))["l2"] < 1e-14
    True
    """
    from signorini.errors.contact import contact_errors
    from signorini.errors.exact import ExactErrors
    from signorini.errors.unresolved import unresolved

    errors = ExactErrors(exact, [norm for norm in norms if norm not in CONTACT])
    on_contact = [norm for norm in norms if norm in CONTACT]

    def errors_of(mesh, solution, weight=None):
        result = errors.of(mesh, solution.element, solution.u, weight)
        if on_contact:
            contact = contact_errors(mesh, solution.element, solution, exact)
            _check_critical_points(on_contact, contact, exact)
            result |= {norm: contact[norm] for norm in on_contact}
        bounds = round_off_bounds(mesh, RoundOff.of(solution), norms, weight)
        return _with_round_off(
            result, bounds, lambda doubtful: unresolved(mesh, exact, doubtful, weight)
        )

    return errors_of


def _check_critical_points(norms, errors, exact):
    if "critical_points" in norms and errors["critical_points"] is None:
        named = ", ".join(f"({x:g}, {y:g})" for x, y in exact.critical_points)
        raise SceneError(
            f"norms: critical_points needs exact ones on the contact part, but {named} lie off it; "
            "mend truth.critical_points or the family's parameters, "
            "or drop critical_points from norms"
        )


def _weight(mesh, coefficient, norms):
    """The diffusion coefficient, where a norm depends on it."""
    if {"energy", "multiplier_l2"}.isdisjoint(norms):
        return None
    return coefficient_on(mesh, coefficient)


def _with_round_off(errors, bounds, unresolved):
    """The errors, and in the column ``floor`` the norms in which they are round-off alone."""
    return errors | {"floor": " ".join(round_off_alone(errors, bounds, unresolved))}


def error_row(solution, errors):
    """The row of errors.csv for a stored solution.

    Parameters
    ----------
    solution : StoredSolution
    errors : callable
        From it to a dict, as `against_reference` and `against_exact` make them.

    Returns
    -------
    dict
        What it is, its errors, what they rest on, and how it was computed.

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> solution = solve_level(load_scene("config/scenes/paper.yaml"), "P1", 8)
    >>> row = error_row(solution, lambda _: {"l2": 0.5})
    >>> row["element"], row["n"], row["l2"], row["status"]
    ('P1', 8, 0.5, 'solved')
    """
    identity = {
        "element": solution.element,
        "n": solution.n,
        "h": solution.h,
        "dofs": solution.dofs,
    }
    proof = {
        "residual": solution.residual,
        "accuracy": solution.accuracy,
        "multiplier_accuracy": solution.multiplier_accuracy,
        "undecided": int(solution.undecided.sum()),
    }
    how = {
        "status": solution.status,
        "iterations": solution.iterations,
        "method": solution.method,
    }
    return identity | errors(solution) | proof | how
