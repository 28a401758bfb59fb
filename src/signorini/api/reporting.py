"""Errors over levels as a table for an article, and as a figure."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from signorini.api.convergence import error_rows
from signorini.api.saving import saved
from signorini.errors.norms import DOMAIN, RATED
from signorini.exceptions import SignoriniError
from signorini.wording import nearest

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame


def latex_table(
    errors: "DataFrame",
    norms: Sequence[str] | None = None,
    *,
    rates: bool = True,
    slopes: bool = False,
    notation: str = "scientific",
    digits: int = 3,
    labels: str = "name",
) -> str:
    r"""Errors as a table of LaTeX.

    Parameters
    ----------
    errors : pandas.DataFrame
        Of `convergence`, or read from errors.csv.
    norms : sequence of str, optional
        The columns, in this order; by default those of l2, h1_semi, h1 and energy that it has.
    rates : bool, optional
        Whether each error has the rate from the level before beside it.
    slopes : bool, optional
        Whether the last row holds the mean slopes.
    notation : {"scientific", "fixed", "auto"}, optional
        ``fixed`` has `digits` decimals; ``auto`` is fixed or scientific by size.
    digits : int, optional
        Significant digits, or decimals of a fixed number.
    labels : {"name", "abbreviation"}, optional
        What an element is called: P1 and CR, or CF and NCF.

    Returns
    -------
    str
        A ``tabular``, which needs the package booktabs.

    Raises
    ------
    SignoriniError
        Naming the argument, its value and the remedy.

    Examples
    --------
    >>> import signorini
    >>> def problem(n):
    ...     sides = {"dirichlet": ["right", "top", "left"], "contact": "bottom"}
    ...     return signorini.problem(signorini.rectangle(n), "P1", exact="smooth", **sides)
    >>> errors = signorini.convergence(problem, [8, 16, 32], "smooth")
    >>> print(signorini.latex_table(errors, ["l2"]), end="")
    \begin{tabular}{rrr}
    \toprule
     & \multicolumn{2}{c}{$L^2$ error} \\
    \cmidrule(lr){2-3}
    $N$ & \multicolumn{1}{c}{P1} & \multicolumn{1}{c}{rate} \\
    \midrule
    8 & $1.30\times10^{-2}$ & -- \\
    16 & $3.27\times10^{-3}$ & 1.99 \\
    32 & $8.17\times10^{-4}$ & 2.00 \\
    \bottomrule
    \end{tabular}
    """
    from signorini.errors.rates import rate_rows
    from signorini.report.tables import error_table

    _check_word("notation", notation, ("scientific", "fixed", "auto"))
    _check_word("labels", labels, ("name", "abbreviation"))
    rows = error_rows(errors)
    found = rate_rows(rows) if slopes else []
    form: dict[str, Any] = {"norms": _norms(rows, norms), "elements": _elements(rows)}
    form |= {"rates": rates, "slopes": slopes, "notation": notation, "labels": labels}
    try:
        return str(error_table(rows, found, decimals=digits, digits=digits, **form))
    except ValueError as error:
        raise SignoriniError(f"errors: {error}") from None


def plot_errors(errors: "DataFrame", norm: str = "l2", path: str | Path | None = None) -> "Figure":
    """Draw the errors in one norm against the mesh width, both axes logarithmic.

    Parameters
    ----------
    errors : pandas.DataFrame
        Of `convergence`, or read from errors.csv; two levels at least.
    norm : str, optional
        One of its columns.
    path : str or Path, optional
        Where to write the figure, .pdf or .png.

    Returns
    -------
    matplotlib.figure.Figure
        The legend names the mean slopes; a triangle shows them.

    Raises
    ------
    SignoriniError
        Naming the argument, its value and the remedy.

    Examples
    --------
    >>> import pandas as pd
    >>> levels = {"element": "P1", "n": [2, 4], "h": [0.5, 0.25], "l2": [4.0, 1.0], "floor": ""}
    >>> figure = plot_errors(pd.DataFrame(levels))
    >>> [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    ['CF (P1), slope 2.00']
    """
    from signorini.errors.rates import rate_rows
    from signorini.figures.convergence import draw_convergence
    from signorini.report.slopes import slopes_of

    rows = error_rows(errors)
    (norm,) = _norms(rows, [norm])
    _elements(rows)
    slopes = slopes_of(rate_rows(rows), norm, "mean")
    return saved(draw_convergence(rows, norm, slopes, fitted=True), path)


def _norms(rows: list[dict[str, Any]], norms: Sequence[str] | None) -> list[str]:
    """The norms that are asked for, all of which the table has."""
    there = [norm for norm in RATED if any(row.get(norm) is not None for row in rows)]
    asked = [norms] if isinstance(norms, str) else norms
    for norm in asked or ():
        _check_word("norms", norm, there)
    return list(asked or [norm for norm in DOMAIN if norm in there])


def _elements(rows: list[dict[str, Any]]) -> list[str]:
    """The elements, in the order of the rows."""
    from signorini.fem.element_facts import ELEMENT_NAMES

    found = list(dict.fromkeys(row["element"] for row in rows))
    for element in found:
        _check_word("errors: element", element, ELEMENT_NAMES)
    return found


def _check_word(field: str, word: Any, known: Sequence[str]) -> None:
    if word not in known:
        raise SignoriniError(f"{field}: {word!r} is not there; {nearest(str(word), known)}")
