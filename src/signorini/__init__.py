"""signorini: Crouzeix-Raviart and conforming P1 approximation of Signorini's variational
inequality.

>>> import signorini
>>> mesh = signorini.rectangle(16)
>>> problem = signorini.problem(
...     mesh, "CR", f="2*pi*sin(2*pi*x)", dirichlet={"top": 0}, contact="bottom"
... )
>>> solution = signorini.solve(problem)
>>> solution.status, solution.critical_points.tolist()
('solved', [[0.6875], [0.0]])

docs/python.md leads through it. Problems in files are scenes, see `load_scene`.
"""

import importlib

__version__ = "1.0.0"

# Public name -> its room; a room is entered when first asked for, so that importing signorini costs
# nothing. Type checkers read `__init__.pyi`.
_ROOMS = {
    "Mesh": "api.meshes",
    "Problem": "fem.discrete_problem",
    "Scene": "scene.scene",
    "SignoriniError": "exceptions",
    "Solution": "api.solution",
    "certify": "api.certificate",
    "convergence": "api.convergence",
    "discretize": "fem.problem",
    "exact_solution": "api.exact",
    "kkt_residual": "solvers",
    "latex_table": "api.reporting",
    "load_scene": "scene.read",
    "plot_errors": "api.reporting",
    "polygon": "api.domains",
    "problem": "api.problem",
    "rates": "api.convergence",
    "rectangle": "api.domains",
    "solve": "api.solve",
    "triangulation": "api.domains",
}

__all__ = sorted(_ROOMS)


def __getattr__(name):
    if name in _ROOMS:
        return getattr(importlib.import_module(f"signorini.{_ROOMS[name]}"), name)
    raise AttributeError(f"module 'signorini' has no attribute {name!r}")


def __dir__():
    return [*globals(), *__all__]
