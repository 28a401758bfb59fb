"""The options of the choices that the paper leaves unsaid, and what it costs to try them all."""

# The paper's first.
DIAGONALS = ("falling", "rising", "alternating", "alternating-rising", "criss-cross")
LOADS = ("centroid", "midpoints", "vertices", "exact", "nodal")
RULES = ("exact", "midpoints", "centroid", "vertices")
H1 = {"full": "h1", "semi": "h1_semi"}
SLOPES = ("mean", "fit")
CHOICES = {"diagonal": DIAGONALS, "load": LOADS, "rule": RULES, "h1": tuple(H1), "slope": SLOPES}
PAPER = {choice: options[0] for choice, options in CHOICES.items()}

ELEMENTS = ("P1", "CR")


def count_solves(errors):
    """Solves that the rows took: one per diagonal, load, element and level, and a reference per
    diagonal and load.
    """
    references = {(row["diagonal"], row["load"]) for row in errors}
    return len({(row["diagonal"], row["load"], row["element"], row["n"]) for row in errors}) + len(
        references
    )
