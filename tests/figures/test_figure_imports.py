"""What figures may import."""

import re
from pathlib import Path

import pytest

pytest.importorskip("matplotlib")

NAMES = {"signorini.errors.norms", "signorini.fem.element_facts"}  # of what is drawn
ROOM = Path(__file__).parents[2] / "src/signorini/figures"


@pytest.mark.parametrize("path", sorted(ROOM.glob("*.py")), ids=lambda path: path.stem)
def test_a_figure_computes_nothing(path):
    """Neither solutions nor errors: it takes numbers from files and from report."""
    modules = re.findall(r"^ *from (signorini[\w.]*)", path.read_text(encoding="utf-8"), re.M)
    rooms = {module.split(".")[1] for module in set(modules) - NAMES}
    assert rooms <= {"figures", "report", "storage"}
