"""Guaranteed bounds against errors that are known: thousands of problems drawn at random.

    python benchmarks/certified_scenes.py [--seeds 0 1000]

Each problem has a known solution (`generated.manufactured`): sheared and waving bodies, curved
obstacles and boundary data, thresholds, coefficients in layers, constraints from above. The error
is measured by the quadrature of `errors.exact`, which knows nothing of the bounds. Prints every
bound on the wrong side, and how far the others are; fails where there is one.
"""

import argparse
import sys

import numpy as np

from signorini.certificate.certify import certify_level
from signorini.errors.exact import ExactErrors
from signorini.exceptions import SignoriniError
from signorini.fem.problem import discretize_on
from signorini.generated.manufactured import manufactured
from signorini.solvers.select import solve

ELEMENTS = ("P1", "CR")
QUADRATURE = 1e-6  # relative, of the error's own


def compared(seed):
    """Upper bound, lower bound and bound in L2 of each element, over the errors."""
    drawn = manufactured(seed)
    problems = [discretize_on(drawn.mesh, element, drawn.statement) for element in ELEMENTS]
    u = [solve(problem).u for problem in problems]
    found, _ = certify_level(drawn.mesh, drawn.statement.data, *u)
    measure = ExactErrors(drawn.exact, ["energy", "l2"])
    for element, problem, values in zip(ELEMENTS, problems, u, strict=True):
        error = measure.of(drawn.mesh, element, values, problem.coefficient)
        bound = found[element]
        in_l2 = np.inf if bound.l2 is None else bound.l2 / error["l2"]
        yield bound.upper / error["energy"], bound.lower / error["energy"], in_l2


def main():
    """Draw, certify, compare."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seeds", type=int, nargs=2, default=(0, 1000), metavar="N")
    ratios, refused, wrong = [], {}, []
    for seed in range(*parser.parse_args().seeds):
        try:
            own = list(compared(seed))
        except SignoriniError as error:
            refused[seed] = str(error)
            continue
        ratios += own
        wrong += [(seed, bounds) for bounds in own if not holds(*bounds)]
    upper, lower, _ = np.array(ratios).T
    print(f"{len(ratios)} bounds of {len(ratios) // 2} problems, {len(refused)} refused")
    for seed, message in refused.items():
        print(f"  seed {seed}: {message}")
    for name, values in (("upper / error", upper), ("lower / error", lower)):
        spread = np.quantile(values, [0.0, 0.1, 0.5, 0.9, 1.0])
        print(f"{name}: least, 10 %, median, 90 %, most: {' '.join(f'{q:.4f}' for q in spread)}")
    for seed, bounds in wrong:
        print(f"WRONG SIDE: seed {seed}: {bounds}")
    sys.exit(bool(wrong))


def holds(upper, lower, in_l2):
    """Whether all three are on their side."""
    return min(upper, in_l2) >= 1.0 - QUADRATURE and lower <= 1.0 + QUADRATURE


if __name__ == "__main__":
    main()
