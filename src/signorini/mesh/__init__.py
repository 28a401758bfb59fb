"""Triangulations with named boundaries: uniform grids as arithmetic, anything else through scikit-fem."""

from signorini.mesh.domain import Rectangle, Refined, make_domain, read_domain, write_domain
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

__all__ = ["Grid", "Rectangle", "Refined", "Triangulation", "make_domain", "read_domain", "write_domain"]
