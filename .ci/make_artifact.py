"""Pack the sources of a commit, the wheels of requirements.txt, and the results of the paper in one
archive, from which all is built again without a network: `make artifact`.

    python .ci/make_artifact.py [FOLDER]

The same commit, machine and package versions give the same bytes: entries are sorted, belong to
nobody, and have the time of the commit; of the record of the build the archive has what does not
tell a time. Results are in `expected`, so that `make paper` builds its own beside them.
"""

import argparse
import gzip
import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))

from signorini.provenance.build import timeless  # noqa: E402 (the path above must come first)
from signorini.provenance.folder import RECORD, is_kept, walk  # noqa: E402

EXPECTED = "expected"
LOCK = "requirements.txt"
_LEVEL = 1  # of compression: nearly all are wheels, which are compressed


def git(*words):
    """What Git says, as bytes."""
    return subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True).stdout


def fetch_wheels(folder, time):
    """Put wheels of the lock file in a folder, and those that building this program needs."""
    pins = re.findall(r"^[\w.-]+==[^\n]*", (ROOT / LOCK).read_text(encoding="utf-8"), re.M)
    lock = folder.parent / "pins.txt"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    lock.write_text("\n".join([*pins, *build_requirements()]) + "\n", encoding="utf-8")
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check"]
    options = ["--no-deps", "--wheel-dir", str(folder), "--requirement", str(lock)]
    environment = os.environ | {"SOURCE_DATE_EPOCH": str(time)}
    subprocess.run([*command, *options], check=True, env=environment)


def build_requirements():
    """What pip installs to build this program."""
    with open(ROOT / "pyproject.toml", "rb") as stream:
        return tomllib.load(stream)["build-system"]["requires"]


def sources(prefix):
    """Path -> content and mode of the files of HEAD."""
    found = {}
    with tarfile.open(fileobj=io.BytesIO(git("archive", "--format=tar", "HEAD"))) as archive:
        for entry in archive:
            if entry.isfile():
                content = archive.extractfile(entry).read()
                found[f"{prefix}/{entry.name}"] = content, entry.mode, None
            elif entry.issym():
                found[f"{prefix}/{entry.name}"] = b"", 0o777, entry.linkname
    return found


def results(prefix):
    """Path -> content and mode of results and their digests, and of their record without times."""
    record = json.loads((ROOT / "results" / RECORD).read_text(encoding="utf-8"))
    kept = json.dumps(timeless(record), indent=1) + "\n"
    found = {f"{prefix}/{RECORD}": (kept.encode(), 0o644, None)}
    files, _ = walk(ROOT / "results")
    for path in filter(is_kept, files):
        found[f"{prefix}/{path}"] = (ROOT / "results" / path).read_bytes(), 0o644, None
    return found


def pack(path, entries, time):
    """Write a .tar.gz whose bytes depend on the entries and the time alone.

    Parameters
    ----------
    path : Path
    entries : dict
        Name -> content, mode, and what it links to or None.
    time : int
        Of every entry, in seconds since 1970.
    """
    with (
        open(path, "wb") as raw,
        gzip.GzipFile("", "wb", _LEVEL, raw, mtime=0) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive,
    ):
        for name in sorted(entries):
            content, mode, link = entries[name]
            entry = tarfile.TarInfo(name)
            entry.mtime, entry.mode = time, 0o755 if mode & 0o100 else 0o644
            entry.size = len(content)
            if link is not None:
                entry.type, entry.linkname, entry.mode = tarfile.SYMTYPE, link, 0o777
            archive.addfile(entry, io.BytesIO(content))


def main():
    """Pack, and write the checksum beside the archive."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", metavar="FOLDER", nargs="?", default=ROOT / "build/artifact")
    folder = Path(parser.parse_args().folder)
    if git("status", "--porcelain", "--untracked-files=no"):
        sys.exit("error: the checkout differs from its commit; commit or stash, and run it again")
    with open(ROOT / "pyproject.toml", "rb") as stream:
        stem = f"signorini-{tomllib.load(stream)['project']['version']}"
    time = int(git("log", "-1", "--format=%ct"))
    fetch_wheels(folder / "wheels", time)
    wheels = sorted((folder / "wheels").glob("*.whl"))
    entries = sources(stem) | results(f"{stem}/{EXPECTED}")
    entries |= {
        f"{stem}/wheels/{wheel.name}": (wheel.read_bytes(), 0o644, None) for wheel in wheels
    }
    path = folder / f"{stem}.tar.gz"
    pack(path, entries, time)
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    path.with_name(f"{path.name}.sha256").write_text(f"{digest}  {path.name}\n", encoding="utf-8")
    print(f"{path}: {path.stat().st_size / 1e6:.0f} MB, {len(wheels)} wheels, SHA-256 {digest}")


if __name__ == "__main__":
    main()
