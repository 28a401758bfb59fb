"""Exact solutions of Signorini problems: from a formula, or from a named family; the data follow
from them.
"""

from signorini.exact.data import derived_data
from signorini.exact.families import FAMILIES, family, read_exact
from signorini.exact.solution import Diffused, ExactSolution, FormulaSolution

__all__ = [
    "FAMILIES",
    "Diffused",
    "ExactSolution",
    "FormulaSolution",
    "derived_data",
    "family",
    "read_exact",
]
