"""Generated problems: families of bodies times kinds of load times elements times seeds.

A body is a mesh with labels, and a diffusion coefficient. Each problem has a generator of its own,
seeded by what it is, so that any of them can be made again alone.
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.fem.elements import ELEMENTS, find_element
from signorini.fem.problem import Problem, discretize_on
from signorini.generated.bodies import BOUNDARIES, FAMILIES, one_of
from signorini.generated.statements import statement


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
    >>> white, smooth = (instance("delaunay", load, "CR", 0) for load in ("white", "smooth"))
    >>> white.problem.b.size == smooth.problem.b.size
    True
    """
    key = [list(FAMILIES).index(family), seed]
    labels = BOUNDARIES[0] if load == "biactive" else BOUNDARIES[seed % len(BOUNDARIES)]
    body = FAMILIES[family](np.random.default_rng(key), labels)
    mesh, coefficient = body if isinstance(body, tuple) else (body, 1)
    aspect = float(np.ptp(mesh.p[1]) / np.ptp(mesh.p[0]))
    rng = np.random.default_rng([*key, list(LOADS).index(load), list(ELEMENTS).index(element)])
    problem = LOADS[load](rng, mesh, element, coefficient)
    return Instance(family, load, element, seed, aspect, problem)


# Kinds of load: (rng, mesh, element, coefficient) to a problem.


def _problem(mesh, element, coefficient, **data):
    stated = statement(data | {"coefficient": coefficient}, quadrature="midpoints")
    return discretize_on(mesh, element, stated)


def _white(rng, mesh, element, coefficient):
    """Independent normal numbers as load."""
    problem = _problem(mesh, element, coefficient)
    return _with_obstacle(rng, replace(problem, b=rng.standard_normal(problem.b.size)))


def _smooth(rng, mesh, element, coefficient):
    """Waves as load, flux and Dirichlet values."""
    height = float(np.ptp(mesh.p[1]))
    data = {name: wave(rng, height) for name in ("f", "g")}
    data["dirichlet"] = f"{height**2!r}*({wave(rng, height)})"
    # An obstacle below the Dirichlet values; the one asked for comes next.
    return _with_obstacle(rng, _problem(mesh, element, coefficient, obstacle=-1e6, **data))


def _degenerate(rng, mesh, element, coefficient):
    """The solution is chosen, with neither gap nor force at three or nine tenths of the dofs."""
    problem = _problem(mesh, element, coefficient)
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
    """No gap and no force on the whole contact part, or on a middle piece of it.

    So it is for the exact solution; with a coefficient, for the discrete one: the obstacle is the
    solution without contact.
    """
    height = float(np.ptp(mesh.p[1]))
    if coefficient != 1:
        problem = _problem(mesh, element, coefficient, f=1)
        return replace(problem, lower=_without_contact(problem)[problem.contact])
    if height == 1.0 and rng.random() < 0.5:
        left, right = np.sort(rng.uniform(0.1, 0.9, 2))
        truth = {"family": "biactive", "parameters": {"left": float(left), "right": float(right)}}
        return discretize_on(mesh, element, statement(truth=truth, quadrature="midpoints"))
    c = float(10.0 ** rng.uniform(-3, 3))
    return _problem(mesh, element, 1, f=repr(c), obstacle=repr(c * height**2 / 2))


def _tiny(rng, mesh, element, coefficient):
    return _times(_smooth(rng, mesh, element, coefficient), 1e-160)


def _huge(rng, mesh, element, coefficient):
    return _times(_smooth(rng, mesh, element, coefficient), 1e160)


def _constant(rng, mesh, element, coefficient):
    """The smooth load's problem, obstacle and Dirichlet values raised by a constant.

    It is up to 1e12 times the size of these.
    """
    problem = _smooth(rng, mesh, element, coefficient)
    size = np.max(np.abs(np.concatenate([problem.lower, problem.fixed_values])))
    constant = one_of(rng, (-1.0, 1.0)) * 10.0 ** rng.uniform(0, 12) * size
    raised = {name: getattr(problem, name) + constant for name in ("lower", "fixed_values")}
    return replace(problem, **raised)


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
    """A constant and two plane waves, of a few periods over a rectangle of width 1.

    Parameters
    ----------
    rng : numpy.random.Generator
    height : float, optional
        Of the rectangle.

    Returns
    -------
    str
        A formula.
    """
    terms = [f"{rng.normal():.3f}"]
    for _ in range(2):
        a, k, l = rng.normal(), rng.uniform(-9, 9), rng.uniform(-9, 9) / height
        phase = rng.uniform(0, 6)
        terms.append(f"({a:.3f})*sin(({k:.3f})*x + ({l:.6g})*y + {phase:.3f})")
    return " + ".join(terms)


def _with_obstacle(rng, problem):
    """An obstacle of the size of the solution without contact: none, a wave, or normal numbers."""
    u = _without_contact(problem)
    x, _ = find_element(problem.element).nodes(problem.mesh, problem.contact)
    sine = np.sin(rng.uniform(1, 20) * x + rng.uniform(0, 6))
    shapes = (np.zeros(x.size), sine, rng.standard_normal(x.size))
    size = rng.uniform(0.1, 1.0) * np.abs(u).max()
    return replace(problem, lower=size * one_of(rng, shapes))


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
