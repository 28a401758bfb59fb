"""Triangulations with named boundaries: uniform grids as arithmetic, anything else through scikit-fem."""

from signorini.mesh.domain import Domain, read_domain, write_domain
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

__all__ = ["Domain", "Grid", "Triangulation", "read_domain", "write_domain"]
