"""Every job that reads a damaged file says so and stops; so does a number that is not met."""

import os

import pytest
from damage import ASKED, accepted, another_digit, cut, flip, without_last_row
from project import LATEX


@pytest.mark.parametrize(
    ("damage", "damaged", "consumed_by"),
    [
        (cut, "solutions/P1/n2.npz", "errors.csv"),
        (flip, "reference.npz", "errors.csv"),
        (cut, "errors.csv", "rates.csv"),
        (without_last_row, "errors.csv", "table.md"),
    ],
)
def test_a_damaged_file_is_noticed_by_its_reader(small, built_small, damage, damaged, consumed_by):
    path, output = (small / "results/small" / name for name in (damaged, consumed_by))
    before = path.stat()
    path.write_bytes(damage(path.read_bytes()))
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))  # Snakemake sees nothing
    output.unlink()
    run = small.run(f"results/small/{consumed_by}")
    assert run.code != 0
    assert 1 <= len(run.errors) <= 2
    assert f"results/small/{damaged}: " in run.errors[0]
    assert "delete it and rerun" in run.errors[0]
    assert "Traceback" not in run.text
    assert not output.exists()
    path.unlink()
    small.build(f"results/small/{consumed_by}")
    assert small.results() == built_small.results()


def test_every_reader_refuses_a_changed_digit(small):
    assert accepted(small, another_digit, lambda path: True) == []


@pytest.fixture
def macros(paper):
    """The paper's scene with all numbers of its text, which need no LaTeX."""
    paper.build("results/paper/macros.tex")
    return paper, (
        "results/paper/macros.tex",
        "results/paper/check.txt",
        *(["all"] if LATEX else []),
    )


def test_every_reader_of_the_paper_refuses_a_changed_digit(macros):
    project, targets = macros
    assert accepted(project, another_digit, lambda path: path.suffix != ".npz", *targets) == []


def test_every_reader_asks_for_the_rows_of_the_scene(macros):
    """Of a table that is whole, but of another question."""
    project, targets = macros
    assert (
        accepted(project, without_last_row, lambda path: path.name in ASKED, *targets, sealed=True)
        == []
    )


def test_a_published_number_that_is_not_met_stops_the_build(paper):
    paper.edit("config/published/table_5_1.csv", "0.10075495", "0.10075505")
    (paper / "results/paper/paper.pdf").unlink(missing_ok=True)
    run = paper.run()
    assert run.code != 0
    assert "l2 P1 n=2: published 0.10075505, computed 0.1007549" in run.errors[0]
    assert "-9.6" in run.errors[0]
    assert "units off" in run.errors[0]
    assert ",0\n" in (paper / "results/paper/check.csv").read_text()
    assert not (paper / "results/paper/check.txt").exists()
    assert not (paper / "results/paper/paper.pdf").exists()
