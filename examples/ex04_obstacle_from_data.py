r"""An obstacle from data: a floor that was measured.

The obstacle need not be a formula. Here it is a floor whose height was measured at a dozen
stations, and runs straight between them:

$$u \ge \alpha \quad \text{on the bottom}, \qquad
\alpha = \text{interpolation of the measurements}.$$

Any function of the coordinates will do that takes arrays of x and y and returns an array of the
same shape: `np.interp` is one, a spline of SciPy or an image would be others.

Such an obstacle has kinks, and the membrane touches it in several places: on top of each bump.
"""

import numpy as np

import signorini

# Station and height of the floor, in metres.
STATION = np.array([0.0, 0.4, 0.7, 1.0, 1.3, 1.6, 2.0, 2.3, 2.7, 3.1, 3.5, 4.0])
HEIGHT = np.array([0.00, 0.02, 0.09, 0.03, 0.01, 0.05, 0.12, 0.04, 0.00, 0.07, 0.02, 0.00]) - 0.15


def floor(x, y):
    """Height of the floor at stations x; it does not depend on y."""
    return np.interp(x, STATION, HEIGHT)


mesh = signorini.rectangle(32, size=(4, 1))
problem = signorini.problem(
    mesh, "P1", f=-0.25, obstacle=floor, dirichlet={"top": 0}, contact="bottom"
)
solution = signorini.solve(problem)

# A row for each contact unknown, in order along the floor. A patch of contact ends where an unknown
# that binds has a neighbour that does not.
line = solution.contact_line()
patch = (line["binding"].diff() == 1).cumsum()
touching = line[line["binding"] == 1]
patches = touching.groupby(patch).agg(first=("x", "min"), last=("x", "max"), peak=("flux", "max"))
print(f"{len(touching)} of {len(line)} contact unknowns bind, in {len(patches)} patches:")
print(patches.round(3).to_string(index=False))


def visualize(path=None):
    """u over the obstacle, and below it the contact force: peaks where the floor has corners."""
    return solution.plot_contact(path)


if __name__ == "__main__":
    visualize("ex04_obstacle_from_data.png")
