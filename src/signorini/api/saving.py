"""Figures, written to files where a program asks for it."""

from pathlib import Path
from typing import TYPE_CHECKING

from signorini.exceptions import SceneError

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def saved(figure: "Figure", path: str | Path | None) -> "Figure":
    """The figure, written where a path is given.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    path : str, Path or None
        Ending in .pdf or .png.

    Returns
    -------
    matplotlib.figure.Figure

    Raises
    ------
    SceneError
        If it is no path, or ends otherwise.

    Examples
    --------
    >>> saved(None, "figure.gif")
    Traceback (most recent call last):
    signorini.exceptions.SceneError: path: 'figure.gif' is no figure; end it in .pdf or .png, or ...
    """
    if path is not None:
        from signorini.figures.style import FORMATS, save_figure

        if not isinstance(path, str | Path):
            raise SceneError(f"path: {path!r:.60} is no path; give the name of a .pdf or .png file")
        if Path(path).suffix not in FORMATS:
            raise SceneError(
                f"path: {Path(path).name!r} is no figure; end it in {' or '.join(FORMATS)}, "
                "or save what is returned, plot().savefig(...)"
            )
        save_figure(figure, path, sealed=False)
    return figure
