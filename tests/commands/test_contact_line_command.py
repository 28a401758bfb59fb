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
