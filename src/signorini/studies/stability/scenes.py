"""Random walks over the space of scenes: hypothesis strategies for statements of problems, small
and well-posed.
"""

from hypothesis import assume
from hypothesis import strategies as st

from signorini.fem.problem import discretize
from signorini.mesh.grid import SIDES
from signorini.scene.statement import ProblemStatement

_NUMBERS = st.integers(-99, 99).map(lambda k: k / 10)
_LABELS = st.sampled_from(("contact", "neumann", "dirichlet"))
_DIAGONALS = st.sampled_from(("falling", "rising", "alternating", "criss-cross"))


@st.composite
def formulas(draw):
    """Constants, planes, waves and steps."""
    a, b, c = (draw(_NUMBERS) for _ in range(3))
    kind = draw(
        st.sampled_from(
            (
                "{a}",
                "{a} + ({b})*x + ({c})*y",
                "({a})*sin(({b})*x + ({c})*y)",
                "where(x < {b}, {a}, {c})",
            )
        )
    )
    return kind.format(a=a, b=b, c=c)


@st.composite
def domains(draw):
    """Rectangles of many sizes, places and aspects, cut in any pattern, sometimes shaken or graded."""
    scale, aspect = 10.0 ** draw(st.integers(-6, 6)), 2.0 ** draw(st.integers(-5, 5))
    origin = [scale * draw(st.integers(-3, 3)) for _ in range(2)]
    domain = {
        "origin": origin,
        "size": [scale, scale * aspect],
        "diagonal": draw(_DIAGONALS),
        "cells": "per-side",
    }
    if draw(st.booleans()):
        domain["perturb"] = {
            "amount": draw(st.integers(1, 9)) / 10,
            "seed": draw(st.integers(0, 99)),
        }
    if draw(st.booleans()):
        domain["grade"] = {
            "towards": [draw(st.sampled_from(SIDES))],
            "exponent": draw(st.integers(2, 4)) / 2,
        }
    return domain


@st.composite
def problems(draw):
    """Discrete problems with at least one side in contact, held by another or pressed on it by the
    load.
    """
    labels = draw(st.tuples(*[_LABELS] * 4))
    assume("contact" in labels)
    data = {name: draw(formulas()) for name in ("f", "g", "obstacle")}
    data["f"] = data["f"] if "dirichlet" in labels else f"-abs({data['f']}) - 1"
    data["g"] = data["g"] if "dirichlet" in labels else 0
    statement = ProblemStatement.from_mapping(
        {
            "domain": draw(domains()),
            "boundary": dict(zip(SIDES, labels, strict=True)),
            # High enough for every obstacle, so that they meet no Dirichlet value above it at a
            # corner.
            "data": data | {"dirichlet": f"abs({data['obstacle']}) + abs({draw(formulas())})"},
            "load_quadrature": draw(
                st.sampled_from(("centroid", "midpoints", "vertices", "exact"))
            ),
        }
    )
    problem = discretize(statement, draw(st.sampled_from(("P1", "CR"))), draw(st.integers(1, 6)))
    assume(problem.contact.size)
    return problem
