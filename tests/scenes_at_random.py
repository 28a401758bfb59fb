"""Random scenes for property tests: mostly sensible, some not, some absurd."""

from hypothesis import strategies as st

LABELS = ("dirichlet", "contact", "neumann")
SIDES = ("bottom", "right", "top", "left")

NUMBERS = st.one_of(
    st.sampled_from(["0", "1", "-1", "0.5", "2", "pi", "1e-3", "7.25"]),
    st.floats(-10, 10, allow_nan=False).map(repr),
    st.sampled_from(["1e-300", "1e300", "1e-12", "1e12", "5e-324"]),
)
ATOMS = st.one_of(st.sampled_from(["x", "y", "x", "y", "r", "theta", "e"]), NUMBERS)
FORMULAS = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        st.builds("({} {} {})".format, inner, st.sampled_from("+-*/"), inner),
        st.builds("({})**{}".format, inner, st.sampled_from(["2", "3", "-1", "0.5", "(1/3)"])),
        st.builds(
            "{}({})".format,
            st.sampled_from(["sin", "cos", "exp", "log", "sqrt", "tanh", "pos", "abs"]),
            inner,
        ),
        st.builds("where({} < {}, {}, {})".format, inner, inner, inner, inner),
        st.builds(
            "{}({}, {})".format, st.sampled_from(["min", "max", "hypot", "atan2"]), inner, inner
        ),
    ),
    max_leaves=5,
)
NONSENSE = st.sampled_from(
    ["sinn(x)", "x^2", "2x", "1/0", "x <", "__import__('os')", "log(-1)", "", "1/(x - x)"]
)
SMOOTH = st.builds(
    "{}*sin({}*x + {}*y) + {}".format,
    *[st.floats(-8, 8, allow_nan=False).map("({:.3g})".format)] * 4,
)
DATA = st.one_of(SMOOTH, SMOOTH, NUMBERS, FORMULAS, st.floats(-9, 9))
COEFFICIENTS = st.one_of(
    st.just(1),
    st.floats(1e-6, 1e6),
    st.builds(
        "where(x < {:.3g}, {:.3g}, {:.3g})".format,
        st.floats(-1, 1),
        st.floats(1e-6, 9),
        st.floats(1e-3, 1e6),
    ),
    st.builds("1 + ({})**2".format, FORMULAS),
    DATA,
)

COORDINATES = st.sampled_from([0, 0, 0, -1, 1, 0.1, 1e4, -1e6, 1e-9, 1e14])
LENGTHS = st.one_of(
    st.sampled_from([1, 1, 1, 2, 0.3, 1e-9, 1e9, 1e-2, 1e-6, -1]), st.floats(1e-3, 1e3)
)
RECTANGLES = st.fixed_dictionaries(
    {"kind": st.just("rectangle")},
    optional={
        "origin": st.tuples(COORDINATES, COORDINATES).map(list),
        "size": st.tuples(LENGTHS, LENGTHS).map(list),
        "diagonal": st.sampled_from(["falling", "rising", "alternating", "criss-cross"]),
        "cells": st.sampled_from(["per-side", "per-side", "per-side", "per-unit"]),
        "perturb": st.just({"amount": 0.3, "seed": 1}),
        "grade": st.just({"towards": ["bottom", "left"], "exponent": 2}),
    },
)
CORNERS = st.one_of(
    st.sampled_from([
        [[0, 0], [1, 0], [0, 1]],
        [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]],
        [[0, 0], [0, 1], [1, 1], [1, 0]],
        [[0, 0], [3, 0], [3, 1e-3], [0, 1e-3]],
    ]),
    st.permutations([[0, 0], [3, 1], [2, 3], [-1, 2], [1, -2]]).map(lambda corners: corners[:4]),
)  # fmt: skip
POLYGONS = st.fixed_dictionaries(
    {"kind": st.just("polygon"), "corners": CORNERS},
    optional={"holes": st.sampled_from([[], [[[0.2, 0.2], [0.4, 0.2], [0.2, 0.4]]]])},
)


@st.composite
def boundaries(draw, domain):
    if draw(st.integers(0, 9)) == 7:
        conditions = st.one_of(FORMULAS, st.just("rest"), st.just("0.1 - y"), NONSENSE)
        return draw(st.dictionaries(st.sampled_from(LABELS), conditions, min_size=1))
    count = len(domain.get("corners", []))
    names = [f"side-{k}" for k in range(count)] + ["hole-0"] * len(domain.get("holes", [])) or list(
        SIDES
    )
    if draw(st.booleans()):
        labels = ["contact", "dirichlet", *["neumann"] * len(names)][: len(names)]
    else:
        labels = [draw(st.sampled_from(LABELS)) for _ in names]
    parts = dict(zip(names, labels, strict=True))
    if draw(st.integers(0, 19)) == 13:
        parts.pop(draw(st.sampled_from(names)))
    return parts


@st.composite
def scenes(draw):
    """A scene's document, with the level and the element to solve for."""
    domain = draw(st.one_of(RECTANGLES, RECTANGLES, RECTANGLES, POLYGONS))
    data = {"f": draw(DATA)}
    if draw(st.integers(0, 9)) == 7:
        data["f"] = draw(NONSENSE)
    names = ("g", "dirichlet", "obstacle", "contact_flux")
    data |= draw(st.fixed_dictionaries({}, optional=dict.fromkeys(names, DATA)))
    if draw(st.integers(0, 3)) == 2:
        data["coefficient"] = draw(COEFFICIENTS)
    polygon = domain["kind"] == "polygon"
    n = draw(st.sampled_from([1, 2, 3] if polygon else [1, 2, 3, 5, 8]))
    return {
        "domain": domain,
        "boundary": draw(boundaries(domain)),
        "constraint": draw(st.sampled_from(["lower", "lower", "upper"])),
        "data": data,
        "levels": [n],
        "load_quadrature": draw(st.sampled_from(["centroid", "exact", "vertices", 3])),
    }


MOVES = st.one_of(
    st.tuples(st.just("move"), st.integers(0, 15), st.floats(-0.5, 3.5), st.floats(-0.5, 3.5)),
    st.tuples(
        st.just("move"),
        st.integers(0, 15),
        st.sampled_from([float("nan"), 1e300, 0.0]),
        st.just(1.0),
    ),
    st.tuples(st.just("renumber"), st.integers(0, 17), st.integers(0, 2), st.integers(0, 17)),
    st.tuples(st.just("drop"), st.integers(0, 17)),
    st.tuples(st.just("turn"), st.integers(0, 17)),
    st.tuples(st.just("copy"), st.integers(0, 17)),
    st.tuples(st.just("scale"), st.sampled_from([1e-9, 1e9, 1e-200]), st.sampled_from([1.0, 1e-3])),
    st.tuples(st.just("shift"), st.sampled_from([1e4, -1e6, 1e15])),
)


def changed_mesh(p, t, moves):
    """Vertices (nv, 2) and triangles (nt, 3), as lists, after some changes of theirs."""
    p, t = [list(point) for point in p], [list(triangle) for triangle in t]
    for kind, *how in moves:
        if kind == "scale":
            p = [[how[0] * x, how[0] * how[1] * y] for x, y in p]
        elif kind == "shift":
            p = [[x + how[0], y] for x, y in p]
        elif kind == "move":
            p[how[0] % len(p)] = how[1:]
        elif kind == "renumber":
            t[how[0] % len(t)][how[1]] = how[2]
        elif kind == "turn":
            t[how[0] % len(t)].reverse()
        elif kind == "copy":
            t.append(t[how[0] % len(t)])
        elif len(t) > 1:
            del t[how[0] % len(t)]
    return p, t
