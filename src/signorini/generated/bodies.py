"""Families of bodies: meshes of a rectangle with labels, some with a diffusion coefficient."""

from dataclasses import replace

import numpy as np

from signorini.generated.statements import LABELS, by_side, grid
from signorini.mesh.domain import Rectangle
from signorini.mesh.labels import labelled
from signorini.mesh.named_mesh import NamedMesh, with_sides
from signorini.mesh.patterns import criss_cross, perturbed

# What holds on the bottom, right, top and left side.
BOUNDARIES = (
    LABELS,
    ("contact", "dirichlet", "dirichlet", "dirichlet"),
    ("contact", "contact", "dirichlet", "neumann"),
)
_FEWEST, _MOST = 4, 16  # cells along a side


# Families: (rng, labels) to a mesh of a rectangle of width 1, or to such a mesh and a formula of a
# coefficient.


def _cells(rng):
    return (int(n) for n in rng.integers(_FEWEST, _MOST + 1, 2))


def _right(rng, labels):
    return grid(*_cells(rng), labels)


def _rising(rng, labels):
    return grid(*_cells(rng), labels, "rising")


def _criss_cross(rng, labels):
    cells = [max(n // 2, 3) for n in _cells(rng)]
    return with_labels(criss_cross(*cells, (0.0, 0.0), (1.0, 1.0)), labels)


def _delaunay(rng, labels):
    from scipy.spatial import Delaunay

    inner, side = int(rng.integers(20, 120)), int(rng.integers(3, 10))
    s, zero = rng.uniform(0.02, 0.98, (4, side)), np.zeros(side)
    edges = [[s[0], zero], [zero + 1, s[1]], [s[2], zero + 1], [zero, s[3]]]
    p = np.hstack([[[0, 1, 1, 0], [0, 0, 1, 1]], *edges, rng.uniform(0.05, 0.95, (2, inner))])
    t = Delaunay(p.T).simplices.T
    a, b, c = (p[:, v] for v in t)
    doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    turned = np.where(doubled > 0, t, t[[0, 2, 1]])
    t = turned[:, np.abs(doubled) > 1e-12]  # three points of one side have no area
    return with_labels(with_sides(NamedMesh(p, t)), labels)


def _perturbed(rng, labels):
    return with_labels(_shaken(rng), labels)


def pressed_flat(n, aspect, seed):
    """Shake a grid of the unit square and press it flat.

    Parameters
    ----------
    n : int
        Cells along a side.
    aspect : float
        Height of the rectangle of width 1.
    seed : int

    Returns
    -------
    NamedMesh

    Examples
    --------
    >>> mesh = pressed_flat(4, 0.1, seed=0)
    >>> float(mesh.p[1].max())
    0.1
    """
    return _flat(perturbed(_named(grid(n, n)), 0.9, seed), aspect)


def _stretched(rng, labels):
    """Shaken grids pressed flat, to aspects down to 1e-6."""
    return with_labels(_flat(_shaken(rng), 10.0 ** -rng.uniform(0, 6)), labels)


def _needles(rng, labels):
    """Vertices moved along x by up to 0.45 of a cell, then pressed flat: angles near 180."""
    mesh = _grid(rng)
    x, y = mesh.p
    inside = (x > 0) & (x < 1)
    width = np.diff(np.unique(x))[0]
    moved = np.where(inside, x + rng.uniform(-0.45, 0.45, x.size) * width, x)
    flat = _flat(replace(mesh, p=np.stack([moved, y])), 10.0 ** -rng.uniform(1, 3))
    return with_labels(flat, labels)


def _grid(rng):
    return _named(grid(*_cells(rng)))


def _named(mesh):
    return with_sides(NamedMesh(mesh.p, mesh.t))


def _shaken(rng):
    return perturbed(_grid(rng), 0.9, int(rng.integers(2**31)))


def _flat(mesh, aspect):
    return replace(mesh, p=mesh.p * [[1.0], [aspect]])


def with_labels(mesh, labels):
    """Say what holds on the sides of a mesh.

    Parameters
    ----------
    mesh : NamedMesh
        Of a rectangle, with its sides named.
    labels : sequence of str
        In the order of `SIDES`.

    Returns
    -------
    Triangulation
    """
    return labelled(mesh, by_side(labels))


def _graded(rng, labels):
    """Cells drawn towards a side or a corner, with exponents from 2 to 10.

    Neighbours are up to 1e15 times as thin. Sides that cells are drawn to lie on the axes, where
    coordinates resolve them.
    """
    sides = (("bottom",), ("bottom", "left"), ("bottom", "right"))
    sides += (("left",), ("right",), ("right", "top"))
    towards = one_of(rng, sides)
    origin = [-float(side in towards) for side in ("right", "top")]
    grade = {"towards": towards, "exponent": float(rng.uniform(2, 10))}
    diagonal = one_of(rng, ("falling", "rising"))
    body = Rectangle(origin, (1.0, 1.0), diagonal, "per-side", by_side(labels), grade)
    return body.level(int(rng.integers(_FEWEST, 41)))


def _inclusions(rng, labels):
    """Two discs that touch the contact side, or nearly so; as stiff as 1e12, as soft as 1e-6."""
    x, y, r = rng.uniform(0, 1, 2), rng.uniform(-0.05, 0.25, 2), rng.uniform(0.1, 0.3, 2)
    disc = "hypot(x - {:.3f}, y - {:.3f}) < {:.3f}"
    discs = " or ".join(disc.format(*values) for values in zip(x, y, r, strict=True))
    return _any_mesh(rng, labels), f"where({discs}, {10.0 ** rng.uniform(-6, 12):.4g}, 1)"


def _layers(rng, labels):
    """A layer along the contact side or across it, or in pieces; up to 1e6 times as stiff."""
    value, other = 10.0 ** rng.uniform(-6, 6, 2)
    axis, width = one_of(rng, "xy"), rng.uniform(0.1, 0.5)
    pieces = f"where(sin({rng.uniform(5, 40):.3f}*x) > 0, {value:.4g}, {other:.4g})"
    inside = one_of(rng, (f"{value:.4g}", pieces))
    return _any_mesh(rng, labels), f"where({axis} < {width:.3f}, {inside}, 1)"


def _oscillating(rng, labels):
    """Waves as short as the cells, over up to six powers of ten, smooth or in steps."""
    k, l = rng.uniform(3, 60, 2)
    wave = f"sin({k:.3f}*x)*sin({l:.3f}*y + {rng.uniform(0, 6):.3f})"
    height = rng.uniform(0, 3)
    steps = f"where({wave} > 0, {10.0**height:.4g}, {10.0**-height:.4g})"
    smooth = f"exp({np.log(10) * height:.4g}*{wave})"
    return _any_mesh(rng, labels), one_of(rng, (smooth, steps))


def _any_mesh(rng, labels):
    return one_of(rng, (_right, _rising, _criss_cross, _delaunay, _perturbed))(rng, labels)


def one_of(rng, choices):
    """Draw from a sequence, each as likely.

    Parameters
    ----------
    rng : numpy.random.Generator
    choices : sequence

    Returns
    -------
    object
        One of them.

    Examples
    --------
    >>> import numpy as np
    >>> one_of(np.random.default_rng(0), ["a", "b"]) in ["a", "b"]
    True
    """
    return choices[rng.integers(len(choices))]


FAMILIES = {
    "right-angled": _right,
    "rising": _rising,
    "criss-cross": _criss_cross,
    "delaunay": _delaunay,
    "perturbed": _perturbed,
    "stretched": _stretched,
    "needles": _needles,
    "graded": _graded,
    "inclusions": _inclusions,
    "layers": _layers,
    "oscillating": _oscillating,
}
