"""The gallery: a card for each scene, and no link that leads nowhere."""

import io
import re
from urllib.parse import unquote

import pytest
from PIL import Image

from browser import CHROMIUM, MISSING, told_by
from builders import grid
from rings import solution
from signorini.commands.program import main
from signorini.report.field import field_of
from signorini.storage import write_csv, write_npz

RATE = {"element": "P1", "norm": "l2", "kind": "mean", "slope": "1.9812", "floor": "0"}
ROUND_OFF = RATE | {"element": "CR", "floor": "1"}


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """The scene punch with all that a card shows, and the scene corner with nothing."""
    folder = tmp_path_factory.mktemp("gallery") / "results"
    punch = folder / "punch"
    (punch / "figures").mkdir(parents=True)
    mesh = grid(4)
    write_npz(punch / "field.npz", kind="field", **field_of(mesh, solution(mesh, "P1")))
    write_csv(punch / "rates.csv", [RATE, ROUND_OFF])
    for name in ("viewer.html", "table.md", "figures/a b#1.png", "figures/l2.pdf"):
        (punch / name).touch()
    scenes = ["config/scenes/punch.yaml", "config/scenes/corner.yaml"]
    page = folder / "gallery.html"
    assert main(["gallery-page", *scenes, "--results", str(folder), "-o", str(page)]) == 0
    return folder


@pytest.fixture(scope="module")
def cards(results):
    page = (results / "gallery.html").read_text(encoding="utf-8")
    return dict(re.findall(r'<article id="(.*?)">(.*?)</article>', page, re.S))


def test_every_link_leads_to_a_file_from_where_the_page_is(results, cards):
    links = re.findall(r'href="(.*?)"', cards["punch"])
    files = [(results / unquote(link)).relative_to(results / "punch").as_posix() for link in links]
    assert files == ["viewer.html", "table.md", "rates.csv", "figures/a b#1.png"]
    assert all((results / unquote(link)).is_file() for link in links)


def test_what_was_not_built_is_named_and_not_linked(cards):
    assert "href" not in cards["corner"]
    assert "<img" not in cards["corner"]
    assert "not built: viewer, tables, figures" in cards["corner"]
    assert "not built" not in cards["punch"]


def test_slopes_are_those_of_the_table_but_for_round_off(cards):
    row = re.search(r"<tr><th>L2</th>(.*?)</tr>", cards["punch"]).group(1)
    assert re.findall(r"<td>(.*?)</td>", row) == ["1.98", "–"]


def test_figures_go_by_what_they_show(results, cards):
    assert ">a b#1</a>" in cards["punch"]
    from signorini import load_scene
    from signorini.report.gallery_page import card_of

    scene, folder = load_scene("config/scenes/corner.yaml"), results / "named"
    (folder / "figures").mkdir(parents=True)
    for name in ("h1_semi", "contact_line"):
        (folder / f"figures/{name}.png").touch()
    named = card_of(scene, folder, results)["links"]["figures"]
    assert [text for text, _ in named] == ["contact line", "H1 seminorm"]


def test_a_text_of_a_scene_is_no_markup(tmp_path):
    from signorini import load_scene
    from signorini.report.gallery_page import card_of, gallery_page

    card = card_of(load_scene("config/scenes/corner.yaml"), tmp_path / "corner", tmp_path)
    page = gallery_page([card | {"title": "<script>alert(1)</script>"}])
    assert "<script>" not in page


PADDING = 24  # at most, in pixels, below the last line of a card
STEPS = """
const [picture] = document.images;
told.steps.push({
  decoded: picture.complete && picture.naturalWidth > 0, pictures: document.images.length,
  too_wide: document.documentElement.scrollWidth > innerWidth,
  blank: Array.from(document.querySelectorAll("article"), (card) =>
    card.getBoundingClientRect().bottom - card.lastElementChild.getBoundingClientRect().bottom),
  stretched: picture.width / picture.height / (picture.naturalWidth / picture.naturalHeight) - 1,
});
"""


@pytest.mark.skipif(not CHROMIUM, reason=MISSING)
@pytest.mark.parametrize("width", [500, 1200])
def test_a_browser_shows_it_without_a_network(results, tmp_path, width):
    page = (results / "gallery.html").read_text(encoding="utf-8")
    told = told_by(page, tmp_path, STEPS, size=(width, 900))
    assert told["wrong"] == []
    assert [name for name in told["requests"] if not name.startswith("data:")] == []
    (step,) = told["steps"]
    assert max(step.pop("blank")) < PADDING  # a card ends where what it tells ends
    assert abs(step.pop("stretched")) < 0.02  # of a pixel in some hundred
    assert step == {"decoded": True, "pictures": 1, "too_wide": False}


def test_a_picture_has_its_colours_and_no_more(results):
    from signorini.figures.gallery import draw_picture
    from signorini.figures.style import reduced_png
    from signorini.storage import read_npz

    field = read_npz(results / "punch/field.npz", kind="field")
    first, second = (reduced_png(draw_picture(field), 64) for _ in range(2))
    assert first == second
    assert 3 < len(Image.open(io.BytesIO(first)).getcolors()) <= 64
