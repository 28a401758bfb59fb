"""From stored solutions to the rows of errors.csv."""

import numpy as np

from signorini.coefficient import coefficient_on
from signorini.errors.floor import norm_floors
from signorini.norms import CONTACT
from signorini.statement import ProblemStatement, read_coefficient


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
        To a dict: norm -> error or None, and ``"floor"``, the names of the norms that are round-off alone.
    """
    from signorini.errors.reference import ReferenceErrors

    mesh, coefficient, size = domain.level(truth.n), read_coefficient(coefficient), _largest(truth.u)
    errors = ReferenceErrors(mesh, truth.element, truth.u, norms, quadrature, _weight(mesh, coefficient, norms))

    def of(found):
        mesh = domain.level(found.n)
        accuracy, weight = max(found.accuracy, truth.accuracy), _weight(mesh, coefficient, norms)
        floors = norm_floors(mesh, max(size, _largest(found.u)), accuracy, norms, weight)
        return _with_floor(errors.of(mesh, found.element, found.u), floors)

    return of


def against_exact(statement, domain, norms):
    """The same against the exact truth of a scene's statement (a mapping), with the errors on the contact part."""
    from signorini.errors.contact import contact_errors
    from signorini.errors.exact import ExactErrors

    problem = ProblemStatement.from_mapping(statement)
    exact, coefficient = problem.exact, problem.data.coefficient
    errors = ExactErrors(exact, [norm for norm in norms if norm not in CONTACT])
    on_contact = [norm for norm in norms if norm in CONTACT]

    def of(found):
        mesh = domain.level(found.n)
        weight = _weight(mesh, coefficient, norms)
        result = errors.of(mesh, found.element, found.u, weight)
        if on_contact:
            contact = contact_errors(mesh, found.element, found, exact)
            result |= {norm: contact[norm] for norm in on_contact}
        return _with_floor(result, norm_floors(mesh, _largest(found.u), found.accuracy, norms, weight))

    return of


def _weight(mesh, coefficient, norms):
    """The diffusion coefficient, where a norm depends on it."""
    return coefficient_on(mesh, coefficient) if {"energy", "multiplier_l2"} & set(norms) else None


def _largest(u):
    return float(np.max(np.abs(u), initial=0.0))


def _with_floor(errors, floors):
    at_floor = [norm for norm, floor in floors.items() if errors[norm] is not None and errors[norm] <= floor]
    return errors | {"floor": " ".join(at_floor)}


def row(found, errors):
    """The row of a stored solution: what it is, its errors, and how it was found."""
    what = {"element": found.element, "n": found.n, "h": found.h, "dofs": found.dofs}
    how = {"residual": found.residual, "status": found.status, "iterations": found.iterations, "method": found.method}
    return what | errors(found) | how
