"""Counts of work and bytes per unknown of all scenes, elements and routes, against the record.

    python benchmarks/counts.py           # what has changed by more than a tenth
    python benchmarks/counts.py --write   # write tests/data/counts.csv anew

`pytest` fails where a count has grown by more than a tenth. Where that is on purpose, or a count
has fallen and should not rise again, write the record anew and commit it with the reason.
"""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RECORD = ROOT / "tests/data/counts.csv"
sys.path.insert(0, str(ROOT / "src"))

import signorini  # noqa: E402 (needs the path above)
from signorini.storage import read_table, write_csv  # noqa: E402
from solve_counts import changes, count_scene  # noqa: E402


def main():
    """Count, and compare or write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--write", action="store_true")
    write = parser.parse_args().write
    scenes = [
        signorini.load_scene(path) for path in sorted((ROOT / "config/scenes").glob("*.yaml"))
    ]
    found = [
        row for scene in scenes for element in scene.elements for row in count_scene(scene, element)
    ]
    grown, shrunk = changes(read_table(RECORD) if RECORD.is_file() else [], found)
    for title, lines in (("grown:", grown), ("shrunk:", shrunk)):
        print("\n  ".join([title, *(lines or ["none"])]))
    if write:
        write_csv(RECORD, found)
        print(f"{RECORD.relative_to(ROOT)}: {len(found)} rows written")


if __name__ == "__main__":
    main()
