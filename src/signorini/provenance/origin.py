"""Where the sources come from, and what they ran on."""

import os
import re
import subprocess
from pathlib import Path

ARCHIVED = ".git_archival.txt"  # in which `git archive` writes the commit
_COMMIT = re.compile(r"^node: ([0-9a-f]{40})$", re.M)
# Reading a state must start nothing and write nothing.
_GIT = ("git", "--no-optional-locks", "-c", "core.fsmonitor=false")


def source_of(project):
    """The commit of a project.

    Parameters
    ----------
    project : path-like

    Returns
    -------
    dict
        ``commit``, or None where neither Git nor an archive says it; ``dirty``, whether files
        differ from it, None where nobody knows; ``changed``, those files.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     source_of(folder)
    {'commit': None, 'dirty': None, 'changed': []}
    """
    project = Path(project).resolve()
    top = _git(project, "rev-parse", "--show-toplevel")
    if top is None or Path(top.strip()).resolve() != project:
        return {"commit": _archived(project), "dirty": None, "changed": []}
    commit = _git(project, "rev-parse", "--verify", "--quiet", "HEAD")
    status = _git(project, "status", "--porcelain=v1", "-z", "--no-renames") or ""
    changed = sorted(entry[3:] for entry in status.split("\0") if entry)
    return {"commit": commit and commit.strip(), "dirty": bool(changed), "changed": changed}


def _git(project, *words):
    """What Git says, or None where there is no Git, or no repository."""
    environment = {name: os.environ[name] for name in os.environ if not name.startswith("GIT_")}
    try:
        done = subprocess.run(
            [*_GIT, *words], cwd=project, env=environment, capture_output=True, check=False
        )
    except OSError:
        return None
    return done.stdout.decode("utf-8", "replace") if done.returncode == 0 else None


def _archived(project):
    """The commit that an archive was made of."""
    try:
        found = _COMMIT.search((project / ARCHIVED).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found and found[1]


def pinned(project):
    """Names of the packages that a project's lock file pins.

    Parameters
    ----------
    project : path-like

    Returns
    -------
    list of str
    """
    path = Path(project, "requirements.txt")
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    return re.findall(r"^([\w.-]+)==", text, re.M)
