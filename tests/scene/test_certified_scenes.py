"""Scenes whose errors are guaranteed."""

from pathlib import Path

import pytest

import signorini
from scene_texts import VALID, changed
from signorini.exceptions import SceneError
from signorini.scene.certified import is_certified
from signorini.scene.read import read_scene

TRUTH = "truth: {kind: reference, element: P1, n: 32}"


def read(tmp_path, text):
    path = tmp_path / "scene.yaml"
    path.write_text(text, encoding="utf-8")
    return read_scene(path)


def test_a_truth_of_its_own_has_a_table_and_figures(tmp_path):
    scene = read(tmp_path, changed(TRUTH, "truth: {kind: certificate}"))
    assert is_certified(scene.document)
    assert scene.document["outputs"] == ["table", "figures"]


def test_certificates_beside_another_truth_are_asked_for(tmp_path):
    assert not is_certified(read(tmp_path, VALID).document)
    scene = read(tmp_path, f"{VALID}certificate: true\n")
    assert is_certified(scene.document)
    assert scene.truth["kind"] == "reference"


def test_one_level_is_enough(tmp_path):
    text = changed(TRUTH, "truth: {kind: certificate}").replace("[2, 4, 8]", "[4]")
    assert read(tmp_path, text).levels == [4]


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ("outputs: [errors]", "outputs: errors needs a truth to compare with"),
        ("outputs: [rates]", "outputs: rates needs a truth to compare with"),
        (
            "expect: {slopes: {h1: 1}}",
            "expect: needs errors, which truth.kind certificate does not",
        ),
        ("norms: [multiplier_l2]", "norms: multiplier_l2 needs an exact truth"),
    ],
)
def test_what_only_a_truth_has_is_refused(tmp_path, more, message):
    text = changed(TRUTH, f"truth: {{kind: certificate}}\n{more}")
    with pytest.raises(SceneError, match=message):
        read(tmp_path, text)


def test_a_reference_of_a_certificate_is_refused(tmp_path):
    with pytest.raises(SceneError, match=r"truth\.n: only for kind reference, here kind is"):
        read(tmp_path, changed(TRUTH, "truth: {kind: certificate, n: 32}"))


def test_a_curved_body_has_none(tmp_path):
    text = Path("config/scenes/annulus.yaml").read_text(encoding="utf-8")
    with pytest.raises(SceneError, match="certificate: the triangles do not fill a body"):
        read(tmp_path, f"{text}certificate: true\n")


def test_the_shipped_scene_has_no_truth_but_its_bounds():
    scene = signorini.load_scene("config/scenes/overhang.yaml")
    assert scene.truth == {"kind": "certificate"}
    assert scene.problem_statement.exact is None
