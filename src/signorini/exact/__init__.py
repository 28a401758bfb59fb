"""Exact solutions of Signorini problems, from a formula or a named family, and their data."""

from signorini.exact.data import derived_data
from signorini.exact.diffused import Diffused, with_coefficient
from signorini.exact.families import FAMILIES, family, read_exact
from signorini.exact.function import FunctionSolution, Gradient
from signorini.exact.solution import ExactSolution, FormulaSolution

__all__ = [
    "FAMILIES",
    "Diffused",
    "ExactSolution",
    "FormulaSolution",
    "FunctionSolution",
    "Gradient",
    "derived_data",
    "family",
    "read_exact",
    "with_coefficient",
]
