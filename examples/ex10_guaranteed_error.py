r"""A guaranteed error: how good is a solution that nobody knows?

A body with a notch is pressed on its foundation. Its solution has no formula; a finer mesh would
give another approximation, and so only another guess. But P1 and CR on the *same* mesh say for
certain how far each of them is from the solution of the continuous problem:

$$\text{lower} \le
\left( \int_\Omega \lvert \nabla (u - u_h) \rvert^2 \right)^{1/2} \le \text{upper} .$$

The P1 solution is admissible, so that its energy is too high. From the CR solution follows a flux
that is in equilibrium with the load, so that its energy is too low. What lies between the two
bounds the errors of both, by a theorem that is older than finite elements (Prager and Synge, 1947);
docs/certificate.md has the proof.
"""

import signorini

CORNERS = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
SIDES = ["foundation", "right", "notch", "notch", "top", "left"]


def pressed(n, element):
    """The L-shaped body, held at the notch and the top."""
    mesh = signorini.polygon(CORNERS, n, sides=SIDES)
    held = {"notch": 0, "top": 0}
    return signorini.problem(mesh, element, f="10*(1 - x)", dirichlet=held, contact="foundation")


found = {}
for n in (4, 8, 16, 32):
    for element in ("P1", "CR"):
        found[element, n] = signorini.certify(pressed(n, element))
        bound = found[element, n]
        print(f"{element} n = {n:2d}: the error lies in [{bound.lower:.4f}, {bound.upper:.4f}]")


def visualize(path=None):
    """Where the error of CR is: what each triangle adds to the square of the bound."""
    import matplotlib.pyplot as plt
    from matplotlib.colors import LogNorm

    mesh = pressed(8, "CR").mesh
    squared = found["CR", 8].contributions
    shares = squared / squared.sum()
    figure, axes = plt.subplots(figsize=(5, 4), layout="constrained")
    scale = {"norm": LogNorm(1e-4, 1e-1), "cmap": plt.get_cmap("Blues", 12)}
    picture = axes.tripcolor(*mesh.p, mesh.t.T, shares, **scale)
    figure.colorbar(picture, label="share of the squared bound", extend="both")
    axes.set(aspect="equal", xlabel="$x$", ylabel="$y$", title="Where the error is")
    if path:
        figure.savefig(path)
    return figure


if __name__ == "__main__":
    visualize("ex10_guaranteed_error.png")
