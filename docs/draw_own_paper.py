"""Draw the first page of an article of one's own, docs/pictures/own_paper.png, for README.md.

    python docs/draw_own_paper.py results/footing/paper.pdf

It takes the PDF that the two lines of README's "Your own paper" build, and needs pdftoppm (Debian:
poppler-utils). White margins are cut.
"""

import argparse
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

PICTURE = Path(__file__).resolve().parent / "pictures/own_paper.png"
RESOLUTION = 80  # pixels per inch
MARGIN = 12  # pixels of white that are left around the text
COLOURS = 16


def main():
    """Draw the picture."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("paper", metavar="PDF")
    paper = parser.parse_args().paper
    with TemporaryDirectory() as folder:
        page = Path(folder, "page")
        options = ["-png", "-singlefile", "-gray", "-r", str(RESOLUTION), paper, str(page)]
        subprocess.run(["pdftoppm", *options], check=True)
        picture = Image.open(page.with_suffix(".png"))
        cut(picture).quantize(COLOURS).save(PICTURE, optimize=True)
    print(PICTURE)


def cut(picture):
    """A page of text without its white margins and its page number."""
    ink = np.asarray(picture.convert("L")) < 128
    ink[int(0.85 * len(ink)) :] = False  # the page number
    rows, columns = (np.flatnonzero(ink.any(axis=axis)) for axis in (1, 0))
    box = (columns[0] - MARGIN, rows[0] - MARGIN, columns[-1] + MARGIN, rows[-1] + MARGIN)
    return picture.crop(tuple(map(int, box)))


if __name__ == "__main__":
    main()
