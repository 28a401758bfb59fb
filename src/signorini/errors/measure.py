"""From stored solutions to the rows of errors.csv."""

from signorini.coefficient import coefficient_on
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
        To a dict, norm -> error or None.
    """
    from signorini.errors.reference import ReferenceErrors

    mesh = domain.level(truth.n)
    weight = coefficient_on(mesh, read_coefficient(coefficient)) if "energy" in norms else None
    errors = ReferenceErrors(mesh, truth.element, truth.u, norms, quadrature, weight)
    return lambda found: errors.of(domain.level(found.n), found.element, found.u)


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
        weight = coefficient_on(mesh, coefficient) if "energy" in norms else None
        result = errors.of(mesh, found.element, found.u, weight)
        if on_contact:
            contact = contact_errors(mesh, found.element, found, exact)
            result |= {norm: contact[norm] for norm in on_contact}
        return result

    return of


def row(found, errors):
    """The row of a stored solution: what it is, its errors, and how it was found."""
    what = {"element": found.element, "n": found.n, "h": found.h, "dofs": found.dofs}
    how = {"residual": found.residual, "status": found.status, "iterations": found.iterations, "method": found.method}
    return what | errors(found) | how
