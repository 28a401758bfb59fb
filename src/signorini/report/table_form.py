"""What a table shows of the errors, and how: the section ``table`` of a scene."""

from dataclasses import dataclass

from signorini.errors.norms import NORMS, PAPER_NORMS
from signorini.fem.element_facts import ABBREVIATIONS, ELEMENT_NAMES

LEADING, UNKNOWNS = ("n", "h"), "unknowns"  # columns besides the norms


@dataclass(frozen=True)
class TableForm:
    """What a table shows, and how.

    Parameters
    ----------
    norms, elements : sequence of str, optional
        The columns, and their order.
    levels : sequence of int, optional
        The rows; all that there are where it is None.
    columns : sequence of str, optional
        What stands before the norms: ``n``, ``h``, ``unknowns``. Where it is None, n, and h where
        that is not 1/n, as on a mesh from a file.
    rates : bool, optional
        Whether each error has its rate from the level before beside it.
    slopes : bool, optional
        Whether the last row holds average slopes.
    kind : {"mean", "fit"}, optional
        Which ones.
    decimals, digits : int, optional
        Decimals of a fixed number; significant digits of one with an exponent.
    notation : {"auto", "fixed", "scientific"}, optional
        Of errors. By default a column with a value below 1e-5, or from 1e4 on, has exponents.
    labels : {"abbreviation", "name"}, optional
        What an element is called: CF and NCF, or P1 and CR.
    side_by_side : int, optional
        Norms beside each other, before the table goes on below; where it is None, as many as the
        lines of the article hold.
    note : str, optional
        One more note under the table, for instance `rates.reference_note`.

    Raises
    ------
    ValueError
        If a norm or an element is unknown.
    """

    norms: tuple = PAPER_NORMS
    elements: tuple = ELEMENT_NAMES
    levels: tuple | None = None
    columns: tuple | None = None
    rates: bool = False
    slopes: bool = True
    kind: str = "mean"
    decimals: int = 8
    digits: int = 5
    notation: str = "auto"
    labels: str = "abbreviation"
    side_by_side: int | None = None
    note: str | None = None

    def __post_init__(self):
        for what, names, known in (
            ("norm", self.norms, NORMS),
            ("element", self.elements, ELEMENT_NAMES),
        ):
            for name in names:
                if name not in known:
                    raise ValueError(f"unknown {what} {name!r}; known: {', '.join(known)}")

    def label(self, element):
        """What an element is called.

        Examples
        --------
        >>> TableForm().label("CR"), TableForm(labels="name").label("CR")
        ('NCF', 'CR')
        """
        return ABBREVIATIONS[element] if self.labels == "abbreviation" else element


def form_of(scene):
    """The form of a scene's table.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    TableForm
    """
    document = scene.document
    asked = {"norms": document["norms"], "elements": scene.elements} | document["table"]
    return TableForm(kind=document["slope"], note=scene.reference_note or "", **asked)
