"""Data without a value: refused by `signorini check`, by name, value, point and remedy."""

import pytest

from scene_texts import VALID
from signorini.commands.program import main
from signorini.exceptions import FormulaError
from signorini.scene.read import load_scene
from signorini.scene.values_check import check_values

FIELDS = ("f", "g", "dirichlet", "obstacle", "coefficient", "contact_flux")
# Formula -> its value where it has none; bare numbers and the roots of negative ones.
FAULTS = {
    "sqrt(-1 - x**2)": "nan",
    "where(x > 0.4, log(-y - 1), 1)": "nan",
    "1 + asin(2 + x)": "nan",
    "1/(x - x)": "inf",
    "1 - exp(1000 + x)": "-inf",
    "log(x - x)": "-inf",
    "2**(2000*x + 1000*(1 - x)*2)": "inf",
}
REMEDY = "leave the point out with where(condition, a, b)"


def scene_text(**data):
    """The valid scene with other data."""
    told = {"f": "1", "obstacle": "-9"} | data
    rows = "".join(f'  {name}: "{text}"\n' for name, text in told.items())
    return VALID.replace("data: {f: 2*pi*sin(2*pi*x), obstacle: 0}\n", f"data:\n{rows}")


@pytest.fixture
def check(load):
    return lambda text: load(text, lambda path: check_values(load_scene(path)))


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("formula", FAULTS)
def test_a_datum_without_a_value_is_refused(check, field, formula):
    with pytest.raises(FormulaError) as refused:
        check(scene_text(**{field: formula}))
    told = str(refused.value)
    assert told.startswith(f"data.{field}: value is {FAULTS[formula]} at (x, y) = (")
    assert told.endswith(REMEDY)


@pytest.mark.parametrize("field", FIELDS)
def test_what_has_no_value_only_where_it_is_not_used_is_taken(check, field):
    """The branch that is not taken, and, of data on the boundary, all other places."""
    check(scene_text(**{field: "where(x >= 0, 1 - x/9, sqrt(-1))"}))
    if field in ("g", "dirichlet", "obstacle", "contact_flux"):
        elsewhere = "where(x*y*(1 - x)*(1 - y) > 0.01, sqrt(-1), 0)"
        check(scene_text(**{field: elsewhere}))


@pytest.mark.parametrize("levels", ["[4096, 8192]", "[5555]"])
def test_fine_levels_are_looked_at_on_coarser_grids(check, levels):
    """Within the time of this test and the memory of any machine."""
    text = scene_text(f="sqrt(-1 - x)").replace("[2, 4, 8]", levels)
    with pytest.raises(FormulaError, match=r"data\.f: value is nan"):
        check(text.replace("{kind: reference, element: P1, n: 32}", "{kind: none}"))


def test_the_command_tells_it_in_one_line(tmp_path, capsys):
    path = tmp_path / "faulty.yaml"
    path.write_text(scene_text(g="where(y > 0.5, sqrt(-y), 0)"))
    assert main(["check", str(path)]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert f"{path}: data.g: value is nan at (x, y) = (" in err


def test_data_derived_from_a_truth_are_looked_at(check):
    """Dirichlet values of a u that is real on one side of a line alone."""
    truth = '{kind: exact, u: "sqrt(x - 1/3)"}'
    text = VALID.replace("{kind: reference, element: P1, n: 32}", truth)
    with pytest.raises(FormulaError, match="is nan at"):
        check(text.replace("data: {f: 2*pi*sin(2*pi*x), obstacle: 0}\n", "data: {}\n"))
