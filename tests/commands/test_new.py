"""`signorini new`: a scene that is valid as it stands, and with --paper an article."""

import pytest

from signorini.commands.program import main
from signorini.publication.check import check_publication
from signorini.scene.read import load_scene


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A project with a folder of scenes, the working folder."""
    (tmp_path / "config/scenes").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_scene_alone_has_no_publication(folder):
    assert main(["new", "mine"]) == 0
    assert "publication" not in load_scene("config/scenes/mine.yaml").document
    assert not (folder / "paper").exists()


def test_an_article_comes_with_its_scene_and_asks_for_what_there_is(folder):
    assert main(["new", "mine", "--paper"]) == 0
    scene = load_scene("config/scenes/mine.yaml")
    assert scene.document["publication"]["manuscript"] == "paper/mine.tex"
    check_publication(scene)
    article = (folder / "paper/mine.tex").read_text(encoding="utf-8")
    assert "config/scenes/mine.yaml" in article
    before, _ = article.split("Find $u$ with ")
    assert "yours to change when you change the scene" in before.splitlines()[-1]


@pytest.mark.parametrize("there", ["config/scenes/mine.yaml", "paper/mine.tex"])
def test_what_is_there_is_left_alone(folder, there, capsys):
    (folder / "paper").mkdir()
    (folder / there).write_text("mine")
    assert main(["new", "mine", "--paper"]) == 1
    assert f"error: {there}: there already; choose another name" in capsys.readouterr().err
    assert [path.name for path in folder.rglob("mine.*")] == [there.rpartition("/")[2]]
