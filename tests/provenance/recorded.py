"""A project as Snakemake leaves it: results, and a record of each beside them."""

import base64
import hashlib
import json
import os
from pathlib import Path


def sha256(content):
    return hashlib.sha256(content).hexdigest()


class Recorded:
    """A folder with files and Snakemake's records of them; time is counted in whole seconds."""

    def __init__(self, folder):
        self.folder = Path(folder)

    def __truediv__(self, path):
        return self.folder / path

    def write(self, path, content):
        """Write a file, with no record of it."""
        (self / path).parent.mkdir(parents=True, exist_ok=True)
        (self / path).write_bytes(content)

    def job(self, rule, outputs, inputs=(), start=0, seconds=1):
        """A job that ran: output -> content, and the inputs that it read as they are now."""
        for path, content in outputs.items():
            self.write(path, content)
            os.utime(self / path, (start + seconds, start + seconds))
            self.record(path, rule, inputs, start, seconds)

    def record(self, path, rule, inputs=(), start=0, seconds=1, **others):
        """Snakemake's record of an output."""
        digests = {name: f"sha256:{sha256((self / name).read_bytes())}" for name in inputs}
        told = {
            "rule": rule,
            "shellcmd": f"python3 -m signorini {rule} {start}",
            "input": list(inputs),
            "input_checksums": digests,
            "starttime": float(start),
            "endtime": float(start + seconds),
            "record_format_version": 6,
        }
        self.put("metadata", path, json.dumps(told | others))

    def put(self, kind, path, text):
        """A file of Snakemake's own, under the name that it gives to an output."""
        name = base64.urlsafe_b64encode(path.encode()).decode()
        *folders, last = [name[k : k + 254] for k in range(0, len(name), 254)]
        file = Path(self / ".snakemake" / kind, *(f"@{part}" for part in folders), last)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
