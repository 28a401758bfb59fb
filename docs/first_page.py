"""The block of README.md that tells what is special: its numbers are those of the paper's check and
of the kept studies.
"""

import csv
from decimal import ROUND_CEILING, ROUND_FLOOR
from pathlib import Path

from signorini.report.certificates import outward

STUDIES = Path(__file__).resolve().parent / "studies"
REFERENCE = {"scene": "paper", "element": "P1", "method": "fourier", "n": "512"}
SIXTH = {"hypothesis": "load in single precision", "of": "all"}
PROMISES = """\
- **A paper's numbers, checked digit by digit.** The experiment of Hua and Wang (2007) is rebuilt
  from the statement of its problem, and five choices that it leaves open were found by trial:
  {met} ([the paper](docs/paper.md));
  with the load rounded to single precision, {sixth}
  ([a sixth choice](docs/studies/sensitivity/sensitivity.md#a-sixth-choice)).
- **Solutions that say how far to trust them.** Each states its residual, how far rounding may have
  moved $u$ and the contact forces, and for which contact unknowns rounding leaves open whether they
  touch. Of {solutions} solves of generated problems {solved} are called `solved`; held against
  extended precision, {wrong} of them is wrong ([stability](docs/studies/stability/stability.md)).
- **Guaranteed errors.** `signorini.certify(solution)` gives proved bounds of the energy error,
  without an exact or a finer solution ([certificates](docs/certificate.md)). The error of the
  paper's CR solution on {finest} by {finest} squares lies between {lower} and {upper};
  its table, which measures against a reference solution, implies {printed}
  ([the table between bounds](docs/studies/guaranteed/guaranteed.md)).
- **Milliseconds.** The paper's reference solution, {unknowns} unknowns, takes {milliseconds:.0f} ms
  on one thread, from the statement of the problem to the checked solution
  ([its row](docs/studies/benchmark/benchmark.csv), [speed](docs/speed.md)).
"""


def promises(verdict):
    """What is special, as Markdown.

    Parameters
    ----------
    verdict : str
        The line of results/paper/check.txt.
    """
    met = verdict.partition(";")[0]
    return PROMISES.format(met=met, sixth=sixth_choice(), **proofs(), **bounds(), **speed())


def sixth_choice():
    """How many last digits are met with the load in single precision, by the sensitivity study."""
    rows = _rows("sensitivity/sensitivity_digits.csv")
    row = next(row for row in rows if row.items() >= SIXTH.items())
    return f"{row['digits']} of {row['errors']}"


def proofs():
    """Solves of the stability study, those called solved, and those of them that are wrong."""
    rows = _rows("stability/statuses.csv")
    keys = ("solutions", "solved", "wrong")
    counts = {key: sum(int(row[key]) for row in rows) for key in keys}
    return counts | {"wrong": counts["wrong"] or "none"}


def bounds():
    """The guaranteed interval of CR's finest error, and what was printed."""
    row = [row for row in _rows("guaranteed/guaranteed.csv") if row["element"] == "CR"][-1]
    lower, upper = outward(row["lower"], ROUND_FLOOR), outward(row["upper"], ROUND_CEILING)
    printed = f"{float(row['printed']):.6f}"
    return {"finest": row["n"], "lower": lower, "upper": upper, "printed": printed}


def speed():
    """What the paper's reference takes, by the benchmark study."""
    rows = _rows("benchmark/benchmark.csv")
    row = next(row for row in rows if row.items() >= REFERENCE.items())
    unknowns = f"{int(row['dofs']):,}".replace(",", " ")
    return {"unknowns": unknowns, "milliseconds": 1000 * float(row["total"])}


def _rows(name):
    with open(STUDIES / name, encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))
