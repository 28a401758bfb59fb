"""Families of bodies: meshes of a rectangle with labels, most of them at random, some with a
diffusion coefficient.
"""

from dataclasses import replace

import numpy as np

from signorini.mesh.domain import Rectangle
from signorini.mesh.grid import SIDES, Grid
from signorini.mesh.labels import NamedMesh, labelled, with_sides
from signorini.mesh.patterns import criss_cross, perturbed

# What holds on the bottom, right, top and left side.
BOUNDARIES = (
    ("contact", "neumann", "dirichlet", "neumann"),
    ("contact", "dirichlet", "dirichlet", "dirichlet"),
    ("contact", "contact", "dirichlet", "neumann"),
)
_PAPER = BOUNDARIES[0]
_FEWEST, _MOST = 4, 16  # cells along a side


# Families: (rng, labels) to a mesh of a rectangle of width 1, or to such a mesh and a formula of a
# coefficient.


def _cells(rng):
    return (int(n) for n in rng.integers(_FEWEST, _MOST + 1, 2))


def _right(rng, labels):
    return Grid(*_cells(rng), (0.0, 0.0), (1.0, 1.0), "falling", labels)


def _rising(rng, labels):
    return Grid(*_cells(rng), (0.0, 0.0), (1.0, 1.0), "rising", labels)


def _criss_cross(rng, labels):
    return _label(
        criss_cross(*(max(n // 2, 3) for n in _cells(rng)), (0.0, 0.0), (1.0, 1.0)), labels
    )


def _delaunay(rng, labels):
    from scipy.spatial import Delaunay

    inner, side = int(rng.integers(20, 120)), int(rng.integers(3, 10))
    s, zero = rng.uniform(0.02, 0.98, (4, side)), np.zeros(side)
    edges = [[s[0], zero], [zero + 1, s[1]], [s[2], zero + 1], [zero, s[3]]]
    p = np.hstack([[[0, 1, 1, 0], [0, 0, 1, 1]], *edges, rng.uniform(0.05, 0.95, (2, inner))])
    t = Delaunay(p.T).simplices.T
    a, b, c = (p[:, v] for v in t)
    doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    t = np.where(doubled > 0, t, t[[0, 2, 1]])[
        :, np.abs(doubled) > 1e-12
    ]  # three points of one side have no area
    return _label(with_sides(NamedMesh(p, t)), labels)


def _perturbed(rng, labels):
    return _label(_shaken(rng), labels)


def pressed_flat(n, aspect, seed):
    """A shaken grid of n by n cells on a rectangle of width 1 and height `aspect`, as a
    `NamedMesh`.
    """
    grid = Grid(n, n, (0.0, 0.0), (1.0, 1.0), "falling", _PAPER)
    return _flat(perturbed(with_sides(NamedMesh(grid.p, grid.t)), 0.9, seed), aspect)


def _stretched(rng, labels):
    """Shaken grids pressed flat, to aspects down to 1e-6."""
    return _label(_flat(_shaken(rng), 10.0 ** -rng.uniform(0, 6)), labels)


def _needles(rng, labels):
    """Rows of vertices moved along x by up to 0.45 of a cell, then pressed flat: angles near 180
    degrees.
    """
    mesh = _grid(rng)
    x, y = mesh.p
    inside = (x > 0) & (x < 1)
    width = np.diff(np.unique(x))[0]
    moved = np.where(inside, x + rng.uniform(-0.45, 0.45, x.size) * width, x)
    return _label(_flat(replace(mesh, p=np.stack([moved, y])), 10.0 ** -rng.uniform(1, 3)), labels)


def _grid(rng):
    grid = Grid(*_cells(rng), (0.0, 0.0), (1.0, 1.0), "falling", _PAPER)
    return with_sides(NamedMesh(grid.p, grid.t))


def _shaken(rng):
    return perturbed(_grid(rng), 0.9, int(rng.integers(2**31)))


def _flat(mesh, aspect):
    return replace(mesh, p=mesh.p * [[1.0], [aspect]])


def _label(mesh, labels):
    return labelled(mesh, dict(zip(SIDES, labels, strict=True)))


def _graded(rng, labels):
    """Cells drawn towards a side or a corner, with exponents from 2 to 10: neighbours up to 1e15
    times as thin.

    Sides that cells are drawn to lie on the axes, where coordinates resolve them.
    """
    sides = [
        ("bottom",),
        ("bottom", "left"),
        ("bottom", "right"),
        ("left",),
        ("right",),
        ("right", "top"),
    ]
    towards = sides[rng.integers(len(sides))]
    origin = [-float(side in towards) for side in ("right", "top")]
    grade = {"towards": towards, "exponent": float(rng.uniform(2, 10))}
    boundary, diagonal = dict(zip(SIDES, labels, strict=True)), one_of(rng, ("falling", "rising"))
    return Rectangle(origin, (1.0, 1.0), diagonal, "per-side", boundary, grade).level(
        int(rng.integers(_FEWEST, 41))
    )


def _inclusions(rng, labels):
    """Two stiff or soft discs that touch the contact side, or nearly so; as stiff as 1e12, as soft
    as 1e-6.
    """
    x, y, r = rng.uniform(0, 1, 2), rng.uniform(-0.05, 0.25, 2), rng.uniform(0.1, 0.3, 2)
    discs = " or ".join(
        f"hypot(x - {a:.3f}, y - {b:.3f}) < {c:.3f}" for a, b, c in zip(x, y, r, strict=True)
    )
    return _any_mesh(rng, labels), f"where({discs}, {10.0 ** rng.uniform(-6, 12):.4g}, 1)"


def _layers(rng, labels):
    """A layer along the contact side or across it, up to 1e6 times as stiff or as soft, sometimes
    stiff in pieces.
    """
    value, other = 10.0 ** rng.uniform(-6, 6, 2)
    axis, width = one_of(rng, "xy"), rng.uniform(0.1, 0.5)
    inside = one_of(
        rng,
        (f"{value:.4g}", f"where(sin({rng.uniform(5, 40):.3f}*x) > 0, {value:.4g}, {other:.4g})"),
    )
    return _any_mesh(rng, labels), f"where({axis} < {width:.3f}, {inside}, 1)"


def _oscillating(rng, labels):
    """A coefficient in waves as short as the cells, over up to six powers of ten, smooth or in
    steps.
    """
    k, l = rng.uniform(3, 60, 2)
    wave, height = f"sin({k:.3f}*x)*sin({l:.3f}*y + {rng.uniform(0, 6):.3f})", rng.uniform(0, 3)
    steps = f"where({wave} > 0, {10.0**height:.4g}, {10.0**-height:.4g})"
    return _any_mesh(rng, labels), one_of(rng, (f"exp({np.log(10) * height:.4g}*{wave})", steps))


def _any_mesh(rng, labels):
    return one_of(rng, (_right, _rising, _criss_cross, _delaunay, _perturbed))(rng, labels)


def one_of(rng, choices):
    """One of a sequence, each as likely."""
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
