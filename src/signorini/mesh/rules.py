"""From the section ``boundary`` of a scene to the rules that label a mesh's boundary."""

import numpy as np

from signorini.mesh.boundary import by_formula


def boundary_rules(boundary):
    """Rules for `labels.label_boundary`.

    Parameters
    ----------
    boundary : dict
        Name of a part -> label, or label -> formula. The formula "rest" takes the facets that no
        other formula takes.

    Returns
    -------
    dict, or list of pairs (function of (x, y), label)

    Examples
    --------
    >>> boundary_rules({"bottom": "contact", "top": "dirichlet"})
    {'bottom': 'contact', 'top': 'dirichlet'}
    """
    if not by_formula(boundary):
        return boundary
    from signorini.formula import Formula

    formulas = {
        label: Formula(text, f"boundary.{label}")
        for label, text in boundary.items()
        if text != "rest"
    }
    rules = [(formula, label) for label, formula in formulas.items()]
    rest = [label for label, text in boundary.items() if text == "rest"]
    return rules + [(_none_of(formulas.values()), label) for label in rest]


def _none_of(formulas):
    """The function that is positive where no formula is."""

    def positive_elsewhere(x, y):
        taken = np.zeros(np.broadcast(x, y).shape, dtype=bool)
        for formula in formulas:
            taken |= formula(x, y) > 0.0
        return np.where(taken, -1.0, 1.0)

    positive_elsewhere.text = "rest"  # as messages quote it
    return positive_elsewhere
