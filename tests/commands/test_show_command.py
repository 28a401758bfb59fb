"""`signorini show`: several files, one after the other."""

import json

import pytest

from signorini.commands.program import main
from signorini.storage import write_csv


@pytest.fixture
def tables(tmp_path):
    """Two tables of one row."""
    for name in ("a", "b"):
        write_csv(tmp_path / f"{name}.csv", [{"n": 2, "table": name}])
    return [str(tmp_path / f"{name}.csv") for name in ("a", "b")]


def test_several_files_are_told_each_below_its_name(tables, capsys):
    assert main(["show", *tables]) == 0
    first, second = capsys.readouterr().out.rstrip().split("\n\n")
    assert first.splitlines()[0] == f"{tables[0]}:"
    assert second.splitlines()[0] == f"{tables[1]}:"
    assert second.split()[-2:] == ["2", "b"]


def test_data_of_several_files_are_told_by_name_and_of_one_alone(tables, capsys):
    assert main(["show", *tables, "--json"]) == 0
    both = json.loads(capsys.readouterr().out)
    assert main(["show", tables[0], "--json"]) == 0
    assert list(both) == tables
    assert both[tables[0]] == json.loads(capsys.readouterr().out)
