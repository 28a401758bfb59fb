"""The section ``boundary`` of a scene: what holds on the parts of the boundary."""

LABELS = ("dirichlet", "contact", "neumann")
SIDES = ("bottom", "right", "top", "left")  # the parts of a rectangle's boundary


def by_formula(boundary):
    """Whether the section ``boundary`` maps labels to formulas, rather than names of parts to
    labels.

    A label is no formula: where every value is one, the keys are names of parts, whatever they
    read.

    Examples
    --------
    >>> by_formula({"contact": "0.5 - y", "neumann": "rest"})
    True
    >>> by_formula({"contact": "contact", "neumann": "dirichlet"})  # groups of a mesh file with such names
    False
    """
    return any(name in LABELS for name in boundary) and not all(
        value in LABELS for value in boundary.values()
    )


def labels_of(boundary):
    """The labels that the section ``boundary`` gives to some part of the boundary, a set."""
    return set(boundary) if by_formula(boundary) else set(boundary.values())
