r"""Two materials: a coefficient that jumps.

$$-\mathrm{div}\thinspace(k \nabla u) = f, \qquad
k = 1 \text{ in the soft part}, \quad k = 20 \text{ in the stiff one}.$$

Across the interface $u$ and the flux $k \thinspace \partial_\nu u$ are continuous, so that
$\partial_\nu u$ jumps by the ratio of the two coefficients. A mesh that follows the interface has
the coefficient constant on each triangle, and costs no accuracy.

The mesh is one of scikit-fem, with named subdomains, which are kept: `coefficient` gives each its
number. The contact force is now $k \thinspace \partial_\nu u$. Under the same load the soft part
sags onto the floor, while the stiff one spans it free.
"""

import numpy as np
import skfem

import signorini

STIFF = 20.0
DATA = {"f": -1.0, "obstacle": -0.2, "dirichlet": {"top": 0}, "contact": "floor"}

square = (
    skfem.MeshTri.init_tensor(np.linspace(0, 2, 17), np.linspace(0, 1, 9))
    .with_boundaries(
        {"floor": lambda x: x[1] == 0.0, "top": lambda x: x[1] == 1.0},
    )
    .with_subdomains({"soft": lambda x: x[0] < 1.0, "stiff": lambda x: x[0] > 1.0})
)
mesh = signorini.triangulation(square).refined(2)
problem = signorini.problem(mesh, "CR", coefficient={"soft": 1, "stiff": STIFF}, **DATA)
solution = signorini.solve(problem)

x, _ = solution.contact_points
soft, stiff = solution.force[x < 1.0].sum(), solution.force[x > 1.0].sum()
print(f"{solution.status} by {solution.method}")
print(f"the floor carries {soft:.4f} of the soft part and {stiff:.4f} of the stiff one")
for x_critical, _ in solution.critical_points.T:
    print(f"contact ends at x = {x_critical:.3f}")

# How far the bottom has sunk under the middle of each part.
u_soft, u_stiff = solution.at([[0.5, 1.5], [0.0, 0.0]])
print(f"the bottom is at {u_soft:.4f} under the soft part and at {u_stiff:.4f} under the stiff one")

# The same coefficient as a function of the place, taken at the centroids.
same = signorini.problem(mesh, "CR", coefficient=lambda x, y: np.where(x < 1.0, 1.0, STIFF), **DATA)
print("as a function: the same,", np.array_equal(problem.coefficient, same.coefficient))


def visualize(path=None):
    """The contours bend at x = 1, the interface."""
    return solution.plot(path, title="Soft to the left of x = 1, stiff to the right")


if __name__ == "__main__":
    visualize("ex08_two_materials.png")
