"""A program as a user writes it with annotations: `make lint` checks its types, a test runs it."""

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


def told(solution: signorini.Solution) -> tuple[float, str, int]:
    """Some of it, by its types."""
    resultant: float = solution.resultant
    errors: dict[str, object] = solution.errors(solved(16), norms=["l2"])
    return resultant, solution.status, len(errors) + solution.at([[0.5], [0.5]]).size


if __name__ == "__main__":
    print(told(solved(4)))
