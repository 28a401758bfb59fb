import csv
import os
import re
import subprocess
import sys
from math import inf, log
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("matplotlib")

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg

from signorini.fem.contact_line import contact_rows
from signorini.fem.elements import find_element
from signorini.figures.contact_line import draw_contact_line
from signorini.figures.convergence import draw_convergence
from signorini.figures.field import COLOURS, draw_field
from signorini.figures.gallery import draw_gallery
from signorini.figures.style import STYLE, TEXT_WIDTH, new_figure, save_figure
from signorini.figures.surface import draw_surface
from signorini.mesh.grid import Grid
from signorini.report.field import field_of
from signorini.storage import read_csv, write_csv

ROOT = Path(__file__).parents[2]
PRINTED = list(
    csv.DictReader((ROOT / "tests/data/table_5_1.csv").read_text().splitlines())
)  # the paper's


def published_errors():
    return [
        {
            "element": element,
            "n": row["n"],
            "h": 1 / int(row["n"]),
            "l2": row[f"l2_{tag}"],
            "h1": row[f"h1_{tag}"],
            "h1_semi": row[f"h1_{tag}"],
        }
        for element, tag in (("P1", "cf"), ("CR", "ncf"))
        for row in PRINTED
    ]


def sloping_surface(critical_points=((0.7, 0.0),)):
    x = np.linspace(0, 1, 9)
    contact_x = np.linspace(0, 1, 65)
    return {
        "x": x,
        "y": x,
        "u": np.maximum(0.7 - x, 0) * (1 - x[:, None]),
        "contact_x": contact_x,
        "contact_u": np.maximum(0.7 - contact_x, 0),
        "critical_points": np.reshape(critical_points, (-1, 2)),
    }


PAPER = (
    "contact",
    "neumann",
    "dirichlet",
    "neumann",
)  # the sides of Section 5: bottom, right, top, left


def sloping(
    element="P1", n=8, size=(1.0, 1.0), origin=(0.0, 0.0), height=1.0, labels=PAPER, turn=0.7
):
    """A grid, and max(turn - x, 0) (1 - y) of the unit square's x and y as a solution on it;
    binding from `turn` on.
    """
    mesh, kind = Grid(n, n, origin, size, "falling", labels), find_element(element)
    x, y = ((kind.nodes(mesh, np.arange(kind.size(mesh))).T - origin) / size).T
    contact = np.setdiff1d(
        kind.boundary_dofs(mesh, "contact"), kind.boundary_dofs(mesh, "dirichlet")
    )
    found = {
        "element": element,
        "n": n,
        "u": height * np.maximum(turn - x, 0) * (1 - y),
        "contact": contact,
    }
    state = {
        "active": x[contact] >= turn,
        "multiplier": np.maximum(x[contact] - turn, 0) * height / n,
    }
    return mesh, SimpleNamespace(**found, **state, lower=np.zeros(contact.size))


def sloping_field(*arguments, **options):
    return field_of(*sloping(*arguments, **options))


def sloping_rows(**options):
    return [row for element in ("P1", "CR") for row in contact_rows(*sloping(element, **options))]


FIGURES = {
    "surface": lambda: draw_surface(sloping_surface()),
    "convergence": lambda: draw_convergence(
        published_errors(), "l2", {"P1": 1.8955, "CR": "2.0979"}
    ),
    "field": lambda: draw_field(sloping_field("CR"), "a title"),
    "contact line": lambda: draw_contact_line(sloping_rows()),
    "gallery": lambda: draw_gallery(
        [("P1", "conforming", sloping_field()), ("CR", "not", sloping_field("CR"))]
    ),
}


@pytest.fixture(params=FIGURES)
def figure(request):
    return FIGURES[request.param]()


def legend(figure):
    box = [*figure.legends, *(axes.get_legend() for axes in figure.axes)]
    return [text.get_text() for legend in box if legend for text in legend.get_texts()]


def line(figure, label):
    return next(line for line in figure.axes[0].lines if line.get_label() == label)


# Files


@pytest.mark.parametrize("suffix", [".pdf", ".png"])
@pytest.mark.parametrize("name", FIGURES)
def test_same_numbers_same_bytes(tmp_path, name, suffix):
    paths = [tmp_path / f"{k}{suffix}" for k in range(2)]
    for path in paths:
        save_figure(FIGURES[name](), path)
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_other_process_same_bytes_and_no_heavy_import(tmp_path):
    code = """
import sys
from pathlib import Path
from test_figures import FIGURES
from signorini.figures.style import save_figure
for name, draw in FIGURES.items():
    save_figure(draw(), Path(sys.argv[1]) / f"{name}.pdf")
    save_figure(draw(), Path(sys.argv[1]) / f"{name}.png")
print({"matplotlib.pyplot", "scipy", "skfem"} & sys.modules.keys())
"""
    paths = os.pathsep.join([str(ROOT / "src"), str(ROOT / "tests/figures")])
    environment = os.environ | {"PYTHONPATH": paths, "PYTHONHASHSEED": "7", "TZ": "Asia/Tokyo"}
    run = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout == "set()\n"
    assert run.stderr == ""
    for name, draw in FIGURES.items():
        for suffix in (".pdf", ".png"):
            here = tmp_path / f"here{suffix}"
            save_figure(draw(), here)
            assert here.read_bytes() == (tmp_path / f"{name}{suffix}").read_bytes()


def test_fonts_are_embedded_truetype(figure, tmp_path):
    save_figure(figure, tmp_path / "f.pdf")
    pdf = (tmp_path / "f.pdf").read_bytes()
    fonts = re.findall(rb"/FontName /([A-Z]{6}\+)?(\w+)", pdf)
    assert {name.lower() for _, name in fonts} <= {b"cmr10", b"cmmi10", b"cmsy10"}
    assert len(fonts) == pdf.count(b"/FontFile2") > 0
    assert b"/Type3" not in pdf
    assert b"CreationDate" not in pdf


def test_png_has_200_dots_per_inch(figure, tmp_path):
    save_figure(figure, tmp_path / "f.png")
    size = np.frombuffer((tmp_path / "f.png").read_bytes()[16:24], ">u4")
    np.testing.assert_allclose(size, figure.get_size_inches() * 200, atol=1)


def test_other_formats_are_refused(figure, tmp_path):
    with pytest.raises(ValueError, match=r"known: \.pdf, \.png"):
        save_figure(figure, tmp_path / "f.svg")


def test_a_failed_save_leaves_the_old_file_alone(tmp_path):
    target = tmp_path / "f.pdf"
    target.write_text("old")
    figure = new_figure(1, 1)
    figure.text(0, 0, r"$\nonsense$")
    with pytest.raises(ValueError, match="nonsense"):
        save_figure(figure, target)
    assert [p.name for p in tmp_path.iterdir()] == ["f.pdf"]
    assert target.read_text() == "old"


@pytest.mark.parametrize(
    "name", [name for name in FIGURES if name != "gallery"]
)  # which is for the screen
def test_figures_are_drawn_for_the_width_of_the_document(name):
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    assert float(re.search(r"textwidth=(\d+)mm", source)[1]) / 25.4 == pytest.approx(TEXT_WIDTH)
    assert FIGURES[name]().get_figwidth() <= TEXT_WIDTH


# The surface


def test_critical_point_is_marked_where_the_contact_line_turns():
    figure = draw_surface(sloping_surface())
    marker = line(figure, "critical point").get_xydata()
    level = line(figure, "obstacle").get_xydata()
    np.testing.assert_allclose(marker[0], level[0] + 0.7 * (level[-1] - level[0]))
    assert "$x = 0.700$" in [text.get_text() for text in figure.axes[0].texts]


def test_binding_part_is_told_from_the_free_one():
    figure = draw_surface(sloping_surface())
    free = np.isfinite(line(figure, "contact side, free").get_ydata())
    binding = np.isfinite(line(figure, "contact side, binding").get_ydata())
    assert (free ^ binding).all()
    assert free.sum() == np.count_nonzero(np.linspace(0, 1, 65) < 0.7)


def test_an_obstacle_other_than_zero_decides_what_binds():
    surface = sloping_surface()
    surface["contact_obstacle"] = np.full(65, 0.35)
    surface["contact_u"] = np.maximum(surface["contact_u"], 0.35)
    binding = np.isfinite(line(draw_surface(surface), "contact side, binding").get_ydata())
    assert binding.sum() == np.count_nonzero(0.7 - np.linspace(0, 1, 65) <= 0.35)


@pytest.mark.parametrize("points", [[], [(0.3, 0)], [(0.3, 0), (0.7, 0)]])
def test_any_number_of_critical_points(points):
    figure = draw_surface(sloping_surface(points))
    markers = [artist for artist in figure.axes[0].lines if artist.get_marker() == "o"]
    assert len(markers) == len(points)
    assert legend(figure).count("critical point") == bool(points)


@pytest.mark.filterwarnings("error")
def test_a_flat_surface_has_a_box_too(tmp_path):
    surface = sloping_surface(())
    flat = surface | {"u": np.zeros((9, 9)), "contact_u": np.zeros(65)}
    save_figure(draw_surface(flat), tmp_path / "f.png")


def test_surface_names_its_axes():
    texts = {text.get_text() for text in draw_surface(sloping_surface()).axes[0].texts}
    assert {"$x$", "$y$", "$u$"} <= texts


def test_nearer_cells_are_painted_later():
    cells = draw_surface(sloping_surface()).axes[0].collections[-1].get_paths()
    first, last = (cell.vertices[:, 1].mean() for cell in (cells[0], cells[-1]))
    assert len(cells) == 64
    assert first > last


# The convergence plots


def test_convergence_is_labelled():
    figure = FIGURES["convergence"]()
    (axes,) = figure.axes
    assert legend(figure) == ["CF (P1), slope 1.90", "NCF (CR), slope 2.10"]
    assert axes.get_xlabel() == "mesh width $h$"
    assert axes.get_ylabel() == "$L^2$ error"
    ticks = dict(
        zip((t.get_text() for t in axes.get_xticklabels()), axes.get_xticks(), strict=True)
    )
    assert ticks == {f"1/{n}": 1 / n for n in (2, 4, 8, 16, 32, 64)}
    assert axes.get_xlim() == pytest.approx((1e-2, 1))  # as in the paper


@pytest.mark.parametrize(("norm", "order"), [("l2", 2), ("h1", 1), ("h1_semi", 1)])
def test_triangle_has_the_slope_it_says(norm, order):
    (axes,) = draw_convergence(published_errors(), norm).axes
    (left, low), (right, _), (_, high), _ = axes.lines[-1].get_xydata()
    assert log(high / low) / log(right / left) == pytest.approx(order)
    assert [text.get_text() for text in axes.texts] == ["$1$", f"${order}$"]


def test_lines_differ_in_more_than_colour():
    lines = draw_convergence(published_errors(), "h1").axes[0].lines[:2]
    assert len({artist.get_marker() for artist in lines}) == 2
    assert len({artist.get_linestyle() for artist in lines}) == 2


@pytest.mark.parametrize("error", [0.0, None, "", inf])
def test_an_error_that_has_no_logarithm_is_left_out(error, tmp_path):
    errors = published_errors()
    errors[-1]["l2"] = error
    figure = draw_convergence(errors, "l2")
    save_figure(figure, tmp_path / "f.png")
    assert figure.axes[0].get_ylim()[0] > 1e-6


def test_many_levels_keep_the_labels_apart():
    errors = [{"element": "CR", "n": 2**k, "h": 2.0**-k, "l2": 4.0**-k} for k in range(12)]
    labels = [text.get_text() for text in draw_convergence(errors, "l2").axes[0].get_xticklabels()]
    assert len(labels) == 12
    assert sum(map(bool, labels)) <= 7


def test_any_norm_that_is_given():
    errors = [row | {"trace_l2": row["h1"], "l_17": row["h1"]} for row in published_errors()]
    for norm, name in (("trace_l2", r"$L^2(\Gamma_C)$ error of $u$"), ("l_17", "l 17")):
        (axes,) = draw_convergence(errors, norm).axes
        assert axes.get_ylabel() == name
        assert axes.texts[-1].get_text() == "$1$"


def test_mesh_widths_that_are_not_one_over_n_are_named_by_their_value():
    errors = [{"element": "CR", "n": n, "h": 0.37 / n, "l2": n**-2.0} for n in (2, 4, 8)]
    labels = [text.get_text() for text in draw_convergence(errors, "l2").axes[0].get_xticklabels()]
    assert labels == ["0.18", "0.092", "0.046"]


@pytest.mark.parametrize(("norm", "element"), [("l3", "P1"), ("l2", "P2")])
def test_unknown_names_are_refused(norm, element):
    with pytest.raises(ValueError, match="known: "):
        draw_convergence([{"element": element, "n": 2, "h": 0.5, "l2": 1.0}], norm)


# The field


def pixels(figure):
    """The figure as it looks on the screen, shape (rows, columns, 3)."""
    canvas = FigureCanvasAgg(figure)
    with matplotlib.rc_context(STYLE):
        canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3]


def inside(figure):
    """The pixels of the first axes, without a rim."""
    image, box = pixels(figure), figure.axes[0].get_window_extent()
    rows = slice(len(image) - int(box.y1) + 8, len(image) - int(box.y0) - 8)
    return image[rows, int(box.x0) + 8 : int(box.x1) - 8]


def lightness(rgb):
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16  # CIE L*


def test_colours_read_in_grey():
    steps = np.diff(lightness(COLOURS(np.linspace(0, 1, 50))[:, :3]))
    assert (steps < 0).all()
    assert steps.min() / steps.max() < 2
    assert lightness(np.array(COLOURS(1.0)[:3])) > 30  # black lines stand out


@pytest.mark.parametrize("turn", [0.7, 0.76, 0.84])
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_every_point_of_the_domain_has_a_colour(element, turn):
    """Whatever the round numbers of the colour bar leave over."""
    assert not (inside(draw_field(sloping_field(element, turn=turn))) == 255).all(axis=-1).any()


def test_contours_stay_inside_their_triangles():
    """Of a function that is 0 on one triangle and 1 on the other there is nothing to interpolate."""
    field = sloping_field(n=1)
    jump = field | {"values": np.array([[0.0, 1.0]] * 3), "range": np.array([0.0, 1.0])}
    figure = draw_field(jump)
    _, lines = figure.axes[0].collections[:2]
    assert not any(len(path.vertices) for path in lines.get_paths())
    assert len(np.unique(inside(figure).reshape(-1, 3), axis=0)) == 2


@pytest.mark.parametrize("label", ["Dirichlet", "Neumann", "contact", "contact, binding"])
def test_boundary_parts_lie_where_they_should(label):
    points = line(draw_field(sloping_field("CR")), label).get_xydata()
    points = points[np.isfinite(points).all(axis=1)]
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    expected = {"Dirichlet": ([0, 1], [1, 1]), "Neumann": ([0, 0], [1, 1])}
    expected |= {"contact": ([0, 0], [1, 0]), "contact, binding": ([0.75, 0], [1, 0])}
    assert (low, high) == expected[label]


def test_boundary_parts_differ_in_more_than_colour():
    lines = [
        line(draw_field(sloping_field()), name)
        for name in ("Dirichlet", "Neumann", "contact", "contact, binding")
    ]
    assert len({(artist.get_linewidth(), artist.get_linestyle()) for artist in lines}) == 4


def test_critical_points_of_a_field_are_marked():
    figure = draw_field(sloping_field("CR"))
    np.testing.assert_array_equal(line(figure, "critical point").get_xydata(), [[0.75, 0]])
    assert legend(figure) == [
        "Dirichlet",
        "Neumann",
        "contact",
        "contact, binding",
        "critical point",
    ]
    assert "critical point" not in legend(draw_field(sloping_field(turn=2)))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("offset", [0.0, 1e6])
def test_any_size_and_place(scale, offset):
    origin = (scale * offset, -scale * offset)
    figure = draw_field(sloping_field(size=(scale, 2 * scale), origin=origin))
    axes = figure.axes[0]
    image, reference = (
        pixels(figure).astype(int),
        pixels(draw_field(sloping_field(size=(1.0, 2.0)))).astype(int),
    )
    box = np.array(axes.get_window_extent()).ravel()
    x, y = axes.transData.transform([[0, 0], [1, 1]])
    assert (y - x)[0] == pytest.approx((y - x)[1])  # one scale for both axes
    labels = {0.0: ("$x$", "$y$"), 1e6: ("$x - 1000000$", "$y + 1000000$")} if scale == 1 else {}
    if offset in labels:
        assert (axes.get_xlabel(), axes.get_ylabel()) == labels[offset]
    elif scale != 1:
        assert f"[$10^{{{round(np.log10(scale))}}}$]" in axes.get_xlabel()
    assert all(len(text.get_text()) < 8 for text in axes.get_xticklabels() + axes.get_yticklabels())
    middle = [
        slice(len(image) // 2 - 50, len(image) // 2 + 50),
        slice(int(box[0]) + 9, int(box[2]) - 9),
    ]
    assert np.mean(np.any(image[tuple(middle)] != reference[tuple(middle)], axis=-1)) < 0.01


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("height", [0.0, 1e-300, 1e250])
@pytest.mark.parametrize("size", [(1.0, 1.0), (1.0, 1e-6), (1e-3, 1.0)])
def test_any_values_and_shape(height, size):
    field = sloping_field("CR", height=height, size=size)
    figure = draw_field(field, "any")
    pixels(figure)
    assert ("not to scale" in figure.axes[0].get_xlabel()) == (size != (1.0, 1.0))
    pixels(draw_gallery([("any", "", field)]))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("title", ["x_1 < 2 & $", r"$\nonsense$", "{Γ_C} ≤ 10^3 %", "Signorini's"])
def test_titles_are_plain_text(title):
    figure = draw_field(sloping_field(), title)
    pixels(figure)
    assert title in [text.get_text() for text in figure.texts]


# The contact line


def test_contact_line_from_text_and_from_numbers(tmp_path):
    write_csv(tmp_path / "line.csv", sloping_rows())
    for rows, name in ((sloping_rows(), "a.png"), (read_csv(tmp_path / "line.csv"), "b.png")):
        save_figure(draw_contact_line(rows), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_contact_line_shows_the_finest_level():
    figure = draw_contact_line([*sloping_rows(n=16), *sloping_rows(n=8)])
    assert legend(figure) == [
        "CF (P1), $n = 16$",
        "NCF (CR), $n = 16$",
        "obstacle",
        "critical point",
    ]
    upper, lower = figure.axes
    for axes, column in ((upper, "u"), (lower, "flux")):
        x, y = next(artist for artist in axes.lines if len(artist.get_xdata()) == 17).get_data()
        rows = [row for row in sloping_rows(n=16) if row["element"] == "P1"]
        np.testing.assert_allclose(x, [row["s"] for row in rows])
        np.testing.assert_allclose(y, [row[column] for row in rows], atol=1e-15)


def test_critical_points_of_the_contact_line_are_marked_in_both_panels():
    for axes in draw_contact_line(sloping_rows()).axes:
        upright = [
            artist.get_xdata()[0] for artist in axes.lines if len(set(artist.get_xdata())) == 1
        ]
        assert sorted({0.6875, 0.75} & set(upright)) == [0.6875, 0.75]


def test_components_are_drawn_apart():
    rows = sloping_rows(labels=("contact", "neumann", "contact", "neumann"))
    curve = draw_contact_line(rows).axes[0].lines[0]
    assert np.flatnonzero(np.isnan(curve.get_xdata())).tolist() == [9]
    assert len(curve.get_xdata()) == 19


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", [1e-9, 1e9])
def test_contact_line_of_any_size(scale):
    rows = sloping_rows(size=(scale, scale), height=1e-200)
    figure = draw_contact_line(rows)
    pixels(figure)
    assert f"[$10^{{{round(np.log10(scale))}}}$]" in figure.axes[1].get_xlabel()
    assert "[$10^{-201}$]" in figure.axes[0].get_title(loc="left")


@pytest.mark.filterwarnings("error")
def test_contact_line_without_force():
    pixels(draw_contact_line(sloping_rows(turn=2)))


def test_contact_line_that_cannot_be_drawn_is_refused():
    with pytest.raises(ValueError, match="no rows"):
        draw_contact_line([])
    with pytest.raises(ValueError, match="known: P1, CR"):
        draw_contact_line([row | {"element": "P2"} for row in sloping_rows()])


# The gallery


@pytest.mark.parametrize("count", [1, 4, 5, 9])
def test_gallery_has_four_in_a_row(count):
    scenes = [
        (f"scene-{k}", "a title that is far too long for its cell " * 4, sloping_field(n=2))
        for k in range(count)
    ]
    figure = draw_gallery(scenes)
    domains = [axes.get_position() for axes in figure.axes[:count]]
    assert len({round(box.x0, 6) for box in domains}) == min(count, 4)
    assert len({round(box.y0, 6) for box in domains}) == -(-count // 4)
    assert min(box.y0 for box in domains) > 0
    assert {name for name, *_ in scenes} <= {text.get_text() for text in figure.texts}
    assert max(text.get_text().count("\n") for text in figure.texts) == 1


def test_gallery_says_what_range_u_has():
    field = sloping_field(height=1e-9)
    assert "$0 \\leq u \\leq 700$  [$10^{-12}$]" in {
        text.get_text() for text in draw_gallery([("a", "", field)]).texts
    }


def test_an_empty_gallery_is_refused():
    with pytest.raises(ValueError, match="no scenes"):
        draw_gallery([])
