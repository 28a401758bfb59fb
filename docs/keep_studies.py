"""Copy what the studies measured (pages, tables, pictures in results/studies) to docs/studies,
where README.md links.

    python docs/keep_studies.py [STUDY ...]

Timings differ from run to run, so this is done by hand (`make studies`) and not checked.
"""

import argparse
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILT, KEPT = ROOT / "results/studies", ROOT / "docs/studies"


def main():
    """Replace the kept files of the studies that have been built, or of those named."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("studies", nargs="*", metavar="STUDY", help="default: all that were built")
    names = parser.parse_args().studies
    pages = {page.parent.name: page for page in sorted(BUILT.glob("*/*.md"))}
    if not pages:
        sys.exit("error: results/studies holds no page; run `make studies`")
    absent = sorted(set(names) - set(pages))
    if absent:
        sys.exit(f"error: not in results/studies: {', '.join(absent)}; there: {', '.join(pages)}")
    for page in (pages[name] for name in names or pages):
        target = KEPT / page.parent.name
        shutil.rmtree(target, ignore_errors=True)
        target.mkdir(parents=True)
        for path in sorted(page.parent.iterdir()):
            if path.suffix in (".md", ".csv", ".png"):
                shutil.copy(path, target)
        print(f"docs/studies/{target.name}: updated")


if __name__ == "__main__":
    main()
