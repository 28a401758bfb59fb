"""Multigrid only as far as it pays: its error is that of the discretisation, its work is less."""

import pytest

import signorini
from builders import statement
from signorini.errors.exact import ExactErrors
from signorini.studies.benchmark.accuracy import as_far_as_it_pays, finest
from signorini.studies.benchmark.point import measure
from signorini.studies.benchmark.routes import ROUGH, ROUTES, best, in_full, rough_only
from signorini.studies.benchmark.summary import fastest, reach

ONCE = {"least": 1, "most": 1, "seconds": 0.0}


@pytest.mark.parametrize("element", ["P1", "CR"])
@pytest.mark.parametrize("scene", ["corner", "punch", "smooth"])
def test_the_error_is_that_of_the_discretisation_for_less_work(scene, element):
    asked = signorini.load_scene(f"config/scenes/{scene}.yaml").problem_statement
    mesh, norms = asked.triangulations.level(32), ExactErrors(asked.exact, ["h1"])
    rows, errors = {}, {}
    for route in ("multigrid", ROUGH):
        rows[route], u = measure(asked, element, 32, route, ONCE, 8)
        errors[route] = norms.of(mesh, element, u)["h1"]
    assert errors[ROUGH] == pytest.approx(errors["multigrid"], rel=0.02)
    assert errors[ROUGH] != errors["multigrid"]
    assert rows[ROUGH]["note"] == ""
    assert rows[ROUGH]["cycles"] < rows["multigrid"]["cycles"] / 3
    assert rows[ROUGH]["products"] < rows["multigrid"]["products"] / 2


def test_without_a_coarser_level_the_row_says_what_the_library_says():
    row, _ = measure(statement(f="2*pi*sin(2*pi*x)"), "CR", 2, ROUGH, ONCE, 2)
    assert row["status"] == "measured"
    assert "discretisation error cannot be told" in row["note"]
    assert row["residual"] < 1e-14


def test_routes_in_full_have_no_note():
    for route in set(ROUTES) - {ROUGH}:
        assert measure(statement(f="2*pi*sin(2*pi*x)"), "P1", 4, route, ONCE, 4)[0]["note"] == ""


def point(route, n=8, total=1.0, note="", h1=0.1):
    times = {"total": total, "total_min": 0.9 * total, "total_max": 1.1 * total}
    costs = times | {"solve": 0.5 * total, "cycles": 4, "products": 8, "dofs": n * n, "memory": 1e6}
    key = {"scene": "s", "element": "P1", "method": route, "n": n, "status": "measured"}
    return key | costs | {"note": note, "l2": h1**2, "h1": h1}


def compared(*points):
    (row,) = as_far_as_it_pays(points)
    return row


def test_it_is_held_against_multigrid_in_full_and_the_fastest_route():
    points = point("multigrid", total=8.0), point("direct", total=3.0), point(ROUGH, h1=0.101)
    row = compared(*points)
    assert (row["less"], row["solve_less"], row["sooner"]) == (8.0, 8.0, 3.0)
    assert (row["fastest"], row["pays"]) == ("direct", 1)
    assert row["more_h1"] == pytest.approx(1.01)
    assert row["more_l2"] == pytest.approx(1.01**2)


@pytest.mark.parametrize(("total", "pays"), [(0.5, -1), (1.0, 0), (2.0, 1)])
def test_it_pays_where_the_ranges_of_the_times_say_so(total, pays):
    points = point("multigrid", total=9.0), point("fourier", total=total), point(ROUGH)
    assert compared(*points)["pays"] == pays


def test_levels_in_full_after_all_do_not_count():
    points = [point("multigrid"), point(ROUGH, note="its discretisation error cannot be told")]
    assert as_far_as_it_pays(points) == []
    assert as_far_as_it_pays([point("direct"), point(ROUGH)]) == []


def test_the_finest_level_with_an_error_is_shown():
    points = [point(route, n) for n in (8, 16) for route in ("multigrid", ROUGH)]
    points += [point(route, 32, h1=0.0) for route in ("multigrid", ROUGH)]
    assert [row["n"] for row in finest(as_far_as_it_pays(points))] == [16]


def test_only_proved_solutions_are_the_fastest():
    points = [point(ROUGH, n, 0.1, h1=1 / n) for n in (4, 16)]
    points += [point("multigrid", n, h1=1 / n) for n in (4, 16)]
    assert fastest(reach(points, [0.1]))["s", "h1", 0.1]["P1"]["method"] == "multigrid"


def test_the_best_route_is_the_fastest_of_the_finest_level():
    curves = {
        ("s", "P1", "direct"): [point("direct", 8, 0.1), point("direct", 16, 3.0)],
        ("s", "P1", "fourier"): [point("fourier", 8, 0.2), point("fourier", 16, 2.0)],
        ("s", "P1", "multigrid"): [point("multigrid", 8, 0.01)],
        ("s", "P1", ROUGH): [point(ROUGH, 16, 0.5)],
    }
    assert list(best(curves)) == [("s", "P1", "fourier")]
    assert in_full(curves).keys() | rough_only(curves).keys() == curves.keys()
