"""The solutions of a point, level by level, and what they are worth: rows of numbers."""

import json
import math

from signorini.errors.measure import against_exact, against_reference, error_row
from signorini.errors.norms import RATED, REFERENCE
from signorini.fem.problem import discretize_on
from signorini.mesh.domain import make_domain
from signorini.report.outputs import output_rows
from signorini.scene.memory_check import check_level
from signorini.solvers import solve
from signorini.solvers.stored import stored
from signorini.sweeps.names import QUANTITY
from signorini.sweeps.quantities import contact_quantities


class Solver:
    """Solves points one after the other; what two of them share is done once.

    Domains are kept as long as the next point has the same, and so are solutions: of points in a
    row that state the same problem, the first one solves it.
    """

    def __init__(self):
        self._domain_key = self._domain = None
        self._statement_key, self._solutions = None, {}

    def rows(self, scene):
        """The rows of a point: one for each element and level.

        Parameters
        ----------
        scene : Scene
            Of the point.

        Returns
        -------
        list of dict
            The columns of errors.csv, the errors where there is a truth; ``rate_l2``, ... between
            each level and the one before; `contact_quantities`; and by `QUANTITY` and its name
            each of the scene's quantities.

        Raises
        ------
        SignoriniError
            Where the point cannot be solved or measured.
        """
        domain = self._domain_of(scene)
        statement = scene.problem_statement.on(domain)
        statement.check()
        found = self._found_of(scene)
        return list(self._rows(scene, statement, found))

    def _rows(self, scene, statement, found):
        domain = statement.triangulations

        def solved(element, n):
            if (element, n) not in found:
                found[element, n] = _solve(scene, statement, element, n)
            return found[element, n]

        errors = _errors(scene, statement, solved)
        for element in scene.elements:
            before = None
            for n in scene.levels:
                problem, solution = solved(element, n)
                row = error_row(solution, errors)
                contact = contact_quantities(domain.level(n), solution)
                asked = output_rows(problem, solution, scene.document["quantities"])
                named = {f"{QUANTITY}{found['name']}": found["value"] for found in asked}
                yield row | _rates(before, row) | contact | named
                before = row

    def _domain_of(self, scene):
        """The domain of a scene: that of the scene before where it is the same."""
        parts = scene.section("domain", "boundary") | {"coarsest": scene.levels[0]}
        key = json.dumps(parts, sort_keys=True)
        if key != self._domain_key:
            self._domain = make_domain(**parts)
            self._domain_key = key
        return self._domain

    def _found_of(self, scene):
        """The solutions that are known of the problem of a scene."""
        key = json.dumps([scene.statement, scene.document["solver"]], sort_keys=True)
        if key != self._statement_key:
            self._statement_key, self._solutions = key, {}
        return self._solutions


def _solve(scene, statement, element, n):
    """The problem of one element and level, and its stored solution."""
    domain, method = statement.triangulations, scene.document["solver"]["method"]
    check_level(statement, element, n, method, domain)
    problem = discretize_on(domain.level(n), element, statement)
    return problem, stored(problem, solve(problem, method), n, domain.mesh_size(n))


def _errors(scene, statement, solved):
    """A function from a solution to its errors, of which there are none without a truth."""
    truth, norms, domain = scene.truth, scene.document["norms"], statement.triangulations
    if truth["kind"] == "none":
        return lambda solution: {}
    if truth["kind"] == "exact":
        return against_exact(statement, domain, norms)
    quadrature = scene.document["norm_quadrature"]
    _, reference = solved(truth["element"], truth["n"])
    coefficient = scene.document["data"]["coefficient"]
    return against_reference(reference, domain, norms, quadrature, coefficient)


def _rates(before, after):
    """The slope of each error between two levels, ``rate_l2``, ...; None where there is none."""
    norms = [norm for norm in RATED if norm in after]
    return {f"rate_{norm}": _rate(before, after, norm) for norm in norms}


def _rate(before, after, norm):
    errors = [found[norm] for found in (before, after) if found and found[norm]]
    means_nothing = {norm, REFERENCE} & {*after["floor"].split()}
    if len(errors) < 2 or means_nothing or not all(map(math.isfinite, errors)):
        return None
    return math.log(errors[0] / errors[1]) / math.log(before["h"] / after["h"])
