"""Checks of what holds on the boundary: labels of its parts, or formulas of the labels."""

from signorini.exceptions import SceneError
from signorini.formula import Formula
from signorini.mesh.boundary import LABELS, by_formula
from signorini.wording import nearest, shown


def check_boundary(boundary, names):
    """Check the section ``boundary``.

    Parameters
    ----------
    boundary : dict
    names : sequence of str or None
        Of the parts that there are; None where only the mesh file knows them.

    Raises
    ------
    SceneError, FormulaError
        Naming the part or the label, its value and the remedy.

    Examples
    --------
    >>> check_boundary({"bottom": "contact", "top": "dirichlet"}, ("bottom", "top"))
    >>> check_boundary({"bottom": "contakt", "top": "dirichlet"}, ("bottom", "top"))
    Traceback (most recent call last):
    signorini.exceptions.SceneError: boundary.bottom: "contakt" is not valid; did you mean ...
    """
    if by_formula(boundary):
        _check_formulas(boundary)
    else:
        _check_labels(boundary, names)


def _check_labels(boundary, names):
    """Part of the boundary -> its label."""
    for name, label in boundary.items():
        if names is not None and name not in names:
            raise SceneError(
                f"boundary.{name}: unknown key, the domain has no such part; {nearest(name, names)}"
            )
        if label not in LABELS:
            raise SceneError(
                f"boundary.{name}: {shown(label)} is not valid; {nearest(label, LABELS)}"
            )
    missing = [name for name in names or () if name not in boundary]
    if missing:
        raise SceneError(
            f"boundary.{missing[0]}: missing; add it with one of the labels {', '.join(LABELS)}"
        )


def _check_formulas(boundary):
    """Label -> the formula that says where it is."""
    if any(name in LABELS and label in LABELS for name, label in boundary.items()):
        _refuse_misspelt_label(boundary)
    for label, text in boundary.items():
        if label not in LABELS:
            raise SceneError(
                f"boundary.{label}: no label; either every key is one of {', '.join(LABELS)} "
                "and has a formula, or every key names a part of the boundary"
            )
        if text != "rest":
            Formula(text, f"boundary.{label}")
    rest = [label for label, text in boundary.items() if text == "rest"]
    if len(rest) > 1:
        raise SceneError(
            f"boundary: {' and '.join(rest)} are both rest; one label at most can take what is left"
        )


def _refuse_misspelt_label(boundary):
    """Parts with the names of labels: one value is meant to be a label, but is none."""
    name, label = next(item for item in boundary.items() if item[1] not in LABELS)
    raise SceneError(
        f"boundary.{name}: {shown(label)} is no label, but other values are; "
        f"{nearest(label, LABELS)}; or, if no part of the boundary has a label for its name, "
        "give every label a formula"
    )
