"""Slopes of the errors of a scene, for every element and norm."""

from stage import options, run

from signorini.norms import RATED
from signorini.rates import slopes
from signorini.storage import read_csv, write_csv


@options("--errors", "--output")
def main(arguments):
    """errors.csv to rates.csv."""
    norms = [norm for norm in RATED if norm in read_csv(arguments.errors)[0]]
    errors = read_csv(arguments.errors, numbers=("h", *norms))
    rows = []
    for element in dict.fromkeys(row["element"] for row in errors):
        found = [row for row in errors if row["element"] == element]
        for norm in (norm for norm in norms if found[0][norm] is not None):
            for kind, slope in slopes([row["h"] for row in found], [row[norm] for row in found]).items():
                rows.append({"element": element, "norm": norm, "kind": kind, "slope": slope})
    write_csv(arguments.output, rows)
    return f"rates: {len(rows)} slopes"


if __name__ == "__main__":
    run(main, __doc__)
