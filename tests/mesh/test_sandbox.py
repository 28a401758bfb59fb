"""The subprocess sandbox: foreign code that hangs or crashes is a MeshError."""

import time

import numpy as np
import pytest

from mesh_texts import vtu
from signorini.exceptions import MeshError
from signorini.mesh.sandbox import run_in_sandbox

meshio = pytest.importorskip("meshio")


def test_an_endless_loop_of_the_reader_is_cut_off(write):
    """A negative block size makes meshio walk on the spot."""
    data = np.array([-4], dtype="<i4").tobytes() + b"\xff" * 40
    text = vtu(
        "",
        options='header_type="Int32"',
        format="appended",
        appended='<AppendedData encoding="raw">_@</AppendedData>',
    )
    path = write(text.encode().replace(b"@", data + b"\n"), "loop.vtu")
    start = time.perf_counter()
    with pytest.raises(MeshError, match=r"loop\.vtu: not done after 1 s"):
        run_in_sandbox(
            "signorini.mesh.parse:parse",
            str(path),
            memory_limit=2**31,
            timeout=1,
            task=path.name,
        )
    assert time.perf_counter() - start < 20


SANDBOXED = {
    # case: (function, arguments, words of the message)
    "hangs": ("time:sleep", [9], "job: not done after 1 s"),
    "is killed": ("ctypes:string_at", [0], "job: crashed or ran out of memory"),
    "runs out of memory": ("builtins:bytearray", [2**40], "job: crashed or ran out of memory"),
    "returns no arrays": ("builtins:len", [[]], "job: crashed"),
    "leaves": ("sys:exit", [0], "job: crashed"),
}


@pytest.mark.parametrize("case", SANDBOXED)
def test_foreign_code_that_fails_is_a_mesh_error(case):
    function, arguments, words = SANDBOXED[case]
    with pytest.raises(MeshError, match=words):
        run_in_sandbox(
            function,
            *arguments,
            memory_limit=2**31,
            timeout=1 if case == "hangs" else 30,
            task="job",
        )
