"""How every figure looks, and how it is written to a file."""

import io
import logging
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from signorini.figures.readable import readable_text
from signorini.storage import replacing, sealing

MM = 1 / 25.4  # inches
TEXT_WIDTH = 150 / 25.4  # inches; \textwidth of paper/main.tex: figures are included unscaled

BLACK, GREY, FAINT = "black", "0.35", "0.75"
ACCENT = "#2a6ebb"  # prints as a middle grey

# How each element is drawn; what a legend calls it is `fem.element_facts.ElementFacts.label`.
ELEMENT_STYLES = {
    "P1": {"color": BLACK, "marker": "o", "markerfacecolor": "white", "linestyle": "-"},
    "CR": {"color": ACCENT, "marker": "s", "linestyle": (0, (4, 2))},
}

# The marker of a critical point.
CRITICAL = {
    "markerfacecolor": "white",
    "markeredgecolor": BLACK,
    "markersize": 5.5,
    "linestyle": "none",
}

STYLE = {
    "font.family": "serif",
    "font.serif": ["cmr10"],
    "mathtext.fontset": "cm",
    "axes.formatter.use_mathtext": True,  # cmr10 has no minus sign
    "axes.unicode_minus": False,
    "font.size": 9,
    "axes.labelsize": 9,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "axes.linewidth": 0.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "ytick.minor.width": 0.3,
    "ytick.minor.size": 1.5,
    "lines.linewidth": 1.0,
    "lines.markersize": 4.5,
    "pdf.fonttype": 42,
    "savefig.dpi": 200,
}

logging.getLogger("fontTools").setLevel(logging.ERROR)  # it warns of the age of cmr10

_NOTEBOOK_DPI = 120
FORMATS = {".pdf": {"CreationDate": None}, ".png": {}}


class StyledFigure(Figure):
    """A figure in the house style, whoever draws it: a program that saves it, a notebook.

    Matplotlib reads some of a style, such as the font of mathematics, when it draws.

    Examples
    --------
    >>> StyledFigure(figsize=(1, 1))._repr_png_()[1:4]
    b'PNG'
    """

    def draw(self, renderer):
        """Draw, as `matplotlib.figure.Figure.draw`."""
        with matplotlib.rc_context(STYLE):
            super().draw(renderer)

    def savefig(self, fname, **options):
        """Write to a file of any format, as `matplotlib.figure.Figure.savefig`."""
        with matplotlib.rc_context(STYLE), readable_text():
            super().savefig(fname, **options)

    def _repr_png_(self):
        """What a notebook shows, with or without pyplot."""
        stream = io.BytesIO()
        self.savefig(stream, format="png", dpi=_NOTEBOOK_DPI)
        return stream.getvalue()


def new_figure(width, height):
    """Return an empty figure of `width` times `height` inches in the house style.

    Parameters
    ----------
    width, height : float
        Size in inches.

    Returns
    -------
    StyledFigure

    Examples
    --------
    >>> figure = new_figure(TEXT_WIDTH, 50 * MM)
    >>> [round(float(size), 2) for size in figure.get_size_inches()]
    [5.91, 1.97]
    """
    with matplotlib.rc_context(STYLE):
        return StyledFigure(figsize=(width, height), layout="none")


def add_axes(figure, left, bottom, width, height, **options):
    """Add axes at a place given in inches.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    left, bottom : float
        Lower left corner, from that of the figure, in inches.
    width, height : float
        In inches.
    **options
        As for `matplotlib.figure.Figure.add_axes`.

    Returns
    -------
    matplotlib.axes.Axes

    Examples
    --------
    >>> figure = new_figure(100 * MM, 50 * MM)
    >>> axes = add_axes(figure, 10 * MM, 10 * MM, 80 * MM, 30 * MM)
    >>> [round(float(part), 2) for part in axes.get_position().bounds]
    [0.1, 0.2, 0.8, 0.6]
    """
    page_width, page_height = figure.get_size_inches()
    place = (left / page_width, bottom / page_height, width / page_width, height / page_height)
    return figure.add_axes(place, **options)


def save_figure(figure, path, colours=None, sealed=True):
    """Write a figure as PDF or PNG (200 dpi): same figure, same bytes; never half a file.

    Parameters
    ----------
    figure : StyledFigure
        What to write.
    path : path-like
        Target, ending in ``.pdf`` or ``.png``; replaced in one step if it exists.
    colours : int, optional
        At most 256: a PNG keeps so many of its colours, the most frequent, and the others become
        the nearest of these. For pictures with large areas of few colours, a third of the size.
    sealed : bool, optional
        Whether its digest is kept in a hidden file beside it, as of every result.

    Raises
    ------
    ValueError
        If the suffix is neither of the two.
    StorageError
        If the file cannot be written; the old one is then as it was.

    Examples
    --------
    >>> import tempfile
    >>> figure = new_figure(100 * MM, 50 * MM)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_figure(figure, f"{folder}/empty.pdf")
    ...     Path(folder, "empty.pdf").is_file()
    True
    """
    path = Path(path)
    if path.suffix not in FORMATS:
        raise ValueError(f"{path.name}: unknown figure format; known: {', '.join(FORMATS)}")
    write = sealing if sealed else replacing
    with write(path, "wb") as stream:
        if colours and path.suffix == ".png":
            _save_reduced(figure, stream, colours)
        else:
            figure.savefig(stream, format=path.suffix[1:], metadata=FORMATS[path.suffix])


def reduced_png(figure, colours):
    """A figure as PNG within memory, for a page that holds its pictures.

    Parameters
    ----------
    figure : StyledFigure
    colours : int
        At most 256: the most frequent of its colours, which the others become.

    Returns
    -------
    bytes
        The same for the same figure.

    Examples
    --------
    >>> reduced_png(new_figure(10 * MM, 5 * MM), 4)[1:4]
    b'PNG'
    """
    stream = io.BytesIO()
    _save_reduced(figure, stream, colours)
    return stream.getvalue()


def _save_reduced(figure, stream, colours):
    from PIL import Image

    pixels = _pixels(figure)
    shades, place, count = np.unique(
        pixels.reshape(-1, 3), axis=0, return_inverse=True, return_counts=True
    )
    most_frequent_first = np.argsort(-count, kind="stable")
    palette = shades[most_frequent_first[:colours]]
    distances = ((shades[:, None] - palette) ** 2).sum(axis=2)
    nearest = distances.argmin(axis=1).astype(np.uint8)
    reduced = Image.fromarray(nearest[place.ravel()].reshape(pixels.shape[:2]))
    reduced.putpalette(palette.astype(np.uint8).tobytes())
    reduced.save(stream, format="png", optimize=True)


def _pixels(figure):
    """Red, green and blue, shape (rows, columns, 3), each from 0 to 255."""
    from PIL import Image

    picture = io.BytesIO()
    figure.savefig(picture, format="png")
    return np.asarray(Image.open(picture).convert("RGB"), dtype=int)
