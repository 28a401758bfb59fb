"""Rows of the paper's own table, and a surface, as the pipeline would write them."""

from itertools import pairwise
from math import log2

import pytest

from printed_table import COLUMNS, PRINTED


@pytest.fixture
def errors():
    return [
        {"element": element, "n": row["n"], "l2": row[f"l2_{tag}"], "h1": row[f"h1_{tag}"]}
        for element, tag in (("P1", "cf"), ("CR", "ncf"))
        for row in PRINTED
    ]


@pytest.fixture
def rates():
    rows = []
    for column, (norm, element) in COLUMNS.items():
        steps = [log2(float(a[column]) / float(b[column])) for a, b in pairwise(PRINTED)]
        rows.append(
            {"element": element, "norm": norm, "kind": "mean", "slope": sum(steps) / len(steps)}
        )
    return rows


@pytest.fixture
def surface():
    return {
        "x": [0, 0.5, 1],
        "u": [[0.6080882434, 0, 0]],
        "contact_x": [0, 0.25, 0.5, 0.75, 1],
        "contact_u": [0.6, 0.4, 0.1, 0, 0],
        "critical_points": [[0.6982, 0]],
    }
