"""Generated problems: families of bodies times kinds of load times elements times seeds.

A body is a mesh with labels, and a diffusion coefficient. Each problem has a generator of its own,
seeded by what it is, so that any of them can be made again alone.
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.fem.elements import ELEMENTS
from signorini.fem.elements import element as find_element
from signorini.fem.problem import Problem, discretize_on
from signorini.scene.statement import ProblemStatement
from signorini.studies.stability.bodies import BOUNDARIES, FAMILIES, one_of


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
    labels = BOUNDARIES[seed % len(BOUNDARIES)] if load != "biactive" else BOUNDARIES[0]
    body = FAMILIES[family](np.random.default_rng(key), labels)
    mesh, coefficient = body if isinstance(body, tuple) else (body, 1)
    height = float(np.ptp(mesh.p[1]) / np.ptp(mesh.p[0]))
    rng = np.random.default_rng([*key, list(LOADS).index(load), list(ELEMENTS).index(element)])
    return Instance(
        family, load, element, seed, height, LOADS[load](rng, mesh, element, coefficient)
    )


# Kinds of load: (rng, mesh, element, coefficient) to a problem.


def _white(rng, mesh, element, coefficient):
    """Independent normal numbers as load."""
    problem = discretize_on(mesh, element, _statement({"coefficient": coefficient}))
    return _with_obstacle(rng, replace(problem, b=rng.standard_normal(problem.b.size)))


def _smooth(rng, mesh, element, coefficient):
    """Waves as load, flux and Dirichlet values."""
    height = float(np.ptp(mesh.p[1]))
    data = {
        "f": wave(rng, height),
        "g": wave(rng, height),
        "dirichlet": f"{height**2!r}*({wave(rng, height)})",
    }
    data |= {
        "obstacle": -1e6,
        "coefficient": coefficient,
    }  # below the Dirichlet values; the one asked for comes next
    return _with_obstacle(rng, discretize_on(mesh, element, _statement(data)))


def _degenerate(rng, mesh, element, coefficient):
    """The solution is chosen, with neither gap nor force at three tenths or nine tenths of the
    contact unknowns.
    """
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
    """No gap and no force on the whole contact part, or on a middle piece of it, for the exact
    solution.

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
    return discretize_on(
        mesh, element, _statement({"f": repr(c), "obstacle": repr(c * height**2 / 2)})
    )


def _tiny(rng, mesh, element, coefficient):
    return _times(_smooth(rng, mesh, element, coefficient), 1e-160)


def _huge(rng, mesh, element, coefficient):
    return _times(_smooth(rng, mesh, element, coefficient), 1e160)


def _constant(rng, mesh, element, coefficient):
    """The smooth load's problem with a constant of up to 1e12 times its size added to obstacle and
    Dirichlet values.
    """
    problem = _smooth(rng, mesh, element, coefficient)
    size = np.max(np.abs(np.concatenate([problem.lower, problem.fixed_values])))
    constant = one_of(rng, (-1.0, 1.0)) * 10.0 ** rng.uniform(0, 12) * size
    return replace(
        problem, lower=problem.lower + constant, fixed_values=problem.fixed_values + constant
    )


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
        a, k, l, phase = (
            rng.normal(),
            rng.uniform(-9, 9),
            rng.uniform(-9, 9) / height,
            rng.uniform(0, 6),
        )
        terms.append(f"({a:.3f})*sin(({k:.3f})*x + ({l:.6g})*y + {phase:.3f})")
    return " + ".join(terms)


def _statement(data, truth=None):
    zero = {"f": 0, "g": 0, "dirichlet": 0, "obstacle": 0}
    mapping = {
        "domain": {},
        "boundary": {},
        "data": {} if truth else zero | data,
        "load_quadrature": "midpoints",
    }
    return ProblemStatement.from_mapping(mapping | ({"truth": truth} if truth else {}))


def _with_obstacle(rng, problem):
    """An obstacle of the size of the solution without contact: none, a wave, or normal numbers."""
    u = _without_contact(problem)
    x, _ = find_element(problem.element).nodes(problem.mesh, problem.contact)
    shapes = (
        np.zeros(x.size),
        np.sin(rng.uniform(1, 20) * x + rng.uniform(0, 6)),
        rng.standard_normal(x.size),
    )
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
