"""The commands certificate, certificates and certify."""

import json
import re
from pathlib import Path

import pytest

from signorini.commands.program import main
from signorini.storage import read_csv

ROOT = Path(__file__).parents[2]
CORNER, SHAPE = (str(ROOT / f"config/scenes/{name}.yaml") for name in ("corner", "l-shape"))


def call(capsys, *words):
    code = main([str(word) for word in words])
    told = capsys.readouterr()
    return code, told.out, told.err


def test_a_level_is_certified_and_gathered(capsys, tmp_path):
    for n in (4, 8):
        code, out, _ = call(capsys, "certificate", CORNER, "--n", n, "-o", tmp_path / f"n{n}.npz")
        assert code == 0
        assert re.search(rf"CR n = {n}: the energy error lies in \[0\.\d+, 0\.\d+\]", out)
    files = [tmp_path / f"n{n}.npz" for n in (8, 4)]
    written = [f"--{kind}={tmp_path / f'c.{kind}'}" for kind in ("tex", "markdown")]
    code, _, _ = call(capsys, "certificates", CORNER, *files, "-o", tmp_path / "c.csv", *written)
    assert code == 0
    rows = read_csv(tmp_path / "c.csv", numbers=["lower", "error", "upper"])
    assert [(row["element"], row["n"]) for row in rows] == [
        ("P1", "4"),
        ("P1", "8"),
        ("CR", "4"),
        ("CR", "8"),
    ]
    assert all(row["lower"] <= row["error"] <= row["upper"] for row in rows)
    assert r"\toprule" in (tmp_path / "c.tex").read_text()
    assert "| 4 |" in (tmp_path / "c.markdown").read_text()


def test_the_same_level_gives_the_same_bytes(capsys, tmp_path):
    for name in ("one", "other"):
        call(capsys, "certificate", SHAPE, "--n", 4, "-o", tmp_path / f"{name}.npz")
    assert (tmp_path / "one.npz").read_bytes() == (tmp_path / "other.npz").read_bytes()


def test_certify_goes_as_far_as_it_must(capsys):
    code, out, _ = call(capsys, "certify", CORNER, "--bound", "0.05", "--json")
    assert code == 0
    rows = json.loads(out)
    bounds = {(row["element"], row["n"]): row["upper"] for row in rows}
    assert max(n for _, n in bounds) == 16
    assert max(bounds["P1", 16], bounds["CR", 16]) <= 0.05 < min(bounds["P1", 8], bounds["CR", 8])
    assert all(row["seconds"] > 0.0 for row in rows)


def test_certify_one_element_at_one_level(capsys):
    code, out, _ = call(capsys, "certify", CORNER, "--element", "CR", "--n", "8")
    assert code == 0
    assert re.match(r"n = 8: energy error of CR in \[.*\] with 376 dofs; ", out)
    assert "P1" not in out


def test_certify_says_why_it_cannot(capsys, monkeypatch):
    """Where a level fits in no memory."""
    from signorini import memory

    monkeypatch.setattr(memory, "_memory", lambda: 1e6)
    code, _, err = call(capsys, "certify", SHAPE, "--bound", "1e-3")
    assert code == 1
    assert re.search(
        r"--bound 0.001: the bound of \w+ is 0\.\d+ at n = \d+ "
        r"and would be there at about n = \d+; .* needs at least .* GB of memory",
        err,
    )


@pytest.mark.parametrize("option", ["--bound", "--to"])
@pytest.mark.parametrize("goal", ["0", "-1", "nan"])
def test_a_goal_is_positive(capsys, goal, option):
    """By its name of before, too."""
    code, _, err = call(capsys, "certify", CORNER, f"{option}={goal}")
    assert code == 1
    assert f"--bound {float(goal):g}: a bound is positive" in err
