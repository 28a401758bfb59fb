"""The section ``boundary`` of a scene: what holds on the parts of the boundary."""

import re

LABELS = ("dirichlet", "contact", "neumann")
PART = "part "  # before the name of a part, where it stands beside labels
SIDES = ("bottom", "right", "top", "left")  # the parts of a rectangle's boundary


def by_formula(boundary):
    """Whether the section ``boundary`` maps labels to formulas, not names of parts to labels.

    A label is no formula: where every value is a label, the keys are names of parts, whatever
    they read.

    Examples
    --------
    >>> by_formula({"contact": "0.5 - y", "neumann": "rest"})
    True

    A mesh file may have groups that are named as labels are:

    >>> by_formula({"contact": "contact", "neumann": "dirichlet"})
    False
    """
    some_key_is_a_label = any(name in LABELS for name in boundary)
    every_value_is_a_label = all(value in LABELS for value in boundary.values())
    return some_key_is_a_label and not every_value_is_a_label


def part_key(name):
    """What stands for a named part of the boundary wherever a label can.

    Examples
    --------
    >>> part_key("contact")  # a part of this name need not carry the label
    'part contact'
    """
    return f"{PART}{name}"


def labels_of(boundary):
    """The set of labels that the section ``boundary`` gives to some part of the boundary.

    Examples
    --------
    >>> labels_of({"bottom": "contact", "left": "contact"})
    {'contact'}
    """
    return set(boundary) if by_formula(boundary) else set(boundary.values())


_NUMBERED = re.compile(r"side-[0-9]+")


def offered(parts):
    """The parts that messages name: sides of a polygon by number only where they have no names.

    Parameters
    ----------
    parts : iterable of str
        All that are known, in the order in which a polygon has them.

    Returns
    -------
    list of str

    Examples
    --------
    >>> offered(["side-0", "floor", "side-1", "wall", "hole-0"])
    ['floor', 'wall', 'hole-0']
    >>> offered(["side-0", "side-1", "hole-0"])
    ['side-0', 'side-1', 'hole-0']
    """
    parts = list(parts)
    second = parts[1] if len(parts) > 1 and parts[0] == "side-0" else "side-1"
    if _NUMBERED.fullmatch(second) or second.startswith("hole-"):
        return parts
    return [part for part in parts if not _NUMBERED.fullmatch(part)]
