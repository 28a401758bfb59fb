"""A sweep as a table of LaTeX: a row for each point, the quantities on its finest level."""

import math

from signorini.errors.norms import NORMS
from signorini.report.rounding import MISSING, column
from signorini.report.table_latex import latex
from signorini.report.table_writer import ESCAPES, Column, Group, Table, Title
from signorini.sweeps.curves import LABELS
from signorini.sweeps.finest import finest_rows
from signorini.sweeps.names import QUANTITY

DIGITS = 4  # significant ones of the smallest number of a column
MOST_DECIMALS = 6
SHOWN = ("resultant", "contact_length")  # after the norms and the quantities of the scene


def sweep_table(section, rows, norms, label):
    r"""Return a sweep as a LaTeX ``tabular``, which needs the package booktabs.

    Parameters
    ----------
    section : dict
        The section ``sweep`` of a scene.
    rows : sequence of mapping
        Of sweep.csv, texts or numbers.
    norms : sequence of str
        Those of the scene.
    label : callable
        From the name of an element to what the table calls it.

    Returns
    -------
    str
        A row for each point, with dashes where it failed; what no point has is left out.

    Examples
    --------
    >>> row = {"point": "f=1", "data.f": 1, "element": "CR", "n": 4, "failed": None}
    >>> print(sweep_table({"data.f": [1]}, [row | {"resultant": 0.25}], [], str), end="")
    \begin{tabular}{rr}
    \toprule
     & \multicolumn{1}{c}{contact force in all} \\
    \cmidrule(lr){2-2}
    f & \multicolumn{1}{c}{CR} \\
    \midrule
    1 & 0.2500 \\
    \bottomrule
    \end{tabular}
    """
    finest = {(row["point"], row["element"]): row for row in finest_rows(rows)}
    points = {row["point"]: row for row in rows}
    elements = dict.fromkeys(element for _, element in finest)
    asked = [name for name in rows[0] if name.startswith(QUANTITY)]
    groups = []
    for name in (*norms, *asked, *SHOWN):
        if any(row.get(name) not in (None, "") for row in finest.values()):
            columns = [
                Column(_title(label(element)), _cells(name, element, points, finest))
                for element in elements
            ]
            groups.append(Group(_heading(name), tuple(columns)))
    leading = [
        Column(_title(key.split(".")[-1]), tuple(_tex(row[key]) for row in points.values()))
        for key in section
    ]
    return latex(Table(tuple(leading), tuple(groups), has_foot=False))


def _cells(name, element, points, finest):
    values = [finest.get((point, element), {}).get(name) for point in points]
    return tuple(map(_signed, column(values, _decimals(values), DIGITS)))


def _decimals(values):
    """Digits after the point that give the smallest number enough significant ones."""
    sizes = [abs(float(value)) for value in values if value not in (None, "")]
    least = min((size for size in sizes if size > 0.0), default=1.0)
    return min(max(DIGITS - 1 - math.floor(math.log10(least)), 0), MOST_DECIMALS)


def _signed(cell):
    """A number whose minus sign LaTeX sets as one; those with an exponent are mathematics."""
    return f"${cell}$" if cell.startswith("-") and cell != MISSING and "e" not in cell else cell


def _tex(value):
    """A swept value: a number, or text as it is."""
    try:
        float(value)
    except (TypeError, ValueError):
        return str(value).translate(str.maketrans(ESCAPES))
    return _signed(str(value))


def _title(text):
    return Title(text.translate(str.maketrans(ESCAPES)), text)


def _heading(name):
    if name in NORMS:
        return Title(NORMS[name].heading, NORMS[name].text)
    return _title(LABELS.get(name, name.removeprefix(QUANTITY)))
