"""Say what is in result files: a solution, mesh or field (.npz), or a table (.csv).

example:
  signorini show results/paper/solutions/CR/n64.npz
"""

import zipfile
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.exceptions import StorageError
from signorini.storage import read_npz, read_table
from signorini.storage.files import missing

_ROWS = 20  # of a table that are shown


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("files", metavar="FILE", nargs="+", type=Path, help=".npz or .csv files")


def run(arguments):
    """Read the files, their digests included, and describe each.

    Raises
    ------
    StorageError
        If one is not a whole result file.
    """
    shown = {str(path): _shown(path) for path in arguments.files}
    if len(shown) == 1:
        return next(iter(shown.values()))
    texts = [_headed(path, each.text) for path, each in shown.items()]
    return Outcome("\n\n".join(texts), {path: each.data for path, each in shown.items()})


def _headed(path, text):
    """What is told of one file of several; that of arrays begins with its name."""
    return text if text.startswith(f"{path}:") else f"{path}:\n{text}"


def _shown(path):
    reader = {".npz": _arrays, ".csv": _table}.get(path.suffix)
    if reader is None:
        raise StorageError(f"{path}: neither .npz nor .csv; name a result file")
    return reader(path)


def _arrays(path):
    values = read_npz(path, _kind(path))
    texts = {name: _described(value) for name, value in values.items()}
    width = max(map(len, texts))
    lines = [f"{name:<{width}}  {text}" for name, text in texts.items()]
    return Outcome("\n".join([f"{path}: a {_kind(path)}", *lines]), {"kind": _kind(path)} | texts)


def _kind(path):
    """What an .npz says that it is."""
    import numpy as np

    try:
        with np.load(path, allow_pickle=False) as archive:
            return str(archive["kind"])
    except FileNotFoundError:
        raise missing(path) from None
    except (OSError, KeyError, ValueError, zipfile.BadZipFile) as error:
        raise StorageError(f"{path}: not a result file ({error})") from error


def _described(value):
    """A number as it is, an array by its shape and range."""
    if value.ndim == 0:
        return str(value.item())
    shape = " by ".join(map(str, value.shape))
    if value.dtype == bool:
        return f"{shape}, {int(value.sum())} true"
    if value.size and value.dtype.kind in "if":
        return f"{shape}, from {value.min():.6g} to {value.max():.6g}"
    return f"{shape}, {value.dtype}"


def _table(path):
    rows = read_table(path)
    columns = list(rows[0])
    cells = [columns, *([row[name] for name in columns] for row in rows[:_ROWS])]
    widths = [max(len(line[k]) for line in cells) for k in range(len(columns))]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in cells
    ]
    more = [f"... and {len(rows) - _ROWS} more rows"] if len(rows) > _ROWS else []
    return Outcome("\n".join(lines + more), rows)
