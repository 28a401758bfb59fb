"""Damages to files, and what the jobs that read them say."""

import io
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

from signorini.storage import write_text


def cut(content):
    return content[: len(content) // 2]


def flip(content):
    """One bit changed, in the middle."""
    half = len(content) // 2
    return content[:half] + bytes([content[half] ^ 1]) + content[half + 1 :]


def another_digit(content):
    """The last digit of a table changed, or a bit of a number in an archive, or any of what else is
    no text.
    """
    if zipfile.is_zipfile(io.BytesIO(content)):
        return another_number(content)
    if b"\0" in content:
        return flip(content)
    place = max(content.rindex(digit) for digit in b"0123456789" if digit in content)
    return content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]


def another_number(content):
    """A bit changed in the last number of the entry half-way: between entries are bytes that say
    nothing.
    """
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        entries = archive.infolist()
    end = entries[len(entries) // 2].header_offset
    return content[: end - 1] + bytes([content[end - 1] ^ 1]) + content[end:]


def without_last_row(content):
    return b"".join(content.splitlines(keepends=True)[:-1])


# Readers: a dry run tells each job's inputs and its command, which is then run on damaged inputs,
# without Snakemake.

JOB = re.compile(
    r"^(?:local)?rule (\w+):\n    input: (.*)\n(?:    .*\n)*Shell command: (.*)$", re.M
)
ASKED = {"errors.csv", "rates.csv", "effects.csv"}  # whose rows are known from the scene


def readers(project, *targets):
    """Rule -> the results that its first job reads, and its command."""
    text = project.build(
        *targets, "--dry-run", "--forceall", "--printshellcmds", "--quiet", "host"
    ).text
    found = {}
    for rule, inputs, command in JOB.findall(text):
        results = [path for path in inputs.split(", ") if path.startswith("results/")]
        if results and command != "None":  # a target alone has none
            found.setdefault(rule, (results, command))
    return found


def refusal(project, command):
    """What a job's command says when it refuses its inputs; nothing where it takes them."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    call = ["bash", "-o", "pipefail", "-c", command]
    done = subprocess.run(
        call, cwd=project.folder, env=os.environ | {"PATH": path}, capture_output=True, text=True
    )
    return done.stdout if done.returncode else ""


def accepted(project, damage, chosen, *targets, sealed=False):
    """Of all jobs and what they read: the pairs (rule, file) where the damage went unnoticed."""
    unnoticed, tried = [], 0
    for rule, (paths, command) in readers(project, *targets).items():
        for name in {Path(path).name: path for path in paths if chosen(Path(path))}.values():
            path = project / name
            content, digest = path.read_bytes(), path.with_name(f".{path.name}.sha256")
            seal = digest.read_bytes() if digest.exists() else None
            path.write_bytes(damage(content))
            if sealed:
                write_text(path, damage(content).decode())
            said = refusal(project, command)
            if (
                f"error: {name}: " not in said
                or "delete it and rerun" not in said
                or "Traceback" in said
            ):
                unnoticed.append((rule, name, said))
            path.write_bytes(content)
            if seal:
                digest.write_bytes(seal)
            tried += 1
    assert tried > 5
    return unnoticed
