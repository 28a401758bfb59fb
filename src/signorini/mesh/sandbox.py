"""Foreign code in a process of its own: bounded memory and time, no output, and a crash that is
only an error.
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

_START = "from signorini.mesh.sandbox import serve; serve()"
_SHORT = 300


def run_apart(function, *arguments, memory, seconds, what):
    """Call a function of this package in a new process.

    Parameters
    ----------
    function : str
        ``"module:name"``; it returns a dict of arrays (no Python objects) and may raise MeshError.
    *arguments
        Anything JSON can hold.
    memory : int
        Address space the process may use, in bytes; enforced on Linux only.
    seconds : float
        Wall-clock time after which the process is killed.
    what : str
        What is done, for messages.

    Returns
    -------
    dict of ndarray

    Raises
    ------
    MeshError
        What the function raised, whatever it was, or that it ran out of memory or time, or crashed.
    """
    root = str(Path(__file__).parents[2])
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join(filter(None, [root, os.environ.get("PYTHONPATH")]))
    }
    request = json.dumps([function, memory, arguments]).encode()
    try:
        done = subprocess.run(
            [sys.executable, "-c", _START],
            input=request,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
            timeout=seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise MeshError(
            f"{what}: not done after {seconds:.0f} s; use a smaller or simpler mesh"
        ) from None
    except (OSError, MemoryError) as error:
        raise MeshError(f"{what}: cannot start a process ({error}); free memory") from None
    status, answer = done.stdout[:1], done.stdout[1:]
    if done.returncode or status not in b"+-" or not status:
        raise MeshError(
            f"{what}: crashed or ran out of memory ({memory / 2**20:.0f} MiB); use a smaller or sound mesh"
        )
    if status == b"-":
        raise MeshError(answer.decode())
    with np.load(io.BytesIO(answer), allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def serve():
    """The other end of `run_apart`: read the request from stdin, answer on stdout, let nothing else
    through.
    """
    channel = os.dup(1)
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    os.dup2(null, 2)
    function, memory, arguments = json.load(sys.stdin)
    try:
        limit_memory(memory)
        module, name = function.split(":")
        archive = io.BytesIO()
        np.savez(archive, **getattr(importlib.import_module(module), name)(*arguments))
        answer = b"+" + archive.getvalue()
    except MeshError as error:
        answer = f"-{one_line(error)}".encode()
    except MemoryError:
        answer = b""
    with os.fdopen(channel, "wb") as stream:
        stream.write(answer)


def limit_memory(size):
    """Let this process use at most `size` bytes of address space, or less if it is already limited."""
    try:
        import resource
    except ImportError:  # Windows
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    known = [limit for limit in (size, soft, hard) if limit != resource.RLIM_INFINITY]
    with contextlib.suppress(ValueError, OSError):  # macOS knows the limit, but refuses to set it
        resource.setrlimit(resource.RLIMIT_AS, (min(known), hard))


def one_line(error):
    """The text of an exception on one line of bounded length."""
    text = " ".join(str(error).split()) or type(error).__name__
    return text if len(text) <= _SHORT else text[: _SHORT - 3] + "..."
