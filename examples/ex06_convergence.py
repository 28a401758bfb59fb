r"""A convergence study with pandas.

The exact solution `corner` of the library,

$$u = r^{3/2} \cos \tfrac{3}{2} \theta \quad \text{about the critical point},$$

is what every solution of a Signorini problem looks like where contact begins: there its second
derivatives are unbounded, so that $u$ is in $H^s$ for $s < 5/2$ only. Does that spoil the rates?
The theory says: not for affine elements.

`signorini.convergence` solves on every level and returns a table, one row for each solution;
`signorini.rates` fits the slopes. Both are tables of pandas, with the columns of `errors.csv` and
`rates.csv`, that the workflow writes for a scene.
"""

import signorini

EXACT = signorini.exact_solution("corner")
NORMS = ["l2", "h1_semi", "trace_l2", "multiplier_l2"]


def both_elements(n):
    """The problem of level n for P1 and CR; all data are derived from the exact solution."""
    mesh = signorini.rectangle(n, origin=(-1, 0), size=(2, 1))
    conditions = {"dirichlet": ["right", "top", "left"], "contact": "bottom", "exact": EXACT}
    return [signorini.problem(mesh, element, **conditions) for element in ("P1", "CR")]


errors = signorini.convergence(both_elements, levels=[8, 16, 32, 64], truth=EXACT, norms=NORMS)
print(errors[["element", "n", "dofs", *NORMS]].to_string(index=False, float_format="%.2e"))

rates = signorini.rates(errors).query("kind == 'fit'")
print(rates.pivot(index="norm", columns="element", values="slope").round(2).to_string())


def visualize(path=None):
    """The solution on the finest level: contact to the left of the origin."""
    solution = signorini.solve(both_elements(64)[1])
    return solution.plot(path, title="Where contact begins")


if __name__ == "__main__":
    visualize("ex06_convergence.png")
