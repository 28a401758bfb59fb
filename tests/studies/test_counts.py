"""Counts of work and bytes of every scene that ships, against those on record:
tests/data/counts.csv.
"""

import warnings
from pathlib import Path

import pytest

import signorini
from signorini.storage import read_table
from solve_counts import changes, count_scene

FOLDER = Path(__file__).parents[2] / "config" / "scenes"
RECORD = read_table(Path(__file__).parents[1] / "data" / "counts.csv")
REMEDY = (
    "if on purpose: python benchmarks/counts.py --write, and commit tests/data/counts.csv with the"
    " reason"
)
ROW = {
    "scene": "paper", "element": "P1", "method": "direct", "products": 5, "cycles": 0,
    "factorisations": 1, "steps": 10, "inner": 100, "bytes_per_unknown": 1000,
}  # fmt: skip


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.yaml")))
def test_no_count_has_grown(name, element):
    recorded = [row for row in RECORD if (row["scene"], row["element"]) == (name, element)]
    grown, shrunk = changes(
        recorded, count_scene(signorini.load_scene(FOLDER / f"{name}.yaml"), element)
    )
    if shrunk:
        warnings.warn(
            f"fewer than on record: {'; '.join(shrunk)}; to keep it so: {REMEDY}", stacklevel=1
        )
    assert not grown, f"{'; '.join(grown)}; {REMEDY}"


def test_counting_twice_gives_the_same():
    scene = signorini.load_scene(FOLDER / "paper.yaml")
    first, second = count_scene(scene, "CR"), count_scene(scene, "CR")
    assert changes(first, second) == ([], [])
    counts = [{key: row[key] for key in row if key != "bytes_per_unknown"} for row in first]
    assert counts == [{key: row[key] for key in counts[0]} for row in second]


@pytest.mark.parametrize(
    ("name", "value", "grown", "shrunk"),
    [
        ("steps", 11, 0, 0),
        ("steps", 12, 1, 0),
        ("factorisations", 2, 1, 0),
        ("cycles", 1, 1, 0),
        ("bytes_per_unknown", 1101, 1, 0),
        ("inner", 91, 0, 0),
        ("inner", 89, 0, 1),
    ],
)
def test_a_tenth_is_allowed(name, value, grown, shrunk):
    found = changes([ROW], [ROW | {name: value}])
    assert tuple(map(len, found)) == (grown, shrunk)
    assert all(f"paper P1 direct: {name}" in line for lines in found for line in lines)


def test_a_route_that_comes_or_goes_is_told():
    assert changes([], [ROW]) == (["paper P1 direct: not in the record"], [])
    assert changes([ROW], []) == (
        ["paper P1 direct: recorded, but the route no longer applies"],
        [],
    )
