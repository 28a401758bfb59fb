"""Compute Table 5.1 in another way that is equally right."""

import json
import os

from stage import options, run


@options(
    "--statement",
    "--scene",
    "--variant",
    ("--samples", {"type": int}),
    ("--threads", {"type": int}),
    "--output",
)
def main(arguments):
    """A statement, what the scene asks (elements, levels, truth, norms; JSON) and a variant to a
    row per number.
    """
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ[name] = str(arguments.threads)
    # NumPy counts its threads when it is imported.
    from signorini.scene.statement import ProblemStatement
    from signorini.storage import write_csv
    from signorini.studies.stability.digits import variant

    statement = ProblemStatement.from_mapping(json.loads(arguments.statement))
    rows = variant(arguments.variant, statement, json.loads(arguments.scene), arguments.samples)
    if arguments.threads > 1:
        rows = [row | {"variant": f"{arguments.threads}-threads-{row['variant']}"} for row in rows]
    write_csv(arguments.output, rows)
    return f"digits: {arguments.variant}, {len(rows)} numbers"


if __name__ == "__main__":
    run(main, __doc__)
