"""From stored solutions to the rows of errors.csv."""

from signorini.errors.norms import CONTACT, REFERENCE
from signorini.errors.round_off import RoundOff, norm_floors, round_off_alone
from signorini.exceptions import SceneError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import read_coefficient


def against_reference(truth, domain, norms, quadrature, coefficient=1):
    """A function from a `StoredSolution` to its errors against another one.

    Parameters
    ----------
    truth : StoredSolution
    domain : Rectangle or Refined
    norms : sequence of str
    quadrature : str
        See `ReferenceErrors`.
    coefficient : object, optional
        The entry ``data.coefficient`` of the scene: the weight of the energy norm.

    Returns
    -------
    callable
        To a dict: norm -> error or None, and ``"floor"``, the names of the norms that are round-off
        alone, or ``"reference"`` for the truth itself.
    """
    from signorini.errors.reference import ReferenceErrors

    mesh, coefficient = domain.level(truth.n), read_coefficient(coefficient)
    weight, rounding = _weight(mesh, coefficient, norms), RoundOff.of(truth)
    errors = ReferenceErrors(mesh, truth.element, truth.u, norms, quadrature, weight)
    noise = norm_floors(mesh, rounding, norms, weight)

    def of(found):
        mesh = domain.level(found.n)
        both = rounding.together_with(RoundOff.of(found))
        floors = norm_floors(mesh, both, norms, _weight(mesh, coefficient, norms))

        def unresolved(doubtful):
            parts = errors.unresolved(mesh, doubtful)
            return {norm: part if part > noise[norm] else 0.0 for norm, part in parts.items()}

        result = errors.of(mesh, found.element, found.u)
        if (found.element, found.n) == (truth.element, truth.n):
            return result | {"floor": REFERENCE}
        return _with_floor(result, floors, unresolved)

    return of


def against_exact(statement, domain, norms):
    """The same against the exact truth of a `ProblemStatement`, with the errors on the contact
    part.

    The function raises `SceneError` where critical points are asked for and none of the exact ones
    lies there.
    """
    from signorini.errors.contact import contact_errors
    from signorini.errors.exact import ExactErrors
    from signorini.errors.unresolved import unresolved

    exact, coefficient = statement.exact, statement.data.coefficient
    errors = ExactErrors(exact, [norm for norm in norms if norm not in CONTACT])
    on_contact = [norm for norm in norms if norm in CONTACT]

    def of(found):
        mesh = domain.level(found.n)
        weight = _weight(mesh, coefficient, norms)
        result = errors.of(mesh, found.element, found.u, weight)
        if on_contact:
            contact = contact_errors(mesh, found.element, found, exact)
            _check_critical_points(on_contact, contact, exact)
            result |= {norm: contact[norm] for norm in on_contact}
        floors = norm_floors(mesh, RoundOff.of(found), norms, weight)
        return _with_floor(
            result, floors, lambda doubtful: unresolved(mesh, exact, doubtful, weight)
        )

    return of


def _check_critical_points(norms, errors, exact):
    if "critical_points" in norms and errors["critical_points"] is None:
        named = ", ".join(f"({x:g}, {y:g})" for x, y in exact.critical_points)
        raise SceneError(
            f"norms: critical_points needs exact ones on the contact part, but {named} lie off it; mend "
            "truth.critical_points or the family's parameters, or drop critical_points from norms"
        )


def _weight(mesh, coefficient, norms):
    """The diffusion coefficient, where a norm depends on it."""
    return coefficient_on(mesh, coefficient) if {"energy", "multiplier_l2"} & set(norms) else None


def _with_floor(errors, floors, unresolved):
    return errors | {"floor": " ".join(round_off_alone(errors, floors, unresolved))}


def row(found, errors):
    """The row of a stored solution: what it is, its errors, and how it was found."""
    what = {"element": found.element, "n": found.n, "h": found.h, "dofs": found.dofs}
    proof = {
        "residual": found.residual,
        "accuracy": found.accuracy,
        "multiplier_accuracy": found.multiplier_accuracy,
        "undecided": int(found.undecided.sum()),
    }
    how = {"status": found.status, "iterations": found.iterations, "method": found.method}
    return what | errors(found) | proof | how
