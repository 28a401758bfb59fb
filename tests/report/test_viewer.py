"""The viewer of a scene: what it shows are the solutions, and a browser can turn through them."""

import base64
import json

import numpy as np
import pytest

pytest.importorskip("plotly")

from browser import CHROMIUM, MISSING, told_by
from signorini import load_scene
from signorini.api.scene_study import scene_rows
from signorini.api.solving import solve_levels
from signorini.commands.program import main
from signorini.fem.elements import find_element
from signorini.report.viewer import MOST_TRIANGLES, kept_points, viewer_data
from signorini.report.viewer_page import plotly_script, viewer_page

SCENE = load_scene("config/scenes/punch.yaml")
DOMAIN = SCENE.problem_statement.triangulations
BOUNDS = {"element": "CR", "n": "8", "lower": "0.123456", "upper": 0.123451}


def unpacked(array):
    return np.frombuffer(base64.b64decode(array["base64"]), f"<{array['kind']}")


@pytest.fixture(scope="module")
def rows():
    return scene_rows(SCENE)


@pytest.fixture(scope="module")
def data(rows):
    return viewer_data(SCENE, DOMAIN, solve_levels(SCENE), rows, [BOUNDS])


@pytest.fixture(scope="module")
def page(data):
    return viewer_page(data)


def test_every_level_shows_the_solution_at_the_corners_of_its_triangles(data):
    for shown, found in zip(data["solutions"], solve_levels(SCENE), strict=True):
        mesh = data["meshes"][shown["mesh"]]
        (x, y), t = unpacked(mesh["p"]).reshape(2, -1), unpacked(mesh["t"])
        values = find_element(found.element).vertex_values(DOMAIN.level(found.n), found.u)
        if 3 * shown["triangles"] == t.size:
            np.testing.assert_array_equal(unpacked(shown["z"]), values.ravel().astype("f4"))
        exact = SCENE.problem_statement.exact.value(x[t].astype(float), y[t].astype(float))
        np.testing.assert_allclose(unpacked(shown["z"]), exact, atol=0.6 * shown["h"])


def test_p1_is_continuous_and_cr_jumps(data):
    spread = {}
    for shown in data["solutions"]:
        t, z = unpacked(data["meshes"][shown["mesh"]]["t"]), unpacked(shown["z"])
        low, high = np.full(t.max() + 1, np.inf), np.full(t.max() + 1, -np.inf)
        np.minimum.at(low, t, z)
        np.maximum.at(high, t, z)
        spread.setdefault(shown["element"], []).append(float((high - low).max()))
    assert max(spread["P1"]) == 0
    assert min(spread["CR"]) > 1e-4
    assert spread["CR"] == sorted(spread["CR"], reverse=True)


def test_levels_on_one_mesh_share_it_and_the_page_stays_small(data, page):
    assert len(data["meshes"]) == 3
    assert data["solutions"][3]["mesh"] == data["solutions"][2]["mesh"]
    assert len(page.encode()) < 6e6


def test_bounds_are_rounded_outward(data):
    by_key = {(shown["element"], shown["n"]): shown["certificate"] for shown in data["solutions"]}
    assert by_key.pop(("CR", 8)) == ["0.1234", "0.1235"]
    assert set(by_key.values()) == {None}


def test_the_critical_points_are_those_of_the_exact_solution(data):
    for shown in data["solutions"]:
        s = [place[0] for place in shown["line"]["critical"]]
        np.testing.assert_allclose(s, [0.4, 1.6], atol=shown["h"])


def test_where_contact_goes_by_turns_is_an_interval():
    scene = load_scene("config/scenes/uniform-load.yaml")
    levels = [one for one in solve_levels(scene) if one.element == "P1"]
    shown = viewer_data(scene, scene.problem_statement.triangulations, levels)["solutions"][-1]
    ((first, last),) = shown["line"]["turns"]
    assert shown["line"]["critical"] == []
    np.testing.assert_allclose([first, last], [shown["h"] / 2, 1 - shown["h"] / 2])


def test_components_of_a_contact_line_are_apart_and_keep_their_ends():
    component, nothing = np.repeat([1, 2], [7, 5]), np.zeros(12, bool)
    assert kept_points(component, nothing, most=3).tolist() == [0, 4, 6, 7, 8, 11]


def test_data_and_triangles_of_a_page_are_few(data, page):
    """Below 1 MB without Plotly, below 100 kB for each solution, 4,096 triangles at most."""
    of_data = len(json.dumps(data)) / len(data["solutions"])
    assert len(page.encode()) - len(plotly_script().encode()) < 1e6
    assert of_data < 100e3
    for mesh in data["meshes"]:
        assert unpacked(mesh["t"]).size <= 3 * MOST_TRIANGLES


def test_a_text_of_a_scene_cannot_end_its_element(data):
    evil = viewer_page(data | {"title": "</script><script>alert(1)</script>"})
    assert "alert(1)</script>" not in evil


def test_a_folder_that_was_not_built_is_refused(tmp_path, capsys):
    words = ["viewer", "config/scenes/punch.yaml", "--results", str(tmp_path), "-o"]
    assert main([*words, str(tmp_path / "viewer.html")]) == 1
    remedy = "build the scene with snakemake --cores 2 --config 'scenes=[punch]'"
    assert remedy in capsys.readouterr().err
    assert not (tmp_path / "viewer.html").exists()


def test_a_file_is_no_folder_of_a_build(tmp_path, capsys):
    words = ["viewer", "config/scenes/punch.yaml", "--results", "README.md", "-o"]
    assert main([*words, str(tmp_path / "viewer.html")]) == 1
    assert "--results README.md: is a file; name the folder of a build" in capsys.readouterr().err


STEPS = """
const numbers = () => Object.fromEntries([...at("numbers").rows].map((row) =>
  [row.cells[0].textContent, row.cells[1].textContent]));
const step = (name) => told.steps.push({
  name, shown: document.body.dataset.shown, numbers: numbers(), eye: {...eye},
  traces: at("surface").data.map((trace) => trace.type), lines: at("line").data.length,
  high: Math.max(...at("surface").data[0].z), address: location.hash,
  too_wide: document.documentElement.scrollWidth > innerWidth,
});
const shows = (what) => until(() => document.body.dataset.shown === what);
const pixels = () => {
  const canvas = at("first");
  const content = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  return content.filter((value, k) => k % 4 === 3 && value > 0).length / content.length * 4;
};
told.before = {plotly: window.Plotly !== undefined, n: numbers()["n"], filled: pixels(),
  painted: document.body.dataset.painted};
at("surface").dispatchEvent(new PointerEvent("pointermove", {buttons: 1, movementX: 30}));
told.dragged = {...eye};
at("reset").click();
await shows("P1 64");
step("start");
const {dataScale, glplot} = at("surface")._fullLayout.scene._scene;
const times = (matrix, point) => [0, 1, 2, 3].map((row) =>
  point.reduce((sum, value, column) => sum + matrix[4 * column + row] * value, 0));
const {width, height} = at("surface").querySelector("canvas").getBoundingClientRect();
const mine = projection(width, height);
const plotly = (point) => {
  const {model, view, projection} = glplot.cameraParams;
  const scaled = [...point.map((value, k) => value * dataScale[k]), 1];
  const [x, y, , w] = times(projection, times(view, times(model, scaled)));
  return [(1 + x / w) / 2 * width, (1 - y / w) / 2 * height];
};
told.places = [[-1, 0, 0], [1, 1, -0.5], [0.3, 0.2, 0.1]].map((point) =>
  ({plotly: plotly(point), mine: mine(...point).slice(0, 2), width}));
told.paintedWidth = at("surface").clientWidth - MARGIN;
told.hidden = at("first").hidden;
at("CR").click();
await shows("CR 64");
step("element");
at("slider").value = 0;
at("slider").dispatchEvent(new Event("input"));
await shows("CR 8");
step("level");
at("edges").click();
await until(() => at("surface").data.length === 5);
at("surface").dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowLeft"}));
step("mesh and turn");
"""


@pytest.fixture(scope="module")
def told(page, tmp_path_factory):
    if not CHROMIUM:
        pytest.skip(MISSING)
    return told_by(page, tmp_path_factory.mktemp("browser"), STEPS, size=(500, 900))


def test_the_page_asks_the_network_for_nothing_and_nothing_goes_wrong(told):
    assert told["wrong"] == []
    assert [name for name in told["requests"] if not name.startswith(("data:", "blob:"))] == []


def test_numbers_and_a_first_view_are_there_before_plotly_is_read(told):
    before = told["before"]
    assert before.pop("filled") > 0.05
    assert before == {"plotly": False, "n": "64", "painted": "P1 64"}
    assert told["hidden"]


def test_the_first_view_is_where_plotly_puts_the_surface(told):
    for place in told["places"]:
        np.testing.assert_allclose(place["mine"], place["plotly"], atol=0.5)  # pixels
        assert place["width"] == told["paintedWidth"]


def test_the_first_view_turns_by_dragging(told):
    start, end = told["steps"][0]["eye"], told["dragged"]
    assert np.hypot(end["x"], end["y"]) == pytest.approx(np.hypot(start["x"], start["y"]))
    turned = np.arctan2(end["y"], end["x"]) - np.arctan2(start["y"], start["x"])
    assert turned == pytest.approx(-0.3)


NO_WEBGL = """<head><script>
const own = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind) {
  return kind === "2d" ? own.call(this, kind) : null;
};
</script>"""
FLAT = """
await until(() => document.body.dataset.shown === "P1 64");
at("CR").click();
await until(() => document.body.dataset.shown === "CR 64");
told.steps.push({painted: document.body.dataset.painted, told: !at("flat").hidden,
  hidden: at("first").hidden, lines: at("line").data.length});
"""


@pytest.mark.skipif(not CHROMIUM, reason=MISSING)
def test_a_browser_without_webgl_keeps_the_painted_view(page, tmp_path):
    told = told_by(page.replace("<head>", NO_WEBGL, 1), tmp_path, FLAT)
    assert told["wrong"] == []
    (step,) = told["steps"]
    assert step.pop("lines") > 0
    assert step == {"painted": "CR 64", "told": True, "hidden": False}


def test_the_numbers_follow_the_element_and_the_level(told, rows):
    errors = {(row["element"], row["n"]): row["l2"] for row in rows}
    assert [step["shown"] for step in told["steps"]] == ["P1 64", "CR 64", "CR 8", "CR 8"]
    for step in told["steps"]:
        element, n = step["shown"].split()
        assert float(step["numbers"]["error, L2"]) == pytest.approx(
            errors[element, int(n)], rel=1e-3
        )
        assert step["numbers"]["n"] == n
        assert f"element={element}&n={n}" in step["address"] or step["name"] == "start"
    assert told["steps"][2]["numbers"]["energy error in"] == "[0.1234, 0.1235]"
    assert "energy error in" not in told["steps"][1]["numbers"]


def test_the_surface_takes_the_mesh_and_turns_by_a_key(told):
    *_, before, after = told["steps"]
    assert before["traces"] == ["mesh3d", "scatter3d", "scatter3d", "scatter3d"]
    assert after["traces"] == ["mesh3d", *["scatter3d"] * 4]
    start, end = (np.array([step["eye"][axis] for axis in "xyz"]) for step in (before, after))
    assert np.linalg.norm(start) == pytest.approx(np.linalg.norm(end))
    assert np.abs(end - start).max() > 0.05


def test_a_narrow_window_shows_all_of_it(told):
    assert not any(step["too_wide"] for step in told["steps"])
