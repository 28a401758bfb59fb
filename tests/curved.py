"""Domains with curved sides."""

from signorini.mesh.domain import make_domain

SQUARE = [[1, 0], [0, 1], [-1, 0], [0, -1]]
UNIT = {"center": [0, 0], "radius": 1}
INNER = {"center": [0, 0], "radius": 0.5}


def ring(coarsest=4, rim=UNIT, hole=INNER, boundary=None):
    """The ring 1/2 < r < 1; without curves, the polygon that it is cut from at the coarsest
    level.
    """
    section = {
        "kind": "polygon",
        "corners": SQUARE,
        "holes": [[[0.5 * x, 0.5 * y] for x, y in SQUARE]],
        "sides": ["rim"] * 4,
        "boundary_shape": {"rim": rim, "hole-0": hole},
    }
    return make_domain(section, boundary or {"rim": "contact", "hole-0": "dirichlet"}, coarsest)


def disc(coarsest=2, shape="x**2 + y**2 - 1", boundary=None):
    """The unit disc."""
    section = {
        "kind": "polygon",
        "corners": SQUARE,
        "holes": [],
        "sides": ["upper", "upper", "lower", "lower"],
        "boundary_shape": {"upper": shape, "lower": shape},
    }
    return make_domain(section, boundary or {"upper": "dirichlet", "lower": "contact"}, coarsest)
