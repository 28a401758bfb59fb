"""A program as a user writes it with annotations: `make lint` checks its types, a test runs it."""

# mypy: disallow-untyped-calls

import numpy as np

import signorini


def height(x: object, y: object) -> object:
    """A datum."""
    return 0.1


def solved(n: int) -> signorini.Solution:
    """The solution of level n, and what it tells."""
    mesh: signorini.Mesh = signorini.rectangle(n, size=(2, 1)).refined()
    problem: signorini.Problem = signorini.problem(
        mesh,
        "P1",
        f=-1,
        g={"left": "y", "right": height},
        dirichlet={"top": 0.0},
        contact=["bottom"],
        coefficient=2.0,
    )
    return signorini.solve(problem)


def bounds() -> list[float]:
    """What may be arrays, or come in any order; and a scene."""
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    triangle = signorini.polygon(corners, 4, sides=["floor", "slope", "wall"])
    square = signorini.rectangle(2, size=np.array([1.0, 1.0]))
    held = {"wall", "slope"}
    slanted = signorini.problem(triangle, f=-1, dirichlet=held, contact=("floor",))
    flat = signorini.problem(square, f=-1, dirichlet="top")
    scene: signorini.Scene = signorini.load_scene("config/scenes/punch.yaml")
    last: signorini.Problem = signorini.discretize(scene, "CR", scene.levels[0])
    found = [signorini.certify(signorini.solve(each)).upper for each in (slanted, flat)]
    residual, multiplier = signorini.kkt_residual(last, signorini.solve(last).u)
    return [*found, residual, float(multiplier.min())]


def told(solution: signorini.Solution) -> tuple[float, str, int]:
    """Some of it, by its types."""
    resultant: float = solution.resultant
    errors: dict[str, object] = solution.errors(solved(16), norms=["l2"])
    return resultant, solution.status, len(errors) + solution.at([[0.5], [0.5]]).size


if __name__ == "__main__":
    print(told(solved(4)))
