""".ci/try_artifact.py reads every command of ARTIFACT.md, and notices what is not as it says."""

import importlib.util
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SCRIPT = ROOT / ".ci/try_artifact.py"
PAGE = (ROOT / "ARTIFACT.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def script():
    if not SCRIPT.is_file():
        pytest.skip("not in a checkout")
    spec = importlib.util.spec_from_file_location("try_artifact", SCRIPT)
    module = sys.modules["try_artifact"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_command_of_the_page_is_a_step(script):
    steps = script.blocks(PAGE) + script.claims(PAGE)
    scripts = "\n".join(step.script for step in steps)
    pattern = r"`((?:make|snakemake|signorini) [^`]+)`"
    commands = {*re.findall(pattern, PAGE)} - {"make test"}  # which continuous integration runs
    assert len(commands) > 8
    assert len(script.blocks(PAGE)) == 3
    assert all(command in scripts for command in commands - {"signorini verify"})


def test_every_claim_expects_something_that_is_held(script):
    for step in script.claims(PAGE):
        known = any(path.endswith(end) for path in step.files for end in script.CHECKS)
        fails_itself = step.script in ("make paper", "make artifact") or "all_scenes" in step.script
        assert step.printed or known or fails_itself, step.script


def test_what_is_not_printed_or_not_written_is_told(script, tmp_path):
    step = script.Step("true", ("as it is",), ("a/b.csv",))
    assert script.faults(step, "as it was", tmp_path) == [
        "not printed: as it is",
        "not written: a/b.csv",
    ]


TABLES = {
    "paper/check.csv": ("cell,ok\na,1\n", "cell,ok\na,1\nb,0\n"),
    "stability/claims.csv": ("claim,met\na,True\n", "claim,met\na,False\n"),
    "guaranteed/guaranteed.csv": ("lower,upper\n1,2\n", "lower,upper\n3,2\n"),
    "adaptive/adaptive.csv": ("scene,fewer\nnotch,2\nx,0.5\n", "scene,fewer\nnotch,0.9\n"),
    "benchmark/rivals.csv": (
        "ratio_min,ratio,ratio_max\n1,2,3\n,,\n",
        "ratio_min,ratio,ratio_max\n1,4,3\n",
    ),
    "sensitivity/sensitivity_digits.csv": (
        "hypothesis,of,errors,digits\nload in single precision,all,24,24\n",
        "hypothesis,of,errors,digits\nload in single precision,all,24,23\n",
    ),
    "paper/rates.csv": (
        "norm,kind,slope\nl2,mean,1.895\nh1,mean,1\nh1_semi,mean,3\nl2,fit,7\n",
        "norm,kind,slope\nl2,mean,1.88\nh1,mean,1\n",
    ),
}


@pytest.mark.parametrize("name", TABLES)
def test_a_table_that_is_not_as_expected_is_told(script, tmp_path, name):
    step = script.Step("true", files=(name,), expected="L2 1.90, H1 1.00; 0.01")
    (tmp_path / name).parent.mkdir()
    right, wrong = TABLES[name]
    (tmp_path / name).write_text(right, encoding="utf-8")
    assert script.faults(step, "", tmp_path) == []
    (tmp_path / name).write_text(wrong, encoding="utf-8")
    (found,) = script.faults(step, "", tmp_path)
    assert found.startswith(f"{name}: not as expected: ")


def test_a_statement_that_is_not_bounded_is_told(script, tmp_path):
    lines = [f"| {name} | 1 | bounded |\n" for name in script.BOUNDED]
    step = script.Step("true", files=("theory/theory.md",))
    (tmp_path / "theory").mkdir()
    (tmp_path / "theory/theory.md").write_text("".join(lines), encoding="utf-8")
    assert script.faults(step, "", tmp_path) == []
    lines[1] = lines[1].replace("bounded", "grows")
    (tmp_path / "theory/theory.md").write_text("".join(lines), encoding="utf-8")
    assert script.faults(step, "", tmp_path) == [
        f"theory/theory.md: not as expected: {script.BOUNDED[1]}"
    ]


def test_what_is_long_or_needs_more_is_left_out_with_a_reason(script):
    step = script.Step("snakemake", long=True)
    assert "--long" in script.left_out(step, long=False)
    assert script.left_out(step, long=True) is None
    assert script.left_out(script.Step("apt-get install make"), long=True)
