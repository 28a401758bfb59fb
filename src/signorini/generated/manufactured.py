"""Signorini problems at random whose solution is known: contact on y = 0, bodies above it.

With K(y) the integral of 1 / k from 0 to y, the function

    u = (alpha + phi)(x) (1 + a K^2) - (psi + s)(x) (K + b K^2) + S(x) K^2

is alpha + phi on y = 0, where k du/dnu = psi + s; it solves the problem with the threshold s under
its own load wherever phi and psi are not negative and never both positive. k du/dy does not jump
where k, a function of y alone, does. Half of the problems are mirrored: -u below an obstacle.
"""

from dataclasses import dataclass, replace

import numpy as np

from signorini.exact import derived_data, read_exact
from signorini.formula import Formula
from signorini.generated.bodies import FAMILIES, one_of, with_labels
from signorini.mesh.geometry import cross
from signorini.mesh.named_mesh import NamedMesh, with_sides
from signorini.scene.statement import ProblemStatement

BODIES = ("right-angled", "rising", "criss-cross", "delaunay", "perturbed")
# Obstacles: flat, sloping, concave, convex, and wavy.
_OBSTACLES = ("{a}", "{a} + {b}*x", "{a} - {c}*x**2", "{a} + {c}*x**2", "{a}*sin({d}*x)")
_SMOOTH = ("0", "{a} + {b}*x", "{a}*sin({d}*x + {b})", "{b}*exp({a}*x)")
_THRESHOLDS = ("0", "0", "{a}", "{a} + {b}*x", "{a}*sin({d}*x)")
# phi and psi: one critical point, a biactive interval, two zones, contact everywhere, and nowhere.
_STATES = (
    ("{p}*pos(x - {x})**3", "{q}*pos({x} - x)**3"),
    ("{p}*pos(x - {x})**2.5", "{q}*pos({x} - x)**3"),
    ("{p}*pos(x - {x} - 0.2)**3", "{q}*pos({x} - x)**3"),
    ("{p}*pos((x - {x})**2 - 0.04)**3", "{q}*pos(1 - 25*(x - {x})**2)**3"),
    ("0", "{p}*(1.5 + sin({d}*x))"),
    ("{p}*(1.5 + sin({d}*x))", "0"),
)


@dataclass(frozen=True, eq=False)
class Manufactured:
    """A problem on a mesh, and its solution.

    Attributes
    ----------
    mesh : Grid or Triangulation
    statement : ProblemStatement
        Its data; `exact` is the solution.
    """

    mesh: object
    statement: ProblemStatement

    @property
    def exact(self):
        """The solution, an `ExactSolution`."""
        return self.statement.exact


def manufactured(seed):
    """Draw a problem with a known solution.

    Parameters
    ----------
    seed : int

    Returns
    -------
    Manufactured

    Examples
    --------
    >>> drawn = manufactured(0)
    >>> data, u = drawn.statement.data, float(drawn.exact.value(0.5, 0.0))
    >>> data.constraint, u <= float(data.obstacle(0.5, 0.0))
    ('upper', True)
    """
    rng = np.random.default_rng(seed)
    state, numbers = one_of(rng, _STATES), _numbers(rng)
    mesh = _body(rng, needs_hold=state[1] == "0")
    obstacle, smooth, threshold = (
        one_of(rng, texts).format(**_numbers(rng)) for texts in (_OBSTACLES, _SMOOTH, _THRESHOLDS)
    )
    phi, psi = (text.format(**numbers) for text in state)
    k, K = _layers(rng, mesh)
    a, b = rng.uniform(-2.0, 2.0, 2)
    u = f"({obstacle} + {phi})*(1 + {a:.3f}*{K}**2) + ({smooth})*{K}**2"
    u += f" - ({psi} + {threshold})*({K} + {b:.3f}*{K}**2)"
    sign, constraint = one_of(rng, (("", "lower"), ("-", "upper")))
    exact = read_exact({"u": f"{sign}({u})"}, Formula(k, "data.coefficient"))
    data = replace(
        derived_data(exact),
        obstacle=Formula(f"{sign}({obstacle})", "data.obstacle"),
        contact_flux=Formula(f"{sign}({threshold})", "data.contact_flux"),
        constraint=constraint,
    )
    return Manufactured(mesh, ProblemStatement({}, {}, data, "exact", exact=exact))


def _numbers(rng):
    """The numbers that a text may ask for, as text."""
    values = {name: rng.uniform(-1.0, 1.0) for name in "ab"}
    values |= {name: rng.uniform(0.1, 3.0) for name in "cpq"}
    values |= {"d": rng.uniform(1.0, 8.0), "x": rng.uniform(0.1, 0.9)}
    return {name: f"{value:.3f}" for name, value in values.items()}


def _layers(rng, mesh):
    """A coefficient that depends on y, and K: constant, or in two layers with a line of a grid
    between them.
    """
    kind = rng.integers(3)
    first, second = 10.0 ** rng.uniform(-2, 2, 2)
    if kind == 0:
        return "1", "y"
    if kind == 1 or not hasattr(mesh, "ny"):
        return f"{first:.4g}", f"(y/{first:.4g})"
    height = float(mesh.y[rng.integers(1, mesh.ny)])
    line, below = f"y < {height!r}", f"y/{first:.4g}"
    above = f"{height!r}/{first:.4g} + (y - {height!r})/{second:.4g}"
    return f"where({line}, {first:.4g}, {second:.4g})", f"where({line}, {below}, {above})"


def _body(rng, needs_hold):
    """A mesh of a square, or of what shears and waves make of it, with contact on y = 0."""
    others = [one_of(rng, ("dirichlet", "neumann")) for _ in range(3)]
    if needs_hold and "dirichlet" not in others:
        others[int(rng.integers(3))] = "dirichlet"
    labels = ("contact", *others)
    square = FAMILIES[one_of(rng, BODIES)](rng, labels)
    if rng.integers(2):
        return square
    named = with_sides(NamedMesh(square.p, square.t))
    return with_labels(replace(named, p=_bent(rng, square)), labels)


def _bent(rng, mesh):
    """Vertices moved by a shear and a wave of the height, so that y = 0 stays and no triangle turns
    over.
    """
    x, y = mesh.p
    shear, wave, length = rng.uniform(-0.6, 0.6), rng.uniform(0.0, 0.5), rng.uniform(1.0, 9.0)
    while True:
        bent = np.stack([x + shear * y, y * (1.0 + wave * np.sin(length * x))])
        a, b, c = bent[:, mesh.t].transpose(1, 0, 2)
        before = mesh.p[:, mesh.t].transpose(1, 0, 2)
        turned = cross(b - a, c - a) * cross(before[1] - before[0], before[2] - before[0])
        if turned.min() > 0.0:
            return bent
        wave *= 0.5
