"""A subprocess sandbox for foreign code: bounded memory and time, and a crash is only an error.

`run_in_sandbox` starts a Python process and waits for it. The request goes to its stdin as JSON:
function, memory limit, arguments. The process answers on stdout with one status byte, ``+`` for
the arrays of an .npz archive and ``-`` for the message of a MeshError. No answer, or another one,
means that it crashed.
"""

import contextlib
import importlib
import io
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from signorini.exceptions import MeshError

_WORKER = "from signorini.mesh.sandbox import worker_main; worker_main()"
_LONGEST_MESSAGE = 300


def run_in_sandbox(function, *arguments, memory_limit, timeout, task):
    """Call a function of this package in a new process.

    Parameters
    ----------
    function : str
        ``"module:name"``; it returns a dict of arrays (no Python objects) and may raise MeshError.
    *arguments
        Anything JSON can hold.
    memory_limit : int
        Address space the process may use, in bytes; enforced on Linux only.
    timeout : float
        Wall-clock time after which the process is killed, seconds.
    task : str
        What is done, for messages.

    Returns
    -------
    dict of ndarray

    Raises
    ------
    MeshError
        What the function raised, whatever it was, or that it ran out of memory or time, or crashed.
    """
    request = json.dumps([function, memory_limit, arguments]).encode()
    try:
        done = subprocess.run(
            [sys.executable, "-c", _WORKER],
            input=request,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=_environment(),
            timeout=timeout,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise MeshError(
            f"{task}: not done after {timeout:.0f} s; use a smaller or simpler mesh"
        ) from None
    except (OSError, MemoryError) as error:
        raise MeshError(f"{task}: cannot start a process ({error}); free memory") from None
    status, answer = done.stdout[:1], done.stdout[1:]
    if done.returncode or status not in (b"+", b"-"):
        raise MeshError(
            f"{task}: crashed or ran out of memory ({memory_limit / 2**20:.0f} MiB); "
            "use a smaller or sound mesh"
        )
    if status == b"-":
        raise MeshError(answer.decode())
    with np.load(io.BytesIO(answer), allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def _environment():
    """This process's, in which the worker finds this package wherever it is imported from."""
    root = str(Path(__file__).parents[2])
    search_path = filter(None, [root, os.environ.get("PYTHONPATH")])
    return os.environ | {"PYTHONPATH": os.pathsep.join(search_path)}


def worker_main():
    """Serve one request of `run_in_sandbox`, in the process that it started."""
    channel = _silence()
    function, memory_limit, arguments = json.load(sys.stdin)
    try:
        limit_memory(memory_limit)
        module, name = function.split(":")
        arrays = getattr(importlib.import_module(module), name)(*arguments)
        archive = io.BytesIO()
        np.savez(archive, **arrays)
        answer = b"+" + archive.getvalue()
    except MeshError as error:
        answer = f"-{one_line(error)}".encode()
    except MemoryError:
        answer = b""
    with os.fdopen(channel, "wb") as stream:
        stream.write(answer)


def _silence():
    """Keep stdout for the answer, as a new file descriptor, and let nothing else through."""
    channel = os.dup(1)
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    return channel


def limit_memory(size):
    """Let this process use at most `size` bytes of address space, or less if already limited."""
    try:
        import resource
    except ImportError:  # Windows
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    known = [limit for limit in (size, soft, hard) if limit != resource.RLIM_INFINITY]
    with contextlib.suppress(ValueError, OSError):  # macOS knows the limit, but refuses to set it
        resource.setrlimit(resource.RLIMIT_AS, (min(known), hard))


def one_line(error):
    """The text of an exception on one line of bounded length.

    Examples
    --------
    >>> one_line(ValueError("a text\\nof two lines"))
    'a text of two lines'
    """
    text = " ".join(str(error).split()) or type(error).__name__
    if len(text) <= _LONGEST_MESSAGE:
        return text
    return text[: _LONGEST_MESSAGE - 3] + "..."
