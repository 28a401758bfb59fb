"""No bound is on the wrong side of an error that an independent quadrature measures.

benchmarks/certified_scenes.py does the same for thousands of problems.
"""

import pytest

from signorini.certificate.certify import certify_level
from signorini.errors.exact import ExactErrors
from signorini.fem.problem import discretize_on
from signorini.generated.manufactured import manufactured
from signorini.solvers import solve

QUADRATURE = 1e-6  # relative, of the error's own


@pytest.mark.parametrize("seed", range(24))
def test_bounds_enclose_the_error(seed):
    drawn = manufactured(seed)
    problems = {name: discretize_on(drawn.mesh, name, drawn.statement) for name in ("P1", "CR")}
    u = {name: solve(problem).u for name, problem in problems.items()}
    found, _ = certify_level(drawn.mesh, drawn.statement.data, u["P1"], u["CR"])
    measure = ExactErrors(drawn.exact, ["energy", "l2"])
    for name, certificate in found.items():
        error = measure.of(drawn.mesh, name, u[name], problems[name].coefficient)
        assert certificate.upper >= error["energy"] * (1.0 - QUADRATURE)
        assert certificate.lower <= error["energy"] * (1.0 + QUADRATURE)
        if certificate.l2 is not None:
            assert certificate.l2 >= error["l2"] * (1.0 - QUADRATURE)
