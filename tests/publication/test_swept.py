"""Numbers of a sweep for a manuscript: those of its table, and those that follow from them."""

import csv
import statistics

import pytest
import yaml

from signorini.commands.program import main
from signorini.publication.keys import declared_keys, table_of
from signorini.publication.made import made_files
from signorini.publication.numbers import read_numbers
from signorini.scene.read import load_scene

LOADS = [-4, -1, -3]
SCENE = {
    "domain": {"kind": "rectangle"},
    "boundary": {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"},
    "data": {"f": -1, "obstacle": "-0.3 - 0.2*x"},
    "levels": [2, 4],
    "truth": {"kind": "reference", "n": 16},
    "quantities": {"pull": {"kind": "flux", "through": "dirichlet"}},
    "sweep": {"data.f": LOADS},
}


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """A scene and the folder of its sweep."""
    folder = tmp_path_factory.mktemp("swept")
    path = folder / "loads.yaml"
    path.write_text(yaml.safe_dump(SCENE))
    assert main(["sweep", str(path), "-o", str(folder)]) == 0
    return load_scene(path), folder


def test_each_declared_key_has_a_number_and_no_other_has(swept):
    scene, folder = swept
    declared = declared_keys(scene.document)
    found = read_numbers(scene, folder, ["scene", "sweep"])
    assert [key for key in found if not table_of(key, declared)] == []
    wanted = {key for key, table in declared.items() if table == "sweep" and "*" not in key}
    missing = wanted - found.keys()
    assert {key.split(", ")[1] for key in missing} <= {"first_critical", "last_critical"}
    assert found["sweep, count"] == "3"


def test_numbers_are_those_of_the_finest_level_in_the_order_of_the_points(swept):
    scene, folder = swept
    found = read_numbers(scene, folder, ["sweep"])
    with (folder / "sweep.csv").open(encoding="utf-8") as stream:
        finest = [
            row for row in csv.DictReader(stream) if (row["element"], row["n"]) == ("CR", "4")
        ]
    for name in ("resultant", "l2", "rate_l2", "quantity.pull"):
        told = [found[f"sweep, {name}, CR, {number}"] for number in (1, 2, 3)]
        assert told == [row[name] for row in finest]


def test_extremes_are_told_with_their_places(swept):
    """What the load brings, floor and lid carry: the heavier, the more is on the floor."""
    scene, folder = swept
    found = read_numbers(scene, folder, ["sweep"])
    forces = [float(found[f"sweep, resultant, CR, {number}"]) for number in (1, 2, 3)]
    for word, value in (("least", min), ("greatest", max), ("median", statistics.median)):
        assert float(found[f"sweep, resultant, CR, {word}"]) == value(forces)
    assert float(found["sweep, resultant, CR, at_greatest"]) == min(LOADS)
    assert float(found["sweep, resultant, CR, at_least"]) == max(LOADS)
    for load, force, number in zip(LOADS, forces, (1, 2, 3), strict=True):
        pull = float(found[f"sweep, quantity.pull, CR, {number}"])
        assert force + pull == pytest.approx(-load)


def test_an_extreme_among_several_keys_or_names_has_no_place():
    for section in ({"domain.diagonal": ["falling", "rising"]}, {"data.f": [1], "data.g": [1]}):
        document = load_scene("config/scenes/punch-widths.yaml").document | {"sweep": section}
        declared = declared_keys(document)
        assert declared["sweep, resultant, CR, greatest"] == "sweep"
        assert "sweep, resultant, CR, at_greatest" not in declared


def test_a_sweep_makes_a_table_and_a_figure_for_the_manuscript(swept):
    scene, folder = swept
    made = made_files(scene.document)
    assert {made[f"sweep.{end}"] for end in ("tex", "pdf")} == {"sweep.tex", "sweep.pdf"}
    whole = (folder / "sweep.tex").read_text().partition(r"\end{tabular}")[0]
    assert whole.partition(r"\midrule")[2].count("\\\\\n") == len(LOADS)
    assert "sweep.tex" not in made_files(load_scene("config/scenes/punch.yaml").document)
