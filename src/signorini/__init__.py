"""signorini: Crouzeix-Raviart and conforming P1 approximation of Signorini's variational
inequality.

>>> import signorini
>>> scene = signorini.load_scene("config/scenes/paper.yaml")
>>> problem = signorini.discretize(scene, "CR", 16)
>>> signorini.solve(problem).status
'solved'
"""

import importlib

__version__ = "0.1.0"

# Public name -> its room; a room is entered when first asked for, so that importing signorini costs
# nothing.
_ROOMS = {
    "SignoriniError": "exceptions",
    "Scene": "scene.scene",
    "load_scene": "scene.read",
    "Problem": "fem.problem",
    "discretize": "fem.problem",
    "Solution": "solvers",
    "solve": "solvers",
    "kkt_residual": "solvers",
}

__all__ = sorted(_ROOMS)


def __getattr__(name):
    if name in _ROOMS:
        return getattr(importlib.import_module(f"signorini.{_ROOMS[name]}"), name)
    raise AttributeError(f"module 'signorini' has no attribute {name!r}")


def __dir__():
    return [*globals(), *__all__]
