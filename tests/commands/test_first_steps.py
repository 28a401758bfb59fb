"""What somebody types who does not know the program yet: what is missing is told, by example."""

import json

import pytest

from signorini.commands.program import MISTAKE, main

SMOOTH = "config/scenes/smooth.yaml"
WITHOUT_ARGUMENTS = ["rates", "viewer", "vtu", "benchmark point", "contact-line", "table"]


def shown(capsys, *words):
    assert main(list(words)) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("command", ["solve", "benchmark point"])
def test_help_of_a_command_is_asked_for_before_or_after_its_name(command, capsys):
    told = []
    for words in (["help", *command.split()], [*command.split(), "--help"]):
        with pytest.raises(SystemExit) as ended:
            main(words)
        assert ended.value.code == 0
        told.append(capsys.readouterr().out)
    assert told[0] == told[1]
    assert told[0].startswith(f"usage: signorini {command} ")


@pytest.mark.parametrize("command", WITHOUT_ARGUMENTS)
def test_what_is_missing_is_told_with_an_example(command, capsys):
    with pytest.raises(SystemExit) as ended:
        main(command.split())
    told = capsys.readouterr().err
    assert ended.value.code == MISTAKE
    assert f"; for instance signorini {command} " in told
    assert told.count("\n") == 1
    assert "\\" not in told


def test_the_outcome_names_the_file(tmp_path, capsys):
    path = str(tmp_path / "u.npz")
    told = shown(capsys, "solve", SMOOTH, "--element", "CR", "--n", "4", "-o", path)
    assert f"; in {path} (" in told
    assert "; in " not in shown(capsys, "solve", SMOOTH, "--element", "CR", "--n", "4")


def test_errors_are_shown_with_their_slopes(capsys):
    last = shown(capsys, "errors", SMOOTH, "--norms", "l2", "h1").splitlines()[-2:]
    for element, line in zip(("P1", "CR"), last, strict=True):
        name, word, l2, h1 = line.split()
        assert (name, word) == (element, "slope")
        assert float(l2) == pytest.approx(2.0, abs=0.1)
        assert float(h1) == pytest.approx(1.0, abs=0.1)


def test_a_slope_that_means_nothing_has_a_star(capsys):
    last = shown(capsys, "errors", "config/scenes/patch.yaml", "--norms", "l2").splitlines()[-1]
    assert last.split()[-1].endswith("*")


def test_the_data_of_errors_have_no_slopes(capsys):
    rows = json.loads(shown(capsys, "errors", SMOOTH, "--norms", "l2", "--json"))
    assert [row["n"] for row in rows] == 2 * [8, 16, 32, 64]
