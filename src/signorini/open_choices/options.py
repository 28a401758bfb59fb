"""The options that the paper leaves open.

`OPTIONS` maps the name of each option to its values, the paper's first.
"""

DIAGONALS = ("falling", "rising", "alternating", "alternating-rising", "criss-cross")
LOADS = ("centroid", "midpoints", "vertices", "exact", "nodal")
RULES = ("exact", "midpoints", "centroid", "vertices")
H1 = {"full": "h1", "semi": "h1_semi"}
SLOPES = ("mean", "fit")
OPTIONS = {"diagonal": DIAGONALS, "load": LOADS, "rule": RULES, "h1": tuple(H1), "slope": SLOPES}
PAPER = {name: values[0] for name, values in OPTIONS.items()}


def count_solves(errors):
    """Solves that the rows took, with one of a reference per diagonal and load.

    Examples
    --------
    >>> count_solves([{"diagonal": "rising", "load": "exact", "element": "P1", "n": 2}])
    2
    """
    references = {(row["diagonal"], row["load"]) for row in errors}
    solved = {(row["diagonal"], row["load"], row["element"], row["n"]) for row in errors}
    return len(solved) + len(references)
