"""Random scenes, small and well-posed: strategies of Hypothesis."""

from hypothesis import assume
from hypothesis import strategies as st

from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.fem.problem import discretize
from signorini.generated.statements import by_side
from signorini.mesh.grid import SIDES
from signorini.scene.statement import ProblemStatement

_NUMBERS = st.integers(-99, 99).map(lambda k: k / 10)
_LABELS = st.sampled_from(("contact", "neumann", "dirichlet"))
_DIAGONALS = st.sampled_from(("falling", "rising", "alternating", "criss-cross"))


_FORMULAS = st.sampled_from(
    (
        "{a}",
        "{a} + ({b})*x + ({c})*y",
        "({a})*sin(({b})*x + ({c})*y)",
        "where(x < {b}, {a}, {c})",
    )
)
_QUADRATURES = st.sampled_from(("centroid", "midpoints", "vertices", "exact"))


@st.composite
def formulas(draw):
    """Constants, planes, waves and steps."""
    a, b, c = (draw(_NUMBERS) for _ in range(3))
    return draw(_FORMULAS).format(a=a, b=b, c=c)


@st.composite
def domains(draw):
    """Rectangles of many sizes, places and aspects, in any pattern, sometimes shaken or graded."""
    scale, aspect = 10.0 ** draw(st.integers(-6, 6)), 2.0 ** draw(st.integers(-5, 5))
    domain = {
        "origin": [scale * draw(st.integers(-3, 3)) for _ in range(2)],
        "size": [scale, scale * aspect],
        "diagonal": draw(_DIAGONALS),
        "cells": "per-side",
    }
    if draw(st.booleans()):
        amount, seed = draw(st.integers(1, 9)) / 10, draw(st.integers(0, 99))
        domain["perturb"] = {"amount": amount, "seed": seed}
    if draw(st.booleans()):
        side, exponent = draw(st.sampled_from(SIDES)), draw(st.integers(2, 4)) / 2
        domain["grade"] = {"towards": [side], "exponent": exponent}
    return domain


@st.composite
def problems(draw):
    """Discrete problems with a side in contact, held by another or pressed on it by the load."""
    labels = draw(st.tuples(*[_LABELS] * 4))
    assume("contact" in labels)
    data = {name: draw(formulas()) for name in ("f", "g", "obstacle")}
    if "dirichlet" not in labels:
        data |= {"f": f"-abs({data['f']}) - 1", "g": 0}
    domain = draw(domains())
    # High enough for every obstacle: they meet no Dirichlet value above it at a corner.
    data["dirichlet"] = f"abs({data['obstacle']}) + abs({draw(formulas())})"
    mapping = {"domain": domain, "boundary": by_side(labels), "data": data}
    mapping["load_quadrature"] = draw(_QUADRATURES)
    statement = ProblemStatement.from_mapping(mapping)
    problem = discretize(statement, draw(st.sampled_from(ELEMENT_NAMES)), draw(st.integers(1, 6)))
    assume(problem.contact.size)
    return problem
