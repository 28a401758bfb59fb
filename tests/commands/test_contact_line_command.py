"""The table of the contact part: with a scene whose truth is exact it has that, too."""

import pytest

from signorini.commands.program import main
from signorini.storage import read_csv

PATCH, PAPER = (f"config/scenes/{name}.yaml" for name in ("patch", "paper"))


def tabulated(folder, scene, *options):
    mesh, solution, table = (str(folder / name) for name in ("mesh.npz", "cr.npz", "line.csv"))
    assert main(["mesh", scene, "-o", mesh]) == 0
    assert main(["solve", scene, "--element", "CR", "--n", "4", "-o", solution]) == 0
    assert main(["contact-line", mesh, solution, *options, "-o", table]) == 0
    return read_csv(table)


def test_the_exact_solution_of_the_patch_test_is_1_on_its_contact_side(tmp_path):
    rows = tabulated(tmp_path, PATCH, "--scene", PATCH)
    assert [float(row["exact"]) for row in rows] == [1.0] * 4
    assert [float(row["u"]) for row in rows] == pytest.approx([1.0] * 4, rel=1e-14)


def test_a_reference_is_no_exact_solution(tmp_path):
    assert "exact" not in tabulated(tmp_path, PAPER, "--scene", PAPER)[0]
    assert "exact" not in tabulated(tmp_path, PATCH)[0]


def test_the_true_contact_force_of_the_patch_test_is_1_over_its_contact_side(tmp_path):
    rows = tabulated(tmp_path, PATCH, "--scene", PATCH)
    assert {row["true_resultant"] for row in rows} == {"1.0"}
    assert float(rows[0]["resultant"]) == pytest.approx(1.0, rel=1e-14)


def test_a_finer_solution_is_told_at_the_places_of_the_coarser(tmp_path):
    reference = str(tmp_path / "reference.npz")
    assert main(["solve", PAPER, "--element", "P1", "--n", "8", "-o", reference]) == 0
    rows = tabulated(tmp_path, PAPER, "--reference", reference)
    finer = str(tmp_path / "finer.csv")
    assert main(["contact-line", str(tmp_path / "mesh.npz"), reference, "-o", finer]) == 0
    there = {row["s"]: row for row in read_csv(finer)}
    assert [row["s"] for row in rows] == ["0.125", "0.375", "0.625", "0.875"]
    assert [row["reference"] for row in rows] == [there[row["s"]]["u"] for row in rows]
    assert {row["true_resultant"] for row in rows} == {row["resultant"] for row in there.values()}


def test_where_the_reference_has_no_place_there_is_no_value(tmp_path):
    reference = str(tmp_path / "reference.npz")
    assert main(["solve", PAPER, "--element", "P1", "--n", "4", "-o", reference]) == 0
    rows = tabulated(tmp_path, PAPER, "--reference", reference)
    assert [row["reference"] for row in rows] == [""] * 4
