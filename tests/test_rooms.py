"""The rooms of the library: each imports only from those below it, so that there is no circle."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "src/signorini"
# From the ground floor up; docs/architecture.md says what each is for.
FLOORS = (
    *("exceptions", "wording", "work", "chunks", "memory", "storage"),
    *("formula", "mesh", "fem", "exact", "solvers", "errors", "certificate", "adapt", "scene"),
    *("judge", "generated", "rivals", "open_choices"),
    *("report", "sweeps", "publication", "figures", "api"),
    *("studies", "studies.benchmark", "studies.sensitivity", "studies.stability"),
    *("studies.theory", "studies.adaptive", "studies.guaranteed", "provenance"),
    *("commands", "__main__"),
)


def room_of(parts):
    """The room of a module: of the studies, each is one."""
    if parts[0] == "studies" and len(parts) > 1 and (PACKAGE / "studies" / parts[1]).is_dir():
        return ".".join(parts[:2])
    return parts[0]


def arrows():
    """Room -> the rooms that its modules import from, wherever the import stands."""
    found = {}
    for path in PACKAGE.rglob("*.py"):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        if parts == ("__init__",):  # which gives users all names
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("signorini."):
                other = room_of(node.module.split(".")[1:])
                found.setdefault(room_of(parts), set()).add(other)
    return {room: others - {room} for room, others in found.items()}


ARROWS = arrows()


def test_every_room_has_its_floor():
    there = {
        room_of(path.relative_to(PACKAGE).with_suffix("").parts) for path in PACKAGE.rglob("*.py")
    }
    assert there - {"__init__"} == set(FLOORS)


@pytest.mark.parametrize("room", sorted(ARROWS))
def test_a_room_knows_only_what_is_below_it(room):
    below = set(FLOORS[: FLOORS.index(room)])
    assert sorted(ARROWS[room] - below) == []


def test_a_solver_never_sees_a_scene_and_a_figure_never_solves():
    assert not {"scene", "exact", "errors", "report", "figures"} & ARROWS["solvers"]
    assert not {"solvers", "scene", "exact", "mesh"} & ARROWS["figures"]


def test_a_page_of_the_documentation_tells_every_room():
    page = (PACKAGE.parents[1] / "docs/architecture.md").read_text(encoding="utf-8")
    assert [room for room in FLOORS if f"`{room.replace('.', '/')}" not in page] == []
