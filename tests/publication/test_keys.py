"""Keys: what a scene declares is what its results have, number by number."""

import pytest
from articles import SCENE

from signorini.commands.program import main
from signorini.publication.keys import BOUNDS, declared_keys, nearest_key, table_of, tidy
from signorini.publication.made import published_of
from signorini.publication.numbers import error_numbers, read_numbers
from signorini.scene.read import read_scene
from signorini.scene.scene import Scene
from signorini.storage import write_csv

TABLES = ("scene", "errors", "rates", "contact_line", "check", "effects", "surface")
SCENES = {
    "reference": SCENE.removesuffix("publication:\n"),
    "seminorm": SCENE.removesuffix("publication:\n").replace("[l2, h1]", "[h1_semi]"),
    "exact": SCENE.removesuffix("publication:\n")
    .replace("{kind: reference, n: 16}", "{kind: exact, family: corner, parameters: {x0: 0.4}}")
    .replace("left: neumann, right: neumann", "left: dirichlet, right: dirichlet")
    .replace("data: {f: 2*pi*sin(2*pi*x)}\n", "")
    .replace("[l2, h1]", "[h1, energy, trace_l2, critical_points]"),
    "quantities": SCENE.removesuffix("publication:\n")
    + "quantities: {part: {kind: contact_length}, force: {kind: flux}}\n",
}


def run(*words):
    assert main([str(word) for word in words]) == 0


@pytest.fixture(scope="module", params=SCENES)
def built(request, tmp_path_factory):
    """A scene and a folder with all its tables but the check."""
    folder = tmp_path_factory.mktemp("built")
    path = folder / "mine.yaml"
    path.write_text(SCENES[request.param], encoding="utf-8")
    scene = read_scene(path)
    run("errors", path, "-o", folder / "errors.csv")
    run("rates", path, folder / "errors.csv", "-o", folder / "rates.csv")
    run("mesh", path, "-o", folder / "mesh.npz")
    solutions = [folder / f"{element}.npz" for element in scene.elements]
    for element, file in zip(scene.elements, solutions, strict=True):
        run("solve", path, "--element", element, "--n", 4, "-o", file)
    run("contact-line", folder / "mesh.npz", *solutions, "-o", folder / "contact_line.csv")
    if scene.document["quantities"]:
        run("outputs", path, "-o", folder / "outputs.csv")
    if request.param == "reference":
        run("effects", path, folder / "errors.csv", "-o", folder / "effects.csv")
        run("solve", path, "--element", "P1", "--n", 16, "-o", folder / "reference.npz")
        reference = folder / "reference.npz"
        run("surface", folder / "mesh.npz", reference, "-o", folder / "surface.npz")
    return scene, folder


def test_declared_and_found_are_the_same(built):
    scene, folder = built
    declared = declared_keys(scene.document)
    tables = {table for table in declared.values() if (folder / f"{table}.csv").is_file()} | {
        "scene",
        *(["surface"] if (folder / "surface.npz").is_file() else []),
    }
    assert tables | {"surface", "effects"} == {*declared.values(), "surface", "effects"}
    found = read_numbers(scene, folder, tables)
    assert [key for key in found if not table_of(key, declared)] == []
    whole = {key for key, table in declared.items() if table in tables and "*" not in key}
    missing = whole - found.keys()
    # Slopes of distances that are zero.
    assert {key.split(", ")[0] for key in missing} <= {"rate", "slope"}
    assert all("critical_points" in key for key in missing)


def test_a_number_is_the_text_of_its_table(built):
    scene, folder = built
    text = (folder / "errors.csv").read_text()
    numbers = read_numbers(scene, folder, ["errors"])
    norm = scene.document["norms"][0]
    assert f",{numbers[f'{norm}, CR, 4']}," in text
    assert float(numbers["h, P1, 4"]) * 4 == pytest.approx(1)


def test_a_quantity_has_a_key_for_every_solution_and_the_reference(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(SCENES["quantities"], encoding="utf-8")
    scene = read_scene(path)
    run("outputs", path, "-o", tmp_path / "outputs.csv")
    numbers = read_numbers(scene, tmp_path, ["outputs"])
    assert numbers["quantity, part, CR, finest"] == numbers["quantity, part, CR, 4"]
    assert numbers["quantity, part, P1, coarsest"] == numbers["quantity, part, P1, 2"]
    # From the critical point of the paper's problem, 0.698, to the corner.
    assert float(numbers["quantity, part, P1, 16"]) == pytest.approx(1 - 0.698, abs=1 / 16)


def test_rates_are_slopes_between_levels():
    rows = [
        {"element": "P1", "n": "2", "h": "0.5", "l2": "0.4", "h1": ""},
        {"element": "CR", "n": "2", "h": "0.5", "l2": "0.0", "h1": "1"},
        {"element": "P1", "n": "6", "h": "0.25", "l2": "0.1", "h1": ""},
        {"element": "CR", "n": "6", "h": "0.25", "l2": "0.1", "h1": "inf"},
    ]
    numbers = error_numbers(rows, ["l2", "h1"])
    assert numbers["rate, l2, P1, 6"] == pytest.approx(2)
    assert "rate, l2, P1, 2" not in numbers
    empty = ("rate, h1, P1, 6", "rate, l2, CR, 6", "rate, h1, CR, 6")
    assert [numbers[key] for key in empty] == [None] * 3


def test_the_keys_of_the_check_are_those_of_the_table(project):
    scene, _ = project.published("l2,CR,4,0.02,1", "slope h1,P1,,1.00,1")
    declared = declared_keys(scene.document, published_of(scene.document["publication"]))
    keys = {key for key, table in declared.items() if table == "check"}
    assert {"published, l2, CR, 4", "deviation, slope, h1, P1", "check, total"} <= keys


def test_spaces_do_not_matter():
    assert tidy(" l2,CR ,\n 64") == "l2, CR, 64"


def test_a_number_of_the_contact_line_is_counted_from_one():
    declared = {"critical, CR, *": "contact_line"}
    assert table_of("critical, CR, 3", declared) == "contact_line"
    assert [table_of(f"critical, CR, {last}", declared) for last in ("0", "x", "-1")] == [None] * 3


def test_the_hint_names_the_nearest_and_where_all_are():
    assert nearest_key("slop, l2, CR", ["slope, l2, CR", "l2, CR, 4"]) == (
        "did you mean {slope, l2, CR}? `signorini macros SCENE` lists all"
    )
    assert nearest_key("?", ["l2, CR, 4"]) == "`signorini macros SCENE` lists all"


@pytest.mark.parametrize("truth", [{"kind": "exact", "family": "corner"}, {"kind": "certificate"}])
def test_guaranteed_bounds_have_keys(tmp_path, truth):
    """Every declared key of certificates.csv is found, where the column is filled."""
    known = truth["kind"] == "exact"
    data = {} if known else {"f": "1"}
    scene = Scene.from_dict(
        {
            "domain": {"kind": "rectangle"},
            "boundary": {"bottom": "contact"}
            | dict.fromkeys(("top", "left", "right"), "dirichlet"),
            "data": data,
            "levels": [4, 8],
            "truth": truth,
            "certificate": True,
        }
    )
    empty = () if known else ("error", "effectivity", "lower_ratio")
    rows = [
        {"element": element, "n": n}
        | {name: None if name in empty else f"{n}.{k}" for k, name in enumerate(BOUNDS)}
        for element in ("P1", "CR")
        for n in (4, 8)
    ]
    write_csv(tmp_path / "certificates.csv", rows)
    found = read_numbers(scene, tmp_path, ["certificates"])
    tables = declared_keys(scene.document)
    declared = [key for key, table in tables.items() if table == "certificates"]
    assert sorted(found) == sorted(declared)
    assert found["certificate, upper, CR, 8"] == found["certificate, upper, CR, finest"] == "8.0"
    assert found["certificate, lower, P1, coarsest"] == "4.1"
