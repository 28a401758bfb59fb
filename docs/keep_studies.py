"""Copy what the studies measured (pages, tables, pictures in results/studies) to docs/studies,
where README.md links.

    python docs/keep_studies.py

Timings differ from run to run, so this is done by hand (`make studies`) and not checked.
"""

import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILT, KEPT = ROOT / "results/studies", ROOT / "docs/studies"


def main():
    """Replace the kept files of every study that has been built."""
    pages = sorted(BUILT.glob("*/*.md"))
    if not pages:
        sys.exit("error: results/studies holds no page; run `make studies`")
    for page in pages:
        target = KEPT / page.parent.name
        shutil.rmtree(target, ignore_errors=True)
        target.mkdir(parents=True)
        for path in sorted(page.parent.iterdir()):
            if path.suffix in (".md", ".csv", ".png"):
                shutil.copy(path, target)
        print(f"docs/studies/{target.name}: updated")


if __name__ == "__main__":
    main()
