"""Run the commands of ARTIFACT.md in an unpacked archive, as a reviewer would, and hold what they
print and write against what the page says.

    python .ci/try_artifact.py [--long] [--durations FILE]

The archive is that of `make artifact`. The environment is empty but for PATH, HOME and TMPDIR, the
latter two empty folders, and the network is taken away. Studies are run in their small form. A
command that is marked as long is run with `--long` only.
"""

import argparse
import csv
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "ARTIFACT.md"
SMALL = "--config quick=true"
SYSTEM = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
LEFT_OUT = {
    "apt-get": "it needs root and a network",
    "make artifact": "it made the archive",
}
BOUNDED = ("Lemma 2.1", "Lemma 4.1", "Theorem 4.1", "Theorem 4.2", "Theorem 4.3")
PAYS = ("l-shape", "notch", "inclusion")  # scenes of which adaptive meshes take fewer unknowns
_BLOCK = re.compile(r"^```(?:text)?\n(.*?)^```\n+(.*?)(?:\n\n|\Z)", re.M | re.S)
_QUOTED = re.compile(r"`([^`]+)`")


@dataclass(frozen=True)
class Step:
    """Commands, what they must print, and what the files that they write must hold.

    Parameters
    ----------
    script : str
        For bash.
    printed : tuple of str
        Each is in the output.
    files : tuple of str
        Below the results; none is empty.
    long : bool
        Whether it is marked as long.
    expected : str
        What the page says of it.
    """

    script: str
    printed: tuple = ()
    files: tuple = ()
    long: bool = False
    expected: str = ""


def blocks(text):
    """The blocks of commands of a page; what the paragraph after each quotes must be printed.

    Parameters
    ----------
    text : str
        In Markdown.

    Returns
    -------
    list of Step
    """
    found = [(match[1], match[2]) for match in _BLOCK.finditer(text)]
    return [Step(script.rstrip(), tuple(_QUOTED.findall(after))) for script, after in found]


def claims(text):
    """The rows of the table of claims.

    Parameters
    ----------
    text : str
        Of the page.

    Returns
    -------
    list of Step
    """
    table = [line for line in text.partition("## Claims")[2].splitlines() if line.startswith("| ")]
    return [_claim(*(cell.strip() for cell in line.strip("|").split("|"))) for line in table[2:]]


def _claim(_, command, expected, tolerance, where, duration):
    script = command.strip("`")
    files = tuple(path for path in _QUOTED.findall(where) if "." in path)
    if any(path.startswith("studies/") for path in files):
        script = f"{script} {SMALL}"
        name = files[0].split("/")[1]
        pages = (f"studies/{name}/{name}.md", f"studies/{name}/{name}.tex")
        files = tuple(path.replace("studies/", "quick/") for path in (*files, *pages))
    told = tuple(_QUOTED.findall(expected)) if script.startswith("signorini verify") else ()
    return Step(script, told, files, "long" in duration, f"{expected}; {tolerance}")


def rows_of(path):
    """The rows of a table, of which there is one at least."""
    with open(path, encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    if not rows:
        raise ValueError(f"{path}: no rows")
    return rows


def _every(test):
    """The rows that fail a test, for a file of the given path."""
    return lambda path, _: [row for row in rows_of(path) if not test(row)]


def _slopes(path, expected):
    """Average slopes that are not those quoted, to the tolerance, the last number of the text."""
    rows = [row for row in rows_of(path) if row["kind"] == "mean" and row["norm"] in ("l2", "h1")]
    means = sorted(float(row["slope"]) for row in rows)
    *quoted, tolerance = map(float, re.findall(r"\d\.\d+", expected))
    if len(means) != len(quoted):
        return [f"{len(means)} average slopes"]
    pairs = zip(means, sorted(quoted), strict=True)
    return [mean for mean, number in pairs if abs(mean - number) > tolerance]


def _bounded(path, _):
    """Statements that a page of the theory does not call bounded."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return [
        name
        for name in BOUNDED
        if not any(
            line.startswith(f"| {name} |") and line.endswith("| bounded |") for line in lines
        )
    ]


def _ordered(*names):
    """Whether the numbers of these columns, where there are any, do not fall."""

    def test(row):
        numbers = [float(row[name]) for name in names if row[name]]
        return numbers == sorted(numbers)

    return test


def _six(path, _):
    """Fewer digits than all with the sixth choice."""
    name = "load in single precision"
    rows = [row for row in rows_of(path) if (row["hypothesis"], row["of"]) == (name, "all")]
    return [] if rows and all(row["digits"] == row["errors"] for row in rows) else rows or [name]


# What a file holds besides not being empty: by the end of its path, what is wrong with it.
CHECKS = {
    "paper/rates.csv": _slopes,
    "paper/check.csv": _every(lambda row: row["ok"] == "1"),
    "stability/claims.csv": _every(lambda row: row["met"] == "True"),
    "guaranteed/guaranteed.csv": _every(_ordered("lower", "upper")),
    "adaptive/adaptive.csv": _every(
        lambda row: row["scene"] not in PAYS or float(row["fewer"]) > 1
    ),
    "theory/theory.md": _bounded,
    "benchmark/rivals.csv": _every(_ordered("ratio_min", "ratio", "ratio_max")),
    "sensitivity/sensitivity_digits.csv": _six,
}


def faults(step, output, results):
    """What is not as the page says, in words.

    Parameters
    ----------
    step : Step
    output : str
        What was printed.
    results : Path
        The folder in which the files of the step are.

    Returns
    -------
    list of str
    """
    found = [f"not printed: {phrase}" for phrase in step.printed if phrase not in output]
    for name in step.files:
        path = results / name
        if not path.is_file() or not path.stat().st_size:
            found.append(f"not written: {name}")
            continue
        check = next((test for end, test in CHECKS.items() if name.endswith(end)), None)
        wrong = check(path, step.expected) if check else []
        found += [f"{name}: not as expected: {each}" for each in wrong[:3]]
    return found


class Reviewer:
    """Who runs scripts with next to no environment and no network.

    Parameters
    ----------
    work : Path
        An empty folder.
    """

    def __init__(self, work):
        for name in ("home", "tmp"):
            (work / name).mkdir()
        path = SYSTEM if fits(SYSTEM) else f"{sys.base_prefix}/bin:{SYSTEM}"
        self.environment = {"PATH": path, "HOME": f"{work}/home", "TMPDIR": f"{work}/tmp"}
        away = ["unshare", "--net"]
        self.away = away if _works([*away, "true"]) else []
        if not self.away:
            print("the network cannot be taken away here")

    def run(self, script, folder):
        """Exit status, output and seconds of a script."""
        start = time.monotonic()
        done = subprocess.run(
            [*self.away, "bash", "-euo", "pipefail", "-c", script],
            cwd=folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            check=False,
        )
        return done.returncode, done.stdout.decode("utf-8", "replace"), time.monotonic() - start


def fits(path):
    """Whether the python3 of a path can install the wheels, which are of this Python."""
    test = f"import ensurepip, sys; sys.exit(sys.version_info[:2] != {sys.version_info[:2]})"
    return _works(["python3", "-c", test], {"PATH": path})


def _works(command, environment=None):
    try:
        done = subprocess.run(command, env=environment, capture_output=True, check=False)
    except OSError:
        return False
    return done.returncode == 0


def left_out(step, long):
    """Why a step is not run; None where it is."""
    if step.long and not long:
        return "it is marked as long; --long runs it"
    return next((why for start, why in LEFT_OUT.items() if step.script.startswith(start)), None)


def tried(step, reviewer, folder, script):
    """Run a step and tell how it went; exit where it is not as the page says.

    Returns
    -------
    float
        Seconds.
    """
    status, output, seconds = reviewer.run(script, folder)
    here = next(iter((folder, *Path(reviewer.environment["TMPDIR"]).glob("tmp.*"))))
    found = faults(step, output, here / "results") if status == 0 else [f"exit status {status}"]
    if found:
        print(*output.splitlines()[-30:], sep="\n")
        sys.exit("\n".join(f"error: {step.script}: {fault}" for fault in found))
    print(f"{seconds:6.0f} s  {step.script.splitlines()[-1]}", flush=True)
    return seconds


def main():
    """Unpack, build and try; the first difference ends it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--long", action="store_true", help="run what is marked as long, too")
    parser.add_argument("--durations", type=Path, help="a file to which to append command,seconds")
    arguments = parser.parse_args()
    text = PAGE.read_text(encoding="utf-8")
    found = blocks(text)
    rebuild = next(step for step in found if step.script.startswith("folder="))
    steps = [step for step in found if step is not rebuild] + claims(text)
    with tempfile.TemporaryDirectory() as work:
        reviewer = Reviewer(Path(work))
        tried(rebuild, reviewer, ROOT, rebuild.script)
        (folder,) = Path(work, "tmp").glob("tmp.*")
        measured = {}
        for step in steps:
            if why := left_out(step, arguments.long):
                print(f"left out  {step.script}: {why}")
            else:
                script = f". .venv/bin/activate\n{step.script}"
                seconds = tried(step, reviewer, folder, script)
                measured.setdefault(step.script, seconds)
    if arguments.durations:
        with open(arguments.durations, "a", encoding="utf-8", newline="") as stream:
            csv.writer(stream, lineterminator="\n").writerows(
                (script, round(seconds))
                for script, seconds in measured.items()
                if "\n" not in script
            )


if __name__ == "__main__":
    main()
