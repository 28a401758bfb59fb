"""From stored solutions to the rows of errors.csv."""

CONTACT_NORMS = ("trace_l2", "multiplier_l2", "critical_points")


def against_reference(truth, domain, norms, quadrature):
    """A function from a `StoredSolution` to its errors against another one.

    Parameters
    ----------
    truth : StoredSolution
    domain : Rectangle or Refined
    norms : sequence of str
    quadrature : str
        See `ReferenceErrors`.

    Returns
    -------
    callable
        To a dict, norm -> error or None.
    """
    from signorini.errors.reference import ReferenceErrors

    errors = ReferenceErrors(domain.level(truth.n), truth.element, truth.u, norms, quadrature)
    return lambda found: errors.of(domain.level(found.n), found.element, found.u)


def against_exact(statement, domain, norms):
    """The same against the exact truth of a scene's statement (a mapping), with the errors on the contact part."""
    from signorini.errors.contact import contact_errors
    from signorini.errors.exact import ExactErrors
    from signorini.statement import ProblemStatement

    exact = ProblemStatement.from_mapping(statement).exact
    errors = ExactErrors(exact, [norm for norm in norms if norm not in CONTACT_NORMS])
    on_contact = [norm for norm in norms if norm in CONTACT_NORMS]

    def of(found):
        mesh = domain.level(found.n)
        result = errors.of(mesh, found.element, found.u)
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
