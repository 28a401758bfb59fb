"""Local contributions in the viewer: what triangles have in a guaranteed bound, as colours."""

import base64
import json
import re

import numpy as np
import pytest

pytest.importorskip("plotly")

from browser import CHROMIUM, MISSING, told_by
from signorini import load_scene
from signorini.api.solving import solve_levels
from signorini.certificate.level import certified_level
from signorini.commands.program import main
from signorini.report.field import sums_on_coarser
from signorini.report.viewer import viewer_data
from signorini.report.viewer_page import viewer_page

SCENE = load_scene("config/scenes/corner.yaml")
DOMAIN = SCENE.problem_statement.triangulations


def numbers(array):
    return np.frombuffer(base64.b64decode(array["base64"]), f"<{array['kind']}")


@pytest.fixture(scope="module")
def solutions():
    return list(solve_levels(SCENE))


@pytest.fixture(scope="module")
def level(solutions):
    """The certificates of n = 8 alone."""
    own = {solution.element: solution for solution in solutions if solution.n == 8}
    mesh, h = DOMAIN.level(8), DOMAIN.mesh_size(8)
    return certified_level(SCENE.problem_statement, mesh, own, n=8, h=h)


@pytest.fixture(scope="module")
def data(solutions, level):
    found = {(e, 8): level.of_triangles(e)["contribution"] for e in level.elements}
    return viewer_data(SCENE, DOMAIN, solutions, contributions=found)


def test_the_shares_of_a_bound_are_all_of_it(data):
    shares = {(one["element"], one["n"]): one["shares"] for one in data["solutions"]}
    found = [numbers(shares.pop((element, 8))) for element in ("P1", "CR")]
    for percent in found:
        assert percent.size == DOMAIN.level(8).number_of_triangles
        assert percent.min() >= 0.0
        assert percent.sum() == pytest.approx(100.0, rel=1e-6)
    assert set(shares.values()) == {None}


def test_a_coarser_triangle_has_what_its_parts_have():
    """Of areas, weighted on the left: the sums are those of the coarser triangles themselves."""
    fine, coarse = DOMAIN.level(16), DOMAIN.level(8)
    found = sums_on_coarser(fine, weighted_areas(fine), coarse.number_of_triangles)
    np.testing.assert_allclose(found, weighted_areas(coarse), rtol=1e-13)


def weighted_areas(mesh):
    left = mesh.p[0, mesh.t].mean(axis=0) < 0.5
    corners = mesh.p[:, mesh.t]
    along, across = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.abs(along[0] * across[1] - along[1] * across[0]) / 2
    return np.where(left, 3.0, 1.0) * areas


STEPS = """
const shows = (what, colour) => until(() =>
  document.body.dataset.shown === what && document.body.dataset.colour === colour);
const step = () => {
  const [surface] = at("surface").data;
  told.steps.push({
    hidden: at("colours").hidden, note: !at("local").hidden,
    mode: surface.intensitymode || "vertex",
    count: surface.intensity.length, high: Math.max(...surface.intensity), top: surface.cmax,
    title: surface.colorbar.title.text, address: location.hash, light: surface.lighting,
  });
};
const level = (place) => {
  at("slider").value = place;
  at("slider").dispatchEvent(new Event("input"));
};
level(data.levels.indexOf(8));
await shows("P1 8", "height");
step();
at("share").click();
await shows("P1 8", "share");
step();
at("CR").click();
await shows("CR 8", "share");
step();
level(data.levels.length - 1);
await until(() => document.body.dataset.colour === "height");
step();
"""


@pytest.mark.skipif(not CHROMIUM, reason=MISSING)
def test_a_browser_colours_by_contributions_where_there_are_some(data, tmp_path):
    told = told_by(viewer_page(data), tmp_path, STEPS, size=(390, 844))
    assert told["wrong"] == []
    height, p1, cr, without = told["steps"]
    assert not any(step["hidden"] for step in told["steps"])
    assert [step["note"] for step in told["steps"]] == [False, True, True, False]
    shown = {one["element"]: numbers(one["shares"]) for one in data["solutions"] if one["n"] == 8}
    for step, element in ((p1, "P1"), (cr, "CR")):
        assert step["mode"] == "cell"
        assert step["count"] == shown[element].size
        assert step["high"] == step["top"] == pytest.approx(np.log10(shown[element].max()))
        assert step["light"] == {"ambient": 1, "diffuse": 0, "specular": 0}
    assert height["mode"] == without["mode"] == "vertex"
    assert height["title"] == "u"
    assert p1["address"].endswith("&colour=share")


@pytest.mark.skipif(not CHROMIUM, reason=MISSING)
def test_without_certificates_there_is_no_choice(solutions, tmp_path):
    steps = """
    await until(() => document.body.dataset.shown);
    told.steps.push([at("colours").hidden, at("uncertified").hidden]);
    """
    told = told_by(viewer_page(viewer_data(SCENE, DOMAIN, solutions)), tmp_path, steps)
    assert told["steps"] == [[True, False]]  # and the page says how to get it


def data_of(page):
    content = re.search(r'<script id="content" type="application/json">(.*?)</script>', page, re.S)
    return json.loads(content.group(1))


def test_bounds_that_the_command_computes_are_those_of_a_build(level, tmp_path):
    page = tmp_path / "viewer.html"
    assert main(["viewer", "config/scenes/corner.yaml", "--certify", "-o", str(page)]) == 0
    shown = {(one["element"], one["n"]): one for one in data_of(page.read_text())["solutions"]}
    assert all(one["shares"] for one in shown.values())
    for row in level.rows():
        low, high = map(float, shown[row["element"], 8]["certificate"])
        assert low <= row["lower"] <= row["upper"] <= high
        assert high - low < 1.01 * (row["upper"] - row["lower"]) + 1e-3 * high


def test_a_curved_body_is_not_certified(tmp_path, capsys):
    words = ["viewer", "config/scenes/annulus.yaml", "--certify", "-o", str(tmp_path / "v.html")]
    assert main(words) == 1
    assert "--certify: the triangles do not fill" in capsys.readouterr().err
