r"""Crouzeix-Raviart against P1: the same problem, two elements.

Both elements are affine on every triangle. They differ in what holds them together:

- P1 has its unknowns at the vertices, and is continuous;
- CR has them at the midpoints of the sides, and jumps elsewhere.

So the constraint $u \ge 0$ holds at the vertices of the contact side for P1, which makes its
functions admissible: its energy is never below the least one. For CR it holds at the midpoints,
that is for the mean over each side, and its functions are not admissible. CR has three times the
unknowns.

A fine P1 solution on a mesh that was refined from both serves as the truth.
"""

import signorini

F = "2*pi*sin(2*pi*x)"
ELEMENTS = ("P1", "CR")


def solve(element, n):
    """The membrane of the first example."""
    mesh = signorini.rectangle(n)
    problem = signorini.problem(mesh, element, f=F, dirichlet={"top": 0}, contact="bottom")
    return signorini.solve(problem)


reference = solve("P1", 128)
solutions = {element: solve(element, 16) for element in ELEMENTS}

for element, solution in solutions.items():
    errors = solution.errors(reference)
    print(
        f"{element}: {solution.problem.free.size:4} unknowns, "
        f"L2 error {errors['l2']:.2e}, H1 seminorm {errors['h1_semi']:.2e}, "
        f"force {solution.resultant:.5f}"
    )


def energy(solution):
    """a(u, u) / 2 - (f, u), which the solution makes least."""
    problem, u = solution.problem, solution.u
    return 0.5 * u @ problem.apply(u) - problem.b @ u


# That of P1 is never below the least one. CR functions are not admissible: here theirs is.
least = energy(reference)
excess = {element: energy(solution) - least for element, solution in solutions.items()}
for element, difference in excess.items():
    print(f"{element}: energy {difference:+.2e} from that of the reference")


def visualize(path=None):
    """The contours of CR break at the sides of triangles, where it jumps."""
    return solutions["CR"].plot(path, title="Crouzeix-Raviart, n = 16")


if __name__ == "__main__":
    visualize("ex02_cr_and_p1.png")
