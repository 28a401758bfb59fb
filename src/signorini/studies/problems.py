"""Generated problems: families of bodies times kinds of load times elements times seeds.

A body is a mesh with labels, and a diffusion coefficient. Each problem has a generator of its own, seeded by what it
is, so that any of them can be made again alone.
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.elements import ELEMENTS
from signorini.elements import element as find_element
from signorini.mesh.domain import Rectangle
from signorini.mesh.grid import SIDES, Grid
from signorini.mesh.labels import NamedMesh, labelled, with_sides
from signorini.mesh.patterns import criss_cross, perturbed
from signorini.problem import Problem, discretize_on
from signorini.statement import ProblemStatement

# What holds on the bottom, right, top and left side.
BOUNDARIES = (
    ("contact", "neumann", "dirichlet", "neumann"),
    ("contact", "dirichlet", "dirichlet", "dirichlet"),
    ("contact", "contact", "dirichlet", "neumann"),
)
_PAPER = BOUNDARIES[0]
_FEWEST, _MOST = 4, 16  # cells along a side


@dataclass(frozen=True, eq=False)
class Instance:
    """A generated problem.

    Parameters
    ----------
    family, load, element : str
        Of `FAMILIES`, `LOADS` and `ELEMENTS`.
    seed : int
    aspect : float
        Height over width of the domain; in families that are not graded the cells' is near it.
    problem : Problem
    """

    family: str
    load: str
    element: str
    seed: int
    aspect: float
    problem: Problem


def instance(family, load, element, seed):
    """Make a problem.

    Parameters
    ----------
    family, load, element : str
        Of `FAMILIES`, `LOADS` and `ELEMENTS`.
    seed : int

    Returns
    -------
    Instance

    Examples
    --------
    >>> instance("delaunay", "white", "CR", 0).problem.b.size == instance("delaunay", "smooth", "CR", 0).problem.b.size
    True
    """
    key = [list(FAMILIES).index(family), seed]
    labels = BOUNDARIES[seed % len(BOUNDARIES)] if load != "biactive" else _PAPER
    body = FAMILIES[family](np.random.default_rng(key), labels)
    mesh, coefficient = body if isinstance(body, tuple) else (body, 1)
    height = float(np.ptp(mesh.p[1]) / np.ptp(mesh.p[0]))
    rng = np.random.default_rng([*key, list(LOADS).index(load), list(ELEMENTS).index(element)])
    return Instance(family, load, element, seed, height, LOADS[load](rng, mesh, element, coefficient))


# Families: (rng, labels) to a mesh of a rectangle of width 1, or to such a mesh and a formula of a coefficient.


def _cells(rng):
    return (int(n) for n in rng.integers(_FEWEST, _MOST + 1, 2))


def _right(rng, labels):
    return Grid(*_cells(rng), (0.0, 0.0), (1.0, 1.0), "falling", labels)


def _rising(rng, labels):
    return Grid(*_cells(rng), (0.0, 0.0), (1.0, 1.0), "rising", labels)


def _criss_cross(rng, labels):
    return _label(criss_cross(*(max(n // 2, 3) for n in _cells(rng)), (0.0, 0.0), (1.0, 1.0)), labels)


def _delaunay(rng, labels):
    from scipy.spatial import Delaunay

    inner, side = int(rng.integers(20, 120)), int(rng.integers(3, 10))
    s, zero = rng.uniform(0.02, 0.98, (4, side)), np.zeros(side)
    edges = [[s[0], zero], [zero + 1, s[1]], [s[2], zero + 1], [zero, s[3]]]
    p = np.hstack([[[0, 1, 1, 0], [0, 0, 1, 1]], *edges, rng.uniform(0.05, 0.95, (2, inner))])
    t = Delaunay(p.T).simplices.T
    a, b, c = (p[:, v] for v in t)
    doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    t = np.where(doubled > 0, t, t[[0, 2, 1]])[:, np.abs(doubled) > 1e-12]  # three points of one side have no area
    return _label(with_sides(NamedMesh(p, t)), labels)


def _perturbed(rng, labels):
    return _label(_shaken(rng), labels)


def pressed_flat(n, aspect, seed):
    """A shaken grid of n by n cells on a rectangle of width 1 and height `aspect`, as a `NamedMesh`."""
    grid = Grid(n, n, (0.0, 0.0), (1.0, 1.0), "falling", _PAPER)
    return _flat(perturbed(with_sides(NamedMesh(grid.p, grid.t)), 0.9, seed), aspect)


def _stretched(rng, labels):
    """Shaken grids pressed flat, to aspects down to 1e-6."""
    return _label(_flat(_shaken(rng), 10.0 ** -rng.uniform(0, 6)), labels)


def _needles(rng, labels):
    """Rows of vertices moved along x by up to 0.45 of a cell, then pressed flat: angles near 180 degrees."""
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
    """Cells drawn towards a side or a corner, with exponents from 2 to 10: neighbours up to 1e15 times as thin.

    Sides that cells are drawn to lie on the axes, where coordinates resolve them.
    """
    sides = [("bottom",), ("bottom", "left"), ("bottom", "right"), ("left",), ("right",), ("right", "top")]
    towards = sides[rng.integers(len(sides))]
    origin = [-float(side in towards) for side in ("right", "top")]
    grade = {"towards": towards, "exponent": float(rng.uniform(2, 10))}
    boundary, diagonal = dict(zip(SIDES, labels, strict=True)), _one_of(rng, ("falling", "rising"))
    return Rectangle(origin, (1.0, 1.0), diagonal, "per-side", boundary, grade).level(int(rng.integers(_FEWEST, 41)))


def _inclusions(rng, labels):
    """Two stiff or soft discs that touch the contact side, or nearly so; as stiff as 1e12, as soft as 1e-6."""
    x, y, r = rng.uniform(0, 1, 2), rng.uniform(-0.05, 0.25, 2), rng.uniform(0.1, 0.3, 2)
    discs = " or ".join(f"hypot(x - {a:.3f}, y - {b:.3f}) < {c:.3f}" for a, b, c in zip(x, y, r, strict=True))
    return _any_mesh(rng, labels), f"where({discs}, {10.0 ** rng.uniform(-6, 12):.4g}, 1)"


def _layers(rng, labels):
    """A layer along the contact side or across it, up to 1e6 times as stiff or as soft, sometimes stiff in pieces."""
    value, other = 10.0 ** rng.uniform(-6, 6, 2)
    axis, width = _one_of(rng, "xy"), rng.uniform(0.1, 0.5)
    inside = _one_of(rng, (f"{value:.4g}", f"where(sin({rng.uniform(5, 40):.3f}*x) > 0, {value:.4g}, {other:.4g})"))
    return _any_mesh(rng, labels), f"where({axis} < {width:.3f}, {inside}, 1)"


def _oscillating(rng, labels):
    """A coefficient in waves as short as the cells, over up to six powers of ten, smooth or in steps."""
    k, l = rng.uniform(3, 60, 2)
    wave, height = f"sin({k:.3f}*x)*sin({l:.3f}*y + {rng.uniform(0, 6):.3f})", rng.uniform(0, 3)
    steps = f"where({wave} > 0, {10.0**height:.4g}, {10.0**-height:.4g})"
    return _any_mesh(rng, labels), _one_of(rng, (f"exp({np.log(10) * height:.4g}*{wave})", steps))


def _any_mesh(rng, labels):
    return _one_of(rng, (_right, _rising, _criss_cross, _delaunay, _perturbed))(rng, labels)


def _one_of(rng, choices):
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


# Kinds of load: (rng, mesh, element, coefficient) to a problem.


def _white(rng, mesh, element, coefficient):
    """Independent normal numbers as load."""
    problem = discretize_on(mesh, element, _statement({"coefficient": coefficient}))
    return _with_obstacle(rng, replace(problem, b=rng.standard_normal(problem.b.size)))


def _smooth(rng, mesh, element, coefficient):
    """Waves as load, flux and Dirichlet values."""
    height = float(np.ptp(mesh.p[1]))
    data = {"f": wave(rng, height), "g": wave(rng, height), "dirichlet": f"{height**2!r}*({wave(rng, height)})"}
    data |= {"obstacle": -1e6, "coefficient": coefficient}  # below the Dirichlet values; the one asked for comes next
    return _with_obstacle(rng, discretize_on(mesh, element, _statement(data)))


def _degenerate(rng, mesh, element, coefficient):
    """The solution is chosen, with neither gap nor force at three tenths or nine tenths of the contact unknowns."""
    problem = discretize_on(mesh, element, _statement({"coefficient": coefficient}))
    c, biactive = problem.contact, rng.random(problem.contact.size) < rng.choice([0.3, 0.9])
    u = rng.standard_normal(problem.b.size)
    force = np.where(u[c] > 0, 0.0, rng.uniform(0, 1, c.size)) * problem.A.diagonal()[c]
    lower = rng.standard_normal(c.size)
    gap = np.where(biactive, 0.0, np.maximum(u[c], 0.0))
    force[biactive] = 0.0
    u[c] = lower + gap
    b = problem.A @ u
    b[c] -= force
    return replace(problem, b=b, lower=lower, fixed_values=u[problem.fixed])


def _biactive(rng, mesh, element, coefficient):
    """No gap and no force on the whole contact part, or on a middle piece of it, for the exact solution.

    With a coefficient, for the discrete solution: the obstacle is the solution without contact.
    """
    height = float(np.ptp(mesh.p[1]))
    if coefficient != 1:
        problem = discretize_on(mesh, element, _statement({"f": 1, "coefficient": coefficient}))
        return replace(problem, lower=_without_contact(problem)[problem.contact])
    if height == 1.0 and rng.random() < 0.5:
        left, right = np.sort(rng.uniform(0.1, 0.9, 2))
        truth = {"family": "biactive", "parameters": {"left": float(left), "right": float(right)}}
        return discretize_on(mesh, element, _statement(None, truth))
    c = float(10.0 ** rng.uniform(-3, 3))
    return discretize_on(mesh, element, _statement({"f": repr(c), "obstacle": repr(c * height**2 / 2)}))


def _tiny(rng, mesh, element, coefficient):
    return _times(_smooth(rng, mesh, element, coefficient), 1e-160)


def _huge(rng, mesh, element, coefficient):
    return _times(_smooth(rng, mesh, element, coefficient), 1e160)


def _constant(rng, mesh, element, coefficient):
    """The smooth load's problem with a constant of up to 1e12 times its size added to obstacle and Dirichlet values."""
    problem = _smooth(rng, mesh, element, coefficient)
    size = np.max(np.abs(np.concatenate([problem.lower, problem.fixed_values])))
    constant = _one_of(rng, (-1.0, 1.0)) * 10.0 ** rng.uniform(0, 12) * size
    return replace(problem, lower=problem.lower + constant, fixed_values=problem.fixed_values + constant)


LOADS = {
    "white": _white,
    "smooth": _smooth,
    "degenerate": _degenerate,
    "biactive": _biactive,
    "tiny": _tiny,
    "huge": _huge,
    "constant": _constant,
}


def wave(rng, height=1.0):
    """A formula: a constant and two plane waves, of a few periods over a rectangle of width 1."""
    terms = [f"{rng.normal():.3f}"]
    for _ in range(2):
        a, k, l, phase = rng.normal(), rng.uniform(-9, 9), rng.uniform(-9, 9) / height, rng.uniform(0, 6)
        terms.append(f"({a:.3f})*sin(({k:.3f})*x + ({l:.6g})*y + {phase:.3f})")
    return " + ".join(terms)


def _statement(data, truth=None):
    zero = {"f": 0, "g": 0, "dirichlet": 0, "obstacle": 0}
    mapping = {"domain": {}, "boundary": {}, "data": {} if truth else zero | data, "load_quadrature": "midpoints"}
    return ProblemStatement.from_mapping(mapping | ({"truth": truth} if truth else {}))


def _with_obstacle(rng, problem):
    """An obstacle of the size of the solution without contact: none, a wave, or normal numbers."""
    u = _without_contact(problem)
    x, _ = find_element(problem.element).nodes(problem.mesh, problem.contact)
    shapes = (np.zeros(x.size), np.sin(rng.uniform(1, 20) * x + rng.uniform(0, 6)), rng.standard_normal(x.size))
    return replace(problem, lower=rng.uniform(0.1, 1.0) * np.abs(u).max() * shapes[rng.integers(3)])


def _without_contact(problem):
    from scipy.sparse.linalg import spsolve

    free = problem.free
    u = np.zeros_like(problem.b)
    u[problem.fixed] = problem.fixed_values
    u[free] = spsolve(problem.A[free][:, free].tocsc(), (problem.b - problem.A @ u)[free])
    return u


def _times(problem, factor):
    parts = {name: factor * getattr(problem, name) for name in ("b", "lower", "fixed_values")}
    return replace(problem, **parts)
