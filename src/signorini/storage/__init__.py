"""Files: written whole or not at all, and refused when truncated or altered.

An .npz carries its checksums inside. Every other result has its SHA-256 digest in a hidden file
beside it, in the format of sha256sum: ``errors.csv`` in ``.errors.csv.sha256``. So tables stay
plain, and a copy of a folder is complete.
"""

from signorini.storage.arrays import read_npz, write_npz
from signorini.storage.files import (
    digest_file,
    read_json,
    read_sealed,
    replacing,
    sealing,
    write_json,
    write_text,
)
from signorini.storage.tables import read_csv, read_table, write_csv

__all__ = [
    "digest_file",
    "read_csv",
    "read_json",
    "read_npz",
    "read_sealed",
    "read_table",
    "replacing",
    "sealing",
    "write_csv",
    "write_json",
    "write_npz",
    "write_text",
]
