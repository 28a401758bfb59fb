# What the benchmark's rules ask of config/benchmark.yaml.
BENCHMARK = f"{STUDIES}/benchmark"
BENCHMARK_FIGURES = ["error", "dofs", "growth", "stages", "rivals"]


@cache
@reported
def measured():
    """config/benchmark.yaml, checked, with what stands under quick in place of the rest where that is asked for."""
    source = "config/benchmark.yaml"
    asked = validated(
        load_yaml(source), load_yaml("workflow/schemas/benchmark.schema.yaml"), source
    )
    asked |= asked.get("quick", {}) if CONFIG["quick"] else {}
    for name, part in asked["scenes"].items():
        if scene(name).truth["kind"] != "exact" and "reference" not in part:
            raise SignoriniError(
                f"{source}: scenes.{name}.reference: missing; the scene has no exact solution, so name the level of a"
                " reference, four times the last level whose error is shown"
            )
    return asked


def measured_levels(name):
    """From the scene's coarsest level to the finest measured."""
    n, levels = scene(name).levels[0], []
    while n <= measured()["scenes"][name]["finest"]:
        levels.append(n)
        n *= 2
    return levels


def shown_levels(name):
    """The levels whose errors count: four times coarser than a reference."""
    finest = measured()["scenes"][name].get("reference", 4 * measured_levels(name)[-1]) // 4
    return [n for n in measured_levels(name) if n <= finest]


def points(wildcards):
    from signorini.solvers import (
        METHODS,
    )  # which needs NumPy: only where the benchmark is asked for

    return [
        f"{BENCHMARK}/points/{name}/{element}/{method}/n{n}.csv"
        for name in measured()["scenes"]
        for element in scene(name).elements
        for method in METHODS
        for n in measured_levels(name)
    ]


def point_before(wildcards):
    n = int(wildcards.n)
    return [str(Path(BENCHMARK, "points", *wildcards[:3], f"n{n // 2}.csv"))] * (
        n > scene(wildcards.scene).levels[0]
    )


def duels(wildcards):
    from signorini.studies.rivals import RIVALS

    return [
        f"{BENCHMARK}/rivals/{name}/{element}/{rival}.csv"
        for name in measured()["scenes"]
        for element in scene(name).elements
        for rival in RIVALS
    ]


def errors_asked():
    """The rows of errors that the summary needs, of each scene: on the levels shown here, and on the scene's own."""
    asked = {name: scene(name).section("elements", "levels") for name in measured()["scenes"]}
    return {
        "errors": {name: part | {"levels": shown_levels(name)} for name, part in asked.items()},
        "coarse": asked,
    }


def all_cores(wildcards):
    """As many as Snakemake was given; one where it was given none, as by `snakemake --unlock` or for a cluster."""
    return workflow.global_resources["_cores"].value or 1


def own_references():
    """Scene -> level of its own reference, where it has one."""
    truths = {name: scene(name).truth for name in measured()["scenes"]}
    return {name: truth["n"] for name, truth in truths.items() if truth["kind"] == "reference"}


def bending_files(wildcards):
    """The errors of the scenes whose own reference is coarser than the benchmark's."""
    asked = measured()["scenes"]
    return [
        f"results/{name}/errors.csv"
        for name, n in own_references().items()
        if asked[name]["reference"] > n
    ]
