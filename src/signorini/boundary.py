"""The section ``boundary`` of a scene: what holds on the parts of the boundary."""

LABELS = ("dirichlet", "contact", "neumann")
SIDES = ("bottom", "right", "top", "left")  # the parts of a rectangle's boundary


def by_formula(boundary):
    """Whether the section ``boundary`` maps labels to formulas, rather than names of parts to labels."""
    return any(name in LABELS for name in boundary)
