"""Meshes that references are refined from."""

from builders import delaunay, grid, perturbed
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation

COARSE = {
    "falling grid": lambda: grid(3, 2, size=(1.0, 0.7)),
    "rising grid": lambda: grid(2, 3, diagonal="rising", origin=(-1.0, 2.0)),
    "one cell": lambda: grid(1, size=(2.0, 1.0)),
    "delaunay": lambda: delaunay(0, inner=8, side=2),
    "perturbed": lambda: perturbed(2),
    "grid as triangulation": lambda: Triangulation.from_skfem(grid(2, 3, diagonal="rising").skfem),
}


def finer(mesh):
    if isinstance(mesh, Grid):
        return Grid(2 * mesh.nx, 2 * mesh.ny, mesh.origin, mesh.size, mesh.diagonal, mesh.labels)
    return mesh.refined()
