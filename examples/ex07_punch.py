r"""A punch: contact between two critical points, and its force.

The family `punch` of exact solutions has contact for $\lvert x \rvert \le a$ on the line $y = 0$,
where

$$\partial_\nu u = \sqrt{a^2 - x^2},$$

which is the pressure that Hertz found under a cylinder pressed against a half space. At both ends
its derivative is unbounded. The whole force is half the area of a disc,

$$\int_{-a}^{a} \sqrt{a^2 - x^2} = \tfrac{1}{2} \pi a^2 .$$

The resultant is far more accurate than the pressure at the contact points: it converges with $h^2$,
and the pressure where it is worst, at the ends, hardly with $h^{1/2}$.
"""

import numpy as np

import signorini

A = 0.5
EXACT = signorini.exact_solution("punch", half_width=A)
FORCE = np.pi * A**2 / 2


def punch(element, n):
    """Solution of level n."""
    problem = signorini.problem(
        signorini.rectangle(n, origin=(-1, 0), size=(2, 1)),
        element,
        exact=EXACT,
        dirichlet=["right", "top", "left"],
        contact="bottom",
    )
    return signorini.solve(problem)


rows = []
for element in ("P1", "CR"):
    for n in (16, 32, 64):
        solution = punch(element, n)
        x, _ = solution.contact_points
        pressure = np.abs(solution.flux - EXACT.flux(x, 0.0, 0.0, -1.0)).max()
        ends = np.abs(np.abs(solution.critical_points[0]) - A).max()
        rows.append((element, n, solution.resultant / FORCE - 1.0, pressure, ends))
        print(
            f"{element} n = {n:2}: force {rows[-1][2]:+.1e} of itself, pressure {pressure:.1e}, "
            f"ends of contact {ends:.4f}"
        )


def visualize(path=None):
    """Above u, below the pressure: nearly a half ellipse."""
    return punch("CR", 64).plot_contact(path)


if __name__ == "__main__":
    visualize("ex07_punch.png")
