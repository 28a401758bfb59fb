"""Fit what jobs cost: src/signorini/scene/costs.json, for solves, to
docs/studies/benchmark/benchmark.csv, and job_costs.json, for others, to benchmarks/jobs.csv.

Every second level of each curve is fitted; the others are for tests/scene/test_costs.py and
tests/scene/test_job_costs.py to judge the fits by.

    python benchmarks/fit_costs.py
"""

import argparse
import csv
import json
from itertools import groupby
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

ROOT = Path(__file__).parents[1]
MEASURED = ROOT / "docs/studies/benchmark/benchmark.csv"
COSTS = ROOT / "src/signorini/scene/costs.json"
JOBS = ROOT / "benchmarks/jobs.csv"
JOB_COSTS = ROOT / "src/signorini/scene/job_costs.json"
ROUTES = ("fourier", "multigrid", "direct")
MESHED = ("l-shape",)  # all other measured scenes are grids


def measured_rows():
    """Rows that were measured, by a route that a scene can ask for."""
    rows = csv.DictReader(MEASURED.read_text(encoding="utf-8").splitlines())
    return [row for row in rows if row["status"] == "measured" and row["method"] in ROUTES]


def split(rows):
    """The rows to fit, and those to judge by: every second level of each curve."""
    return _halves(rows, _curve)


def _halves(rows, curve_of):
    curves = [list(curve) for _, curve in groupby(rows, curve_of)]
    fitted = [row for curve in curves for row in curve[::2]]
    held_out = [row for curve in curves for row in curve[1::2]]
    return fitted, held_out


def kind_of(row):
    """How the triangles of a row's scene lie."""
    return "mesh" if row["scene"] in MESHED else "grid"


def seconds_of(row):
    """Of a solve without its mesh, which is another job."""
    return float(row["total"]) - float(row["mesh"])


def peak_of(row):
    """Bytes of the process at its peak."""
    return float(row["peak"])


def measured_jobs():
    """Rows of the other jobs."""
    return list(csv.DictReader(JOBS.read_text(encoding="utf-8").splitlines()))


def split_jobs(rows):
    """The rows to fit, and those to judge by."""
    return _halves(rows, lambda row: (row["job"], row["scene"]))


def job_seconds(row):
    """Of processor time."""
    return float(row["seconds"])


def job_peak(row):
    """Bytes of the process at its peak."""
    return float(row["bytes"])


def main():
    """Fit and write both."""
    argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    ).parse_args()
    fit_solves()
    fit_jobs()


def fit_solves():
    """Write costs.json."""
    fitted, _ = split(measured_rows())
    keys = sorted({_key(row) for row in fitted})
    _write(COSTS, {"/".join(key): _costs(fitted, key) for key in keys})


def fit_jobs():
    """Write job_costs.json."""
    fitted, _ = split_jobs(measured_jobs())
    keys = sorted({_job_key(row) for row in fitted})
    _write(JOB_COSTS, {"/".join(key): _job_costs(fitted, key) for key in keys})


def _write(file, costs):
    file.write_text(json.dumps(costs, indent=1) + "\n", encoding="utf-8")


def _job_costs(rows, key):
    own = [row for row in rows if _job_key(row) == key]
    return {
        "seconds": _fit(own, job_seconds, "triangles"),
        "bytes": _fit(own, job_peak, "triangles"),
    }


def _costs(rows, key):
    own = [row for row in rows if _key(row) == key]
    alike = [row for row in rows if _key(row)[:2] == key[:2]]  # problems differ more than meshes
    return {"seconds": _fit(alike, seconds_of), "bytes": _fit(own, peak_of)}


def _fit(rows, measured, size="dofs"):
    """Start, factor, power of ``start + factor size^power``: the least relative errors.

    The squares are of logarithms, so that a model half as large is as bad as one twice as large.
    """
    sizes = np.array([float(row[size]) for row in rows])
    values = np.log([measured(row) for row in rows])

    def misses(parameters):
        log_start, log_factor, power = parameters
        return np.logaddexp(log_start, log_factor + power * np.log(sizes)) - values

    start = [values.min(), values.max() - np.log(sizes.max()), 1.0]
    log_start, log_factor, power = least_squares(misses, start).x
    return [float(f"{number:.4g}") for number in (np.exp(log_start), np.exp(log_factor), power)]


def _curve(row):
    return row["scene"], row["element"], row["method"]


def _key(row):
    return row["element"], row["method"], kind_of(row)


def _job_key(row):
    return row["job"], row["kind"]


if __name__ == "__main__":
    main()
