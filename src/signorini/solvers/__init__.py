"""Solvers: from a problem to a solution with its proof. They know no scene."""

from signorini.solvers.routes import METHODS
from signorini.solvers.select import solve
from signorini.solvers.solution import Solution, kkt_residual

__all__ = ["METHODS", "Solution", "kkt_residual", "solve"]
