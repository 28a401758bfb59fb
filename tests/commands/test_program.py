"""The program `signorini`: its commands, its help, its exit codes, and its one-line errors."""

import importlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from signorini.commands.catalogue import commands, module_of
from signorini.commands.program import INTERRUPTED, MISTAKE, main

ROOT = Path(__file__).parents[2]
COMMANDS = sorted(commands())
SMOOTH, PAPER = (ROOT / f"config/scenes/{name}.yaml" for name in ("smooth", "paper"))
SMALL = """\
domain: {kind: rectangle}
boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}
data: {f: 2*pi*sin(2*pi*x)}
levels: [2, 4]
truth: {kind: reference, n: 16}
norms: [l2, h1]
"""


@pytest.fixture
def small(tmp_path):
    path = tmp_path / "small.yaml"
    path.write_text(SMALL, encoding="utf-8")
    return path


def call(capsys, *words):
    """Exit code and what the program wrote: on standard output, and on standard error."""
    code = main([str(word) for word in words])
    told = capsys.readouterr()
    return code, told.out, told.err


def test_without_a_command_it_lists_them_all(capsys):
    code, out, _ = call(capsys)
    assert code == MISTAKE
    assert call(capsys, "--help") == (0, out, "")
    for command, what in commands().items():
        assert re.search(rf"^  {command} +{re.escape(what)}$", out, re.M)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself_with_an_example(command, capsys):
    with pytest.raises(SystemExit) as ended:
        main([*command.split(), "--help"])
    out = capsys.readouterr().out
    assert ended.value.code == 0
    assert f"usage: signorini {command}" in out
    assert f"example:\n  signorini {command}" in out


@pytest.mark.parametrize("command", COMMANDS)
def test_the_example_of_a_command_is_one_that_it_takes(command):
    """Its files are not there; that its words and options are known is what is tried."""
    from signorini.commands.program import _parser

    module = importlib.import_module(module_of(command))
    example = module.__doc__.partition("example:\n")[2].replace("\\\n", " ")
    for line in filter(str.strip, example.splitlines()):
        words = line.split()[1:]
        assert " ".join(words).startswith(command)
        _parser(command, module).parse_intermixed_args(words[len(command.split()) :])


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_imports_nothing_heavy_before_it_is_called(command):
    text = Path(importlib.import_module(module_of(command)).__file__).read_text(encoding="utf-8")
    assert not re.search(r"^(import|from) (numpy|scipy|matplotlib|pandas)", text, re.M)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["slove"], "signorini slove: no such command; did you mean solve? known: "),
        (["benchmark", "piont"], "did you mean benchmark point? known: "),
    ],
)
def test_an_unknown_command_is_a_mistake_that_names_the_nearest(words, said, capsys):
    code, out, err = call(capsys, *words)
    assert (code, out) == (MISTAKE, "")
    assert said in err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["solve", "s.yaml", "--element", "P2"], "solve: argument --element: invalid choice: 'P2'"),
        (["adapt", "s.yaml", "-o", "a", "--bound", "x"], "--bound: invalid float value: 'x'"),
        (["adapt", "s.yaml"], "the following arguments are required: -o/--output"),
        (["check", "s.yaml", "--jsn"], "unrecognized arguments: --jsn"),
    ],
)
def test_a_wrong_argument_is_told_in_one_line(words, said, capsys):
    with pytest.raises(SystemExit) as ended:
        main(words)
    told = capsys.readouterr().err
    assert ended.value.code == MISTAKE
    assert said in told
    assert told.endswith(f"; signorini {words[0]} --help explains the arguments\n")
    assert told.count("\n") == 1


@pytest.mark.parametrize("command", ["solve --element P1", "certificate", "certify"])
@pytest.mark.parametrize("n", [0, -4])
def test_what_is_no_level_is_told(command, n, small, capsys):
    code, _, told = call(capsys, *command.split(), small, f"--n={n}")
    assert code == 1
    assert told == f"error: --n {n}: n is 1/h, a positive whole number, for instance 8\n"


def test_show_tells_that_a_file_is_not_there(tmp_path, capsys):
    code, _, told = call(capsys, "show", tmp_path / "u.npz")
    assert code == 1
    assert told.startswith(f"error: {tmp_path / 'u.npz'}: there is no such file; make it")


@pytest.mark.parametrize("command", ["check", "macros", "sweep"])
def test_the_bare_name_of_a_scene_gets_its_path(command, capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    code, _, told = call(capsys, command, "smooth")
    assert code == 1
    assert told == "error: smooth: there is no such file; did you mean config/scenes/smooth.yaml?\n"
    assert "`signorini scenes` lists the scenes" in call(capsys, command, "nothing")[2]


def test_a_group_lists_its_parts(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["stability"])
    assert ended.value.code == MISTAKE
    assert "stability digits" in capsys.readouterr().out


def test_the_version(capsys):
    assert call(capsys, "--version") == (0, "signorini 1.0.0\n", "")


@pytest.mark.parametrize("words", [["--help"], ["sweep", "--help"], ["scenes"]])
def test_a_reader_that_has_gone_is_no_mistake(words):
    """As `head` is, once it has its lines; here it leaves before the first."""
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "signorini", *words]
    asked = {"stdout": writer, "stderr": subprocess.PIPE, "cwd": ROOT, "env": {"PYTHONPATH": "src"}}
    done = subprocess.run(command, **asked)
    os.close(writer)
    assert (done.returncode, done.stderr) == (0, b"")


def test_python_runs_it_as_a_module():
    words = [sys.executable, "-m", "signorini", "check", str(PAPER)]
    done = subprocess.run(
        words, capture_output=True, text=True, cwd=ROOT, env={"PYTHONPATH": "src"}
    )
    assert done.returncode == 0
    assert done.stdout.startswith("paper: valid, 2 elements on 6 levels, truth reference")
    assert done.stderr == ""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("truth:", "trut:", "trut: unknown key; did you mean truth?"),
        ("[2, 4]", "[3, 5]", "levels: "),
        ("sin(2*pi*x)", "sinn(2*pi*x)", "data.f: "),
    ],
)
def test_a_mistake_is_told_in_one_line_with_file_and_field(old, new, said, small, capsys):
    small.write_text(SMALL.replace(old, new), encoding="utf-8")
    for command in (["check"], ["errors"], ["solve", "--element", "P1", "--n", "2"]):
        code, out, err = call(capsys, command[0], small, *command[1:])
        assert (code, out) == (1, "")
        assert err.count("\n") == 1
        assert err.startswith(f"error: {small}: ")
        assert said in err


def test_debug_shows_where_an_error_comes_from(tmp_path):
    with pytest.raises(Exception, match=r"none\.yaml"):
        main(["check", str(tmp_path / "none.yaml"), "--debug"])


def test_ctrl_c_is_told_in_one_line(small, capsys, monkeypatch):
    def interrupted(arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr("signorini.commands.check.run", interrupted)
    code, _, err = call(capsys, "check", small)
    assert code == INTERRUPTED
    assert err == "error: interrupted; nothing was left half written\n"


def test_new_writes_a_valid_scene_and_no_file_twice(tmp_path, capsys):
    assert call(capsys, "new", "mine", "--folder", tmp_path)[0] == 0
    assert call(capsys, "check", tmp_path / "mine.yaml")[0] == 0
    code, _, err = call(capsys, "new", "mine", "--folder", tmp_path)
    assert code == 1
    assert "there already" in err
    assert call(capsys, "new", "../mine", "--folder", tmp_path)[0] == 1


def test_scenes_are_listed_with_titles_and_mistakes(small, capsys):
    (small.parent / "broken.yaml").write_text("{", encoding="utf-8")
    code, out, _ = call(capsys, "scenes", small.parent)
    assert code == 0
    assert [line.split()[0] for line in out.splitlines()] == ["broken", "small"]
    assert "not valid: " in out


def test_a_solve_tells_its_proof(small, capsys):
    code, out, _ = call(capsys, "solve", small, "--element", "CR", "--n", "4", "--json")
    told = json.loads(out)
    assert code == 0
    assert told["status"] == "solved"
    assert told["residual"] < 1e-12
    assert told["dofs"] == 52
    assert told["method"] == "fourier"


def test_verbose_tells_the_steps_and_a_pipe_is_quiet(small, capsys):
    words = ["solve", small, "--element", "P1", "--n", "4", "--method", "direct"]
    assert call(capsys, *words)[2] == ""
    assert "P1 n = 4: solving" in call(capsys, *words, "--verbose")[2]


def test_a_scene_file_and_its_validated_copy_give_the_same_bytes(small, tmp_path, capsys):
    validated = tmp_path / "scene.json"
    assert call(capsys, "check", small, "-o", validated)[0] == 0
    for scene in (small, validated):
        words = [
            "solve",
            scene,
            "--element",
            "P1",
            "--n",
            "4",
            "-o",
            tmp_path / f"{scene.stem}.npz",
        ]
        assert call(capsys, *words)[0] == 0
    assert (tmp_path / "small.npz").read_bytes() == (tmp_path / "scene.npz").read_bytes()


def test_an_altered_validated_scene_is_refused(small, tmp_path, capsys):
    validated = tmp_path / "scene.json"
    call(capsys, "check", small, "-o", validated)
    validated.write_text(validated.read_text().replace("16", "32"))
    code, _, err = call(capsys, "errors", validated)
    assert code == 1
    assert "truncated or altered" in err


def test_errors_rates_and_table_by_hand(small, tmp_path, capsys):
    """What a person types, from a scene to a table, with files in between or without."""
    code, shown, _ = call(capsys, "errors", small)
    assert code == 0
    assert len(shown.splitlines()) == 1 + 4 + 2  # a heading, errors, slopes
    solutions = []
    for element in ("P1", "CR"):
        for n in (2, 4):
            solutions.append(tmp_path / f"{element}{n}.npz")
            words = ["solve", small, "--element", element, "--n", n, "-o", solutions[-1]]
            assert call(capsys, *words)[0] == 0
    reference, errors, rates = (tmp_path / f for f in ("reference.npz", "errors.csv", "rates.csv"))
    assert call(capsys, "solve", small, "--reference", "-o", reference)[0] == 0
    words = ["errors", small, *solutions, "--reference", reference, "-o", errors]
    assert call(capsys, *words)[0] == 0
    own = json.loads(call(capsys, "errors", small, "--json")[1])
    stored = json.loads(call(capsys, *words, "--json")[1])
    assert own == stored
    assert call(capsys, "rates", small, errors, "-o", rates)[0] == 0
    code, table, _ = call(capsys, "table", small, errors, rates)
    assert code == 0
    assert table.count("|") > 20
    assert call(capsys, "show", errors)[1].startswith("element")
    assert "a solution" in call(capsys, "show", reference)[1]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--reference"], "truth.kind is exact, so that there is no reference"),
        (["--element", "P1"], "--n, for instance --element CR --n 64; or --reference"),
        (["--element", "P1", "--n", "0"], "--n 0: n is 1/h"),
    ],
)
def test_what_a_solve_needs(words, said, capsys):
    code, _, err = call(capsys, "solve", SMOOTH, *words)
    assert code == 1
    assert said in err
