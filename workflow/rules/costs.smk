# What a solve asks of a cluster, by the cost model that the benchmark fitted; nothing runs again for it. A job that is
# ended and retried asks for twice as much.
from signorini.scene.costs import asked_memory, asked_minutes


def asked_by_solve(cost):
    """A resource of a rule whose wildcards say what it solves."""

    def asked(wildcards, attempt):
        return asked_of(cost, wildcards, wildcards.element, int(wildcards.n), attempt)

    return asked


def asked_by_reference(cost, element=None, n=None):
    """A resource of a rule that solves a reference; functions say which, unless the scene does."""

    def asked(wildcards, attempt):
        truth = scene(wildcards.scene).truth
        level = n(wildcards) if n else truth["n"]
        return asked_of(cost, wildcards, element or truth["element"], level, attempt)

    return asked


def asked_of(cost, wildcards, element, n, attempt):
    asked = scene(wildcards.scene)
    route = asked.document["solver"]["method"]
    return cost(asked.problem_statement, element, n, route, attempt)
