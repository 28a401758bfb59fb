"""The scene of `signorini new`: it names every key with its default, and it builds."""

import re

import pytest
from project import ROOT, Project

from signorini.commands.program import main
from signorini.scene.read import load_scene, scene_schema
from signorini.scene.strict_yaml import load_yaml

TEMPLATE = ROOT / "src/signorini/scene/template.yaml"


def keys_of(schema, path=()):
    """Path of each key of a schema -> what the schema says of it."""
    for key, part in schema.get("properties", {}).items():
        yield (*path, key), part
        yield from keys_of(part, (*path, key))


def found(document, path):
    for key in path:
        document = document[key]
    return document


@pytest.fixture
def written(tmp_path):
    """The template as it is, and with the # before each key removed."""
    text = TEMPLATE.read_text(encoding="utf-8")
    path = tmp_path / "all.yaml"
    path.write_text(re.sub(r"^( *)# ( *\w+:(?: |$))", r"\1\2", text, flags=re.M), encoding="utf-8")
    return load_yaml(TEMPLATE), load_yaml(path)


def test_it_names_every_key_with_its_default(written):
    set_there, everything = written
    for path, part in keys_of(scene_schema()):
        value = found(everything, path)  # a key that is missing is an error here
        try:
            found(set_there, path)
        except KeyError:
            assert value == part.get("default", value) or part["type"] == "object", path


def test_what_it_leaves_out_has_that_default(written, tmp_path):
    _, everything = written
    path = tmp_path / "mine.yaml"
    path.write_text(TEMPLATE.read_text(encoding="utf-8"), encoding="utf-8")
    document = load_scene(path).document
    for key in (
        "load_quadrature",
        "load_precision",
        "elements",
        "norms",
        "norm_quadrature",
        "slope",
        "outputs",
        "solver",
    ):
        assert document[key] == everything[key]
    assert document["load_quadrature"] == "exact"
    assert "Section 5" not in document["title"]


def test_it_is_a_scene_that_builds_by_the_commands_of_the_readme(tmp_path):
    """Both README files give them; the levels are as they stand, the load by the default rule."""
    commands = [
        "signorini new mine",
        "snakemake --cores 2 --config 'scenes=[mine]'",
    ]
    for page in ("README.md", "config/README.md"):
        assert "\n".join(commands) in (ROOT / page).read_text(encoding="utf-8"), page
    project = Project.fresh(tmp_path / "project")
    assert main(["new", "mine", "--folder", str(project / "config/scenes")]) == 0
    project.build("--config", "scenes=[mine]")
    built = project.results()
    assert {"mine/table.md", "mine/rates.csv", "mine/figures/solution.pdf"} <= set(built)
    rows = [line.split(",") for line in built["mine/rates.csv"].decode().splitlines()]
    column = {name: k for k, name in enumerate(rows[0])}
    slopes = {
        (row[column["element"]], row[column["norm"]]): float(row[column["slope"]])
        for row in rows[1:]
        if row[column["kind"]] == "mean"
    }
    # Linear elements, a smooth load: second order in L2, first in the energy.
    for element in ("P1", "CR"):
        assert slopes[element, "l2"] == pytest.approx(2.0, abs=0.15)
        assert slopes[element, "h1_semi"] == pytest.approx(1.0, abs=0.1)
    contact = built["mine/contact_line.csv"].decode().splitlines()
    binding = contact[0].split(",").index("binding")
    assert {row.split(",")[binding] for row in contact[1:]} == {"0", "1"}, (
        "contact on a part of the side only"
    )
