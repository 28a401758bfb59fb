"""A valid scene as text, and changes of it."""

VALID = """\
title: A test
domain: {kind: rectangle, origin: [0, 0], size: [1, 1], diagonal: falling}
boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}
data: {f: 2*pi*sin(2*pi*x), obstacle: 0}
elements: [P1, CR]
levels: [2, 4, 8]
truth: {kind: reference, element: P1, n: 32}
"""


def changed(old, new=""):
    assert old in VALID
    return VALID.replace(old, new)
