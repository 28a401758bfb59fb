"""The workflow's own form: layout, lint, logs, benchmarks, report."""

import inspect
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from project import FILES, ROOT

RULES = {
    name: body
    for path in sorted((ROOT / "workflow/rules").glob("*.smk"))
    for name, body in re.findall(
        r"^rule (\w+):\n((?: .*\n|\n)+)", path.read_text(encoding="utf-8"), re.M
    )
}
# A command that imports one of these computes; the others format, draw or check. What a study
# measures tells its own time.
COMPUTING = re.compile(
    r"^from signorini\.(mesh\.domain|fem\.(?!element_facts)\w+|solvers"
    r"|errors\.measure|report\.(?:field|details)|certificate\.level"
    r"|open_choices\.\w+|studies\.sensitivity\.(?:errors|digits)|studies\.theory\.estimates)"
    r" import (?!count_solves|read_level|[A-Z]+\b)",
    re.M,
)


# Rules whose output no edit makes again: what was true when it was written.
ONCE = {"benchmark_machine"}


@pytest.mark.parametrize("rule", RULES)
def test_rule(rule):
    """A rule runs one command, which a person can type, and depends on what that can load."""
    body = RULES[rule]
    shell = body.partition("    shell:\n")[2]
    (words,) = re.findall(r"python3 -m signorini ([\w-]+(?: [a-z][\w-]+)?)", shell)
    command = words if words in FILES else words.partition(" ")[0]
    assert "    log:\n" in body
    assert "2>&1 | tee {log:q}" in body
    if rule in ONCE:
        assert "library(" not in body
        assert "content(" not in body
        return
    assert re.search(rf'library\("{command}"[,)]', body)
    (content,) = re.findall(r"^        content=content\((.*)\),$", body, re.M)
    assert content.startswith(f'"{command}"')
    sources = re.findall(
        r"^        (?:source|published)=(.*),$", body.partition("    output:")[0], re.M
    )
    assert content.split(", ")[1:] == sources  # what else is no result
    assert "json" not in shell
    code = (ROOT / FILES[command]).read_text(encoding="utf-8")
    assert bool(COMPUTING.search(code)) == ("    benchmark:\n" in body)


def test_every_job_has_a_log_of_its_own(all_jobs):
    """Rules derived by `use rule` inherit the log's name."""
    for run in all_jobs.values():
        logs = re.findall(r"^    log: (.*)$", run.text, re.M)
        assert len(logs) == len(set(logs)) == sum(run.jobs.values())


def test_snakemake_finds_nothing_to_complain_about(built_small):
    """But for its wish for a conda environment: requirements.txt says what every rule needs."""
    text = built_small.run("--lint").text
    found = [line for line in text.splitlines() if line.startswith("    * ")]
    assert [line for line in found if "conda environment or container" not in line] == []


@pytest.mark.skipif(not shutil.which("snakefmt"), reason="snakefmt is not installed")
def test_layout():
    command = [shutil.which("snakefmt"), "--check", "Snakefile", "workflow"]
    result = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


def test_report(paper):
    paper.build("--report", "report.html")
    text = (paper / "report.html").read_text(encoding="utf-8")
    assert all(
        name in text for name in ("figure_5_1.png", "figure_5_2.png", "figure_5_3.png", "check.csv")
    )


def test_no_two_files_of_tests_share_a_name():
    """Without packages pytest imports them by their names alone."""
    names = [path.name for path in (ROOT / "tests").rglob("test_*.py")]
    assert sorted(set(names)) == sorted(names)


def test_the_limit_on_jobs_that_the_workflow_lifts_is_snakemakes():
    """`onstart` sets a private attribute to None, which this version takes as: no limit."""
    from snakemake.scheduling.job_scheduler import JobScheduler

    names = JobScheduler.__init__.__code__.co_names
    assert "job_rate_limiter" in names
    source = Path(inspect.getsourcefile(JobScheduler)).read_text(encoding="utf-8")
    assert source.count("self.job_rate_limiter is None") + source.count(
        "self.job_rate_limiter is not None"
    ) == len(re.findall(r"if self\.job_rate_limiter\b", source))
    pinned = (ROOT / "requirements.txt").read_text(encoding="utf-8")
    assert re.search(r"^snakemake==9\.", pinned, re.M)
