# What a job asks of a cluster, by cost models that were fitted to measurements; nothing runs again for it. A job that is
# ended and retried asks for twice as much.
from signorini.scene.costs import asked_memory, asked_minutes, megabytes_for, minutes_for
from signorini.scene.job_costs import certificate_cost, errors_cost


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


def asked_megabytes(cost):
    """A resource of a rule; a function of its wildcards says what seconds and bytes its job takes."""

    def asked(wildcards, attempt):
        domain = scene(wildcards.scene).problem_statement.domain
        return megabytes_for(cost(wildcards)[1], domain, attempt)

    return asked


def asked_runtime(cost):
    """Likewise, in minutes."""
    return lambda wildcards, attempt: minutes_for(cost(wildcards)[0], attempt)


def cost_of_errors(wildcards):
    return errors_cost(scene(wildcards.scene))


def cost_of_certificate(wildcards):
    return certificate_cost(scene(wildcards.scene), int(wildcards.n))


def cost_of_points(wildcards):
    """Of a bundle of a sweep; one that is not there is refused with its points."""
    jobs = forecast_of(wildcards.scene, int(wildcards.of))
    job = jobs[min(int(wildcards.bundle), len(jobs)) - 1]
    return job.seconds, job.memory
