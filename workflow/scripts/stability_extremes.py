"""One kind of extremes: scaling, domains, critical-points, contact-sets, or a random walk over
scenes.
"""

from stage import options, run

from signorini.storage import write_csv
from signorini.studies.stability import extremes as extremes

KINDS = {
    "scaling": lambda values: extremes.scaling([int(k) for k in values]),
    "sizes": lambda values: extremes.domains([10.0**k for k in values], []),
    "offsets": lambda values: extremes.domains([], [10.0**k for k in values]),
    "critical-points": lambda values: extremes.many_critical_points([int(k) for k in values]),
    "contact-sets": lambda values: extremes.contact_sets(),
    "walk": lambda values: extremes.walk(int(values[0])),
}


@options("--kind", ("--values", {"type": float, "nargs": "*"}), "--output")
def main(arguments):
    """A kind and its values (powers of two or ten, numbers of periods, of scenes) to a row per
    case.
    """
    rows = KINDS[arguments.kind](arguments.values)
    write_csv(arguments.output, rows)
    return f"extremes: {arguments.kind}, {len(rows)} cases"


if __name__ == "__main__":
    run(main, __doc__)
