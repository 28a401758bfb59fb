r"""A first solve: a membrane over a rigid floor.

A membrane over the unit square is held at height 0 along its top side and pulled by the load $f$.
Along its bottom side it must not sink below the floor, the obstacle 0; there the floor may push it
up, and cannot pull it down:

$$
\begin{aligned}
-\Delta u &= f && \text{inside}, \\
u &= 0 && \text{on the top}, \\
\partial_\nu u &= 0 && \text{on the left and on the right}, \\
u \ge 0, \quad \partial_\nu u \ge 0, \quad u\thinspace \partial_\nu u &= 0 && \text{on the bottom}.
\end{aligned}
$$

This is Signorini's problem for one scalar unknown. With $f = 2 \pi \sin (2 \pi x)$ the load lifts
the left half and presses the right one down, so that the membrane touches the floor on a part of
the bottom that nobody knows beforehand. Where it starts to touch there is a critical point.
"""

import numpy as np

import signorini

mesh = signorini.rectangle(32)  # 32 x 32 squares, each cut into two triangles
problem = signorini.problem(
    mesh,
    "CR",
    f=lambda x, y: 2 * np.pi * np.sin(2 * np.pi * x),
    obstacle=0,
    dirichlet={"top": 0},
    contact="bottom",
)
solution = signorini.solve(problem)

# The solver says how it solved, and proves what it found: by the residual of the
# Karush-Kuhn-Tucker conditions, which is computed from the problem alone.
print(f"{solution.status} by {solution.method}, KKT residual {solution.residual:.1e}")

# Where the membrane touches, and with what force the floor pushes.
((x_critical, _),) = solution.critical_points.T
print(f"touches to the right of x = {x_critical:.3f}, known to half a mesh width, {0.5 / 32:.3f}")
print(f"the floor pushes with {solution.resultant:.4f} in all")

# The solution at any point.
print(f"u(1/4, 1/2) = {solution.at([[0.25], [0.5]])[0]:.4f}")


def visualize(path=None):
    """Contours of u; the thick line is where the membrane touches the floor."""
    return solution.plot(path, title="A membrane over a floor")


if __name__ == "__main__":
    visualize("ex01_first_solve.png")
