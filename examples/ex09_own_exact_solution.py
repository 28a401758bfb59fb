r"""An exact solution of your own, and whether it is one.

Hansbo and Larson (2005) test their method with a solution that is known on
$[-1, 1] \times [0, 1]$:

$$u = \max(x, 0)^3 - y \max(-x, 0)^3, \qquad f = -6 \max(x, 0) + 6 y \max(-x, 0) .$$

On the contact side $y = 0$ it is $\max(x, 0)^3 \ge 0$, and its flux
$\partial_\nu u = -\partial_y u$ is $\max(-x, 0)^3 \ge 0$; one of the two is zero everywhere. So it
solves the problem with the obstacle 0, and the origin is its critical point. The force vanishes
there with the third power of the distance, so that the contact of the discrete solution ends early,
in the picture about 0.1 to the left.

Given as functions, $u$ comes with its gradient and its load. The library believes none of it: the
gradient is held against differences of $u$, the load against differences of the gradient, data and
Signorini's conditions against $u$, all before anything is solved. As a formula,
`"pos(x)**3 - y*pos(-x)**3"`, gradient and load would be derived.
"""

import numpy as np

import signorini


def u(x, y):
    """The solution."""
    return np.maximum(x, 0) ** 3 - y * np.maximum(-x, 0) ** 3


def gradient(x, y):
    """Its derivatives along x and y."""
    right, left = np.maximum(x, 0), np.maximum(-x, 0)
    return 3 * right**2 + 3 * y * left**2, -(left**3)


def load(x, y):
    """Minus its Laplacian."""
    return -6 * np.maximum(x, 0) + 6 * y * np.maximum(-x, 0)


EXACT = signorini.exact_solution(u, gradient, critical_points=[(0, 0)])
CONDITIONS = {"dirichlet": ["right", "top", "left"], "contact": "bottom"}


def problem(n, f=load):
    """The problem of level n; Dirichlet values are those of u."""
    mesh = signorini.rectangle(n, origin=(-1, 0), size=(2, 1))
    return signorini.problem(mesh, "P1", f=f, exact=EXACT, **CONDITIONS)


NORMS = ["l2", "h1_semi", "trace_l2", "multiplier_l2"]
errors = signorini.convergence(problem, [4, 8, 16, 32], EXACT, NORMS)
print(errors[["n", *NORMS]].to_string(index=False))
rates = signorini.rates(errors).query("kind == 'mean'").set_index("norm")["slope"].round(2)
print(rates.to_string())

# A slip of the pen in the load is found at once.
try:
    problem(4, f=lambda x, y: -load(x, y))
except signorini.SignoriniError as error:
    message = str(error)
    print(message)


def visualize(path=None):
    """The solution; contact to the left of the origin."""
    title = "An exact solution of Hansbo and Larson"
    return signorini.solve(problem(32)).plot(path, title=title)


if __name__ == "__main__":
    visualize("ex09_own_exact_solution.png")
