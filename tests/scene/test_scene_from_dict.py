"""Scenes from mappings: what a file says, without the file."""

from pathlib import Path

import numpy as np
import pytest

from signorini.exceptions import SignoriniError
from signorini.scene.read import load_scene
from signorini.scene.scene import Scene
from signorini.scene.strict_yaml import load_yaml

SCENES = sorted((Path(__file__).parents[2] / "config/scenes").glob("*.yaml"))
SIDES = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
LEAST = {
    "domain": {"kind": "rectangle"},
    "boundary": SIDES,
    "data": {"f": -1},
    "levels": [2, 4],
}


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_a_mapping_is_the_scene_of_the_file_that_says_the_same(path):
    scene = Scene.from_dict(load_yaml(path), path.stem, path.parent)
    assert scene.document == load_scene(path).document


def test_tuples_and_numbers_of_numpy_are_lists_and_numbers():
    ours = LEAST | {"domain": {"kind": "rectangle", "size": (np.float64(2), 1)}}
    ours |= {"levels": np.array([2, 4])}
    theirs = LEAST | {"domain": {"kind": "rectangle", "size": [2.0, 1]}}
    assert Scene.from_dict(ours).document == Scene.from_dict(theirs).document


def test_the_problem_of_a_scene_is_that_of_discretize():
    import signorini

    scene = Scene.from_dict(LEAST)
    ours, theirs = scene.problem("CR", 4), signorini.discretize(scene, "CR", 4)
    assert np.array_equal(ours.b, theirs.b)
    assert ours.mesh.same_as(theirs.mesh)


def test_a_scene_is_shown_in_a_line():
    shown = "<Scene plate: P1, CR on n = 2, 4; truth none>"
    assert repr(Scene.from_dict(LEAST | {"levels": [2, 4]}, name="plate")) == shown


@pytest.mark.parametrize(
    ("mapping", "words"),
    [
        ([], ["scene", "list", "give the sections"]),
        (LEAST | {"levels": [4, 2]}, ["levels", "[4, 2]", "coarsest first"]),
        (LEAST | {"data": {"f": float("nan")}}, ["data.f", "nan"]),
        (LEAST | {"data": {"f": lambda x, y: x}}, ["data.f", "number"]),
        (LEAST | {"boundery": {}}, ["boundery", "did you mean boundary?"]),
    ],
    ids=["no mapping", "levels", "nan", "callable", "key"],
)
def test_a_mapping_that_says_nothing_valid_is_refused_in_one_line(mapping, words):
    with pytest.raises(SignoriniError) as caught:
        Scene.from_dict(mapping)
    message = str(caught.value)
    assert "\n" not in message
    assert [word for word in words if word not in message] == []
