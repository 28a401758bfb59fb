"""The table of a sweep in LaTeX: a row for each point, whatever its values and names are."""

import pytest

from signorini.sweeps.latex import sweep_table

ROW = {"point": "f=1", "data.f": "1", "element": "CR", "n": "4", "failed": ""}


def cells(section, rows, norms=()):
    text = sweep_table(section, rows, norms, str)
    body = text.partition("\\midrule\n")[2].partition("\\bottomrule")[0]
    return [line.removesuffix(r" \\").split(" & ") for line in body.splitlines()], text


def test_the_finest_level_of_each_point_is_shown():
    coarse, fine = ROW | {"resultant": "0.5"}, ROW | {"n": "16", "resultant": "0.25"}
    assert cells({"data.f": [1]}, [coarse, fine])[0] == [["1", "0.2500"]]


def test_elements_stand_beside_each_other_and_a_failed_point_has_dashes():
    rows = [ROW | {"resultant": "0.5"}, ROW | {"element": "P1", "resultant": "0.75"}]
    rows.append({"point": "f=2", "data.f": "2", "failed": "unbounded"})
    found, text = cells({"data.f": [1, 2]}, rows)
    assert found == [["1", "0.5000", "0.7500"], ["2", "--", "--"]]
    assert r"\multicolumn{2}{c}{contact force in all}" in text


@pytest.mark.parametrize(
    ("values", "shown"),
    [
        (["0.00123456", "2.5"], ["0.001235", "2.500000"]),
        (["-0.5", "12"], ["$-0.5000$", "12.0000"]),
        (["0", "250"], ["0.0", "250.0"]),
        (["1e-9", "1"], [r"$1.000\times10^{-9}$", r"$1.000\times10^{0}$"]),
    ],
)
def test_the_smallest_number_of_a_column_has_four_digits(values, shown):
    rows = [ROW | {"point": value, "l2": value} for value in values]
    assert [line[1] for line in cells({"data.f": [1]}, rows, ["l2"])[0]] == shown


def test_keys_names_and_values_are_what_latex_can_set():
    section = {"truth.parameters.half_width": [-0.5], "domain.diagonal": ["a_b"]}
    row = ROW | {"truth.parameters.half_width": "-0.5", "domain.diagonal": "a_b"}
    found, text = cells(section, [row | {"quantity.pull_up": "1"}])
    assert found == [["$-0.5$", r"a\_b", "1.000"]]
    assert r"half\_width & diagonal & \multicolumn{1}{c}{CR}" in text
    assert r"\multicolumn{1}{c}{pull\_up}" in text
