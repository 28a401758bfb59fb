import pytest
from recorded import Recorded


@pytest.fixture
def recorded(tmp_path):
    return Recorded(tmp_path / "project")


@pytest.fixture
def two_jobs(recorded):
    """A table from data, and a picture from the table."""
    recorded.write("data.txt", b"1\n")
    recorded.write("src/code.py", b"pass\n")
    table = {"results/a/table.csv": b"n\n1\n"}
    recorded.job("table", table, ["data.txt", "src/code.py"], start=10)
    picture = {"results/a/picture.png": b"png", "results/a/picture.pdf": b"pdf"}
    recorded.job("draw", picture, ["results/a/table.csv"], start=20, seconds=3)
    return recorded
