"""The stability suite as files: others can read them, and are judged as the study judges."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from signorini.commands.program import main
from signorini.exceptions import StorageError
from signorini.generated.problems import instance
from signorini.judge.pairs import residual
from signorini.storage import read_csv, read_npz, write_npz
from signorini.studies.stability.exchange import KIND, export, keys, name_of, read_problem
from signorini.studies.stability.load_problem import load_problem, save_answer
from signorini.studies.stability.score import profiles, ranking, score

ROOT = Path(__file__).parents[2]
EXAMPLE, PAGE = ROOT / "examples/add_your_solver.py", ROOT / "docs/add-your-solver.md"
FAMILIES = ("delaunay", "inclusions")


@pytest.fixture(scope="module")
def suite(tmp_path_factory):
    folder = tmp_path_factory.mktemp("suite")
    export(folder, keys([0], FAMILIES))
    return folder


def problems(suite):
    return [load_problem(path) for path in sorted(suite.glob("problems/*.npz"))]


def test_the_index_lists_the_files(suite):
    rows = read_csv(suite / "index.csv", numbers=["unknowns", "condition"])
    names = {name_of(*key) for key in keys([0], FAMILIES)}
    assert {row["name"] for row in rows} == names == {p["name"] for p in problems(suite)}
    sizes = {p["name"]: p["b"].size for p in problems(suite)}
    assert all(row["unknowns"] == sizes[row["name"]] for row in rows)
    assert min(row["condition"] for row in rows) >= 1.0


def test_what_is_read_is_what_was_generated(suite):
    for path in suite.glob("problems/*.npz"):
        key, _ = read_problem(path)
        made, read = instance(*key).problem, load_problem(path)
        assert (read["A"] != made.A).nnz == 0
        np.testing.assert_array_equal(made.b, read["b"])
        np.testing.assert_array_equal(made.free, read["free"])


def test_the_files_hold_their_solutions(suite):
    for p in problems(suite):
        high, low = residual(p["A"], p["u"], p["u_low"], p["b"])
        off = np.setdiff1d(p["free"], p["contact"])
        terms = abs(p["A"]) @ np.abs(p["u"]) + np.abs(p["b"])
        assert np.all(np.abs(high + low)[off] <= 1e-28 * terms[off])
        gap = (p["u"][p["contact"]] - p["lower"]) + p["u_low"][p["contact"]]
        assert not np.any(gap[p["active"]])
        assert not np.any(p["multiplier"][~p["active"]])
        assert p["multiplier"].min() >= 0.0


def test_the_same_bytes_again(suite, tmp_path):
    export(tmp_path, keys([0], FAMILIES[:1]))
    for path in tmp_path.glob("problems/*"):
        assert path.read_bytes() == (suite / "problems" / path.name).read_bytes()


def test_the_loader_and_the_example_need_no_signorini(suite, tmp_path):
    program = (
        "import runpy, sys; sys.modules['signorini'] = None;"
        f"runpy.run_path({str(EXAMPLE)!r})['main']({str(suite)!r}, {str(tmp_path / 'mine')!r})"
    )
    subprocess.run([sys.executable, "-I", "-c", program], check=True)
    rows = score(suite, tmp_path / "mine")
    ordinary = [row for row in rows if row["load"] in ("white", "smooth")]
    assert all(row["claimed"] and row["residual"] <= 1e-9 for row in ordinary)
    assert all(row["accurate"] for row in ordinary)


def test_the_page_is_followed_word_by_word(tmp_path, monkeypatch):
    commands = re.findall(r"^   ((?:signorini|python) .*)$", PAGE.read_text(encoding="utf-8"), re.M)
    assert len(commands) == 3
    monkeypatch.chdir(tmp_path)
    for command in commands:
        words = command.replace("--small", "--small --families rising").split()
        words = [str(EXAMPLE) if word.endswith(EXAMPLE.name) else word for word in words]
        start = [] if words[0] == "python" else ["-m", "signorini"]
        subprocess.run([sys.executable, *start, *words[1:]], check=True)
    rows = read_csv("scores.csv", numbers=["residual"])
    assert all(row["residual"] <= 1e-9 for row in rows if row["load"] in ("white", "smooth"))


def test_a_loader_of_twenty_lines(suite):
    text = (suite / "load_problem.py").read_text(encoding="utf-8")
    code = text.split('"""', 2)[2].splitlines()
    assert sum(bool(line.strip()) for line in code) <= 20


def answered(suite, folder, change=0.0, claimed=True):
    for p in problems(suite):
        u = p["u"].copy()
        u[p["free"][0]] += change * p["variation"]
        save_answer(folder, p, u, claimed)
    return score(suite, folder)


def test_a_wrong_answer_is_wrong_and_ranks_below_a_right_one(suite, tmp_path):
    right = answered(suite, tmp_path / "right")
    wrong = answered(suite, tmp_path / "wrong", change=1.0)
    silent = answered(suite, tmp_path / "silent", claimed=False)
    first, *others = ranking([*wrong, *silent, *right], time_limit=1.0)
    assert first["solver"] == "right"
    assert first["accurate"] == 1.0
    counts = {row["solver"]: row for row in others}
    assert counts["wrong"]["wrong"] == len(wrong)
    assert counts["wrong"]["accurate"] == 0.0
    assert counts["silent"]["solved_1e-09"] == counts["silent"]["wrong"] == 0
    assert counts["silent"]["unclaimed"] > 0


def test_a_profile_ends_at_the_share_that_the_ranking_tells(suite, tmp_path):
    for name, change, seconds in (("right", 0.0, 2.0), ("wrong", 1.0, 1.0)):
        for p in problems(suite):
            u = p["u"].copy()
            u[p["free"][0]] += change * p["variation"]
            save_answer(tmp_path / name, p, u, True, seconds)
    rows = [row for name in ("right", "wrong") for row in score(suite, tmp_path / name)]
    found = profiles(rows)
    for row in ranking(rows, time_limit=1.0):
        assert found[row["solver"]][1][-1] == row["solved_1e-09"]
    assert found["right"][1][0] > found["wrong"][1][-1] == 0.0


def test_no_answer_is_no_claim(suite, tmp_path):
    rows = score(suite, tmp_path)
    assert len(rows) == 28
    assert not any(row["claimed"] or row["accurate"] for row in rows)


def test_a_vector_of_another_length_is_refused(suite, tmp_path):
    save_answer(tmp_path, problems(suite)[0], np.zeros(3), True)
    with pytest.raises(StorageError, match=r"u has shape \(3,\); give one of"):
        score(suite, tmp_path)


def test_an_altered_problem_is_refused(suite, tmp_path):
    path = next(suite.glob("problems/*.npz"))
    arrays = read_npz(path, KIND)
    write_npz(tmp_path / "altered.npz", KIND, **arrays | {"b": arrays["b"] + 1.0})
    with pytest.raises(StorageError, match="this version makes another problem"):
        read_problem(tmp_path / "altered.npz")


def test_the_commands_write_and_tell(tmp_path, capsys):
    folder = str(tmp_path / "suite")
    main(["suite", "export", "--small", "--families", "rising", "-o", folder])
    main(["suite", "score", folder, str(tmp_path), "-o", str(tmp_path / "scores.csv")])
    assert "14 problems, 0.0% solved to 1e-9" in capsys.readouterr().out
    assert len(read_csv(tmp_path / "scores.csv")) == 14
