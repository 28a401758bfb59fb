"""One thread for linear algebra, as in the jobs; where several workers share the tests, the long
ones first.
"""

import os

import pytest

# On small matrices more threads are no faster but for the clock, and with a worker on each core
# they wait for another.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")


def pytest_collection_modifyitems(config, items):
    """Begin with the files of the workflow, which take longest: the workers then end together."""
    if hasattr(config, "workerinput"):
        items.sort(key=lambda item: "workflow" not in item.path.parts)


@pytest.fixture
def write(tmp_path):
    """Writes a file, of text or bytes, and tells its path."""

    def write(content, name="mesh.msh"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write
