r"""A mesh of your own, from Gmsh.

A bracket is clamped on its wall and rests with its foot on a foundation; a load pulls it down, a
flux enters through the slanted edge. The shape was drawn for Gmsh, with physical groups for the
parts of the boundary:

    Physical Curve("wall") = {6};     Physical Curve("foot") = {1};
    Physical Curve("slope") = {3};    Physical Curve("free") = {2, 4, 5};
    Physical Surface("steel") = {1};

`bracket.msh` beside this script has it in Gmsh's format 2.2. The groups become the names of the
boundary: they say what holds where. What no condition names is Neumann, with flux 0.

The mesh is refined by cutting each triangle into four. Multigrid works on the meshes in between, so
that a mesh file costs as little as a rectangle. A `meshio.Mesh`, a `skfem.MeshTri` or a pair of
arrays would do as well as a file.
"""

from pathlib import Path

import numpy as np

import signorini

coarse = signorini.triangulation(Path(__file__).with_name("bracket.msh"))
print(coarse, "subdomains:", *coarse.subdomains)

mesh = coarse.refined(5)
problem = signorini.problem(
    mesh,
    "CR",
    f=-1.0,
    g={"slope": lambda x, y: 0.5 * y},
    obstacle=lambda x, y: -0.05 - 0.1 * np.cos(np.pi * x),
    dirichlet={"wall": 0},
    contact="foot",
)
solution = signorini.solve(problem)

print(f"{problem.b.size} unknowns: {solution.status} by {solution.method}, {solution.reason}")
print(f"the foundation carries {solution.resultant:.4f}")
for x, y in solution.critical_points.T:
    print(f"contact begins or ends at ({x:.3f}, {y:.3f})")


def visualize(path=None):
    """Contours of u on the bracket."""
    return solution.plot(path, title="A bracket on its foundation")


if __name__ == "__main__":
    visualize("ex03_mesh_from_gmsh.png")
