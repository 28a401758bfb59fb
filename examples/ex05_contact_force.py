r"""Contact force and resultant: who carries the load?

The contact force is $k \thinspace \partial_\nu u$ on the contact part. Its integral, the resultant,
need not be computed from a gradient, which would cost an order of accuracy. Test the discrete
equation with $v = 1$:

$$0 = a(u, 1) = \int_\Omega f + \int_{\Gamma_N} g +
\text{reaction of the Dirichlet part} + \text{resultant},$$

since 1 has no gradient. So the discrete forces balance exactly, on every mesh: what the load brings
is carried by the floor and by the support, to the last digit but rounding. What converges is how
the two share it.
"""

import numpy as np

import signorini


def forces(element, n):
    """Load, reaction of the support, and contact force."""
    problem = signorini.problem(
        signorini.rectangle(n),
        element,
        f="10*sin(2*pi*x) - 1",
        obstacle=-0.05,
        dirichlet={"top": 0},
        contact="bottom",
    )
    solution = signorini.solve(problem)
    imbalance = problem.apply(solution.u) - problem.b  # zero but where something holds u
    return solution, problem.b.sum(), imbalance[problem.fixed].sum(), solution.resultant


table = {}
for element in ("P1", "CR"):
    for n in (4, 8, 16, 32):
        solution, load, reaction, resultant = forces(element, n)
        table[element, n] = load, reaction, resultant
        print(
            f"{element} n = {n:2}: load {load:+.6f}  support {reaction:+.6f}  "
            f"floor {resultant:+.6f}  sum {load + reaction + resultant:+.0e}"
        )

# Per length, the force is the flux at the contact points. Where nothing touches it is zero.
line = solution.contact_line()
print(f"largest pressure {line['flux'].max():.4f} at x = {line['x'][line['flux'].idxmax()]:.3f}")
assert np.all(line["flux"][line["binding"] == 0] == 0.0)


def visualize(path=None):
    """Above u and the floor, below the contact force per length."""
    return solution.plot_contact(path)


if __name__ == "__main__":
    visualize("ex05_contact_force.png")
