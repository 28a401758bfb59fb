# What the benchmark's rules ask of config/benchmark.yaml.
BENCHMARK = f"{STUDIES}/benchmark"
BENCHMARK_FIGURES = ["error", "dofs", "growth", "guaranteed", "rivals"]


BENCHMARK_SETTINGS = "config/benchmark.yaml"
# Options of the commands that read the settings.
SETTINGS = f"--settings {BENCHMARK_SETTINGS} {QUICK_OPTION}"

from signorini.studies.benchmark.settings import (
    check_references,
    coarse_references,
    measured_levels,
    read_settings,
    shown_levels,
)


@cache
@reported
def measured():
    """The settings, checked."""
    settings = read_settings(BENCHMARK_SETTINGS, QUICK)
    check_references(
        settings, {name: scene(name) for name in settings["scenes"]}, BENCHMARK_SETTINGS
    )
    return settings


def benchmark_settings(*keys):
    """A parameter: the settings on which a job depends, or all."""
    return lambda wildcards: as_json({key: measured()[key] for key in keys or measured()})


def benchmark_scenes(wildcards):
    return [validated_file(name) for name in measured()["scenes"]]


def benchmark_errors_asked(wildcards):
    """A parameter: the elements and levels of each scene, its own and those shown."""
    asked = [scene(name) for name in measured()["scenes"]]
    return as_json([[s.elements, s.levels, shown_levels(measured(), s)] for s in asked])


def benchmark_scene_names():
    return measured()["scenes"]


@reported
def benchmark_reference_level(wildcards):
    check_known("benchmark", "scene", wildcards.scene, benchmark_scene_names)
    return measured()["scenes"][wildcards.scene]["reference"]


def guaranteed_scene_names():
    return measured()["guaranteed"]["scenes"]


def guaranteed_files(wildcards):
    return [f"{BENCHMARK}/guaranteed/{name}.csv" for name in guaranteed_scene_names()]


def routes():
    from signorini.studies.benchmark.routes import ROUTES  # NumPy: only for the benchmark

    return list(ROUTES)


def rough():
    from signorini.studies.benchmark.routes import ROUGH  # NumPy: only for the benchmark

    return ROUGH


def measured_solution(wildcards):
    """Where the solution is whose errors a point has."""
    folder = f"{BENCHMARK}/rough" if wildcards.method == rough() else "results"
    return f"{folder}/{wildcards.scene}/solutions/{wildcards.element}/n{wildcards.n}.npz"


def shown_solutions(folder):
    """An input: the solutions of a scene whose errors are shown, below a folder."""

    def found(wildcards):
        levels = shown_levels(measured(), scene(wildcards.scene))
        return [
            f"{folder}/{wildcards.scene}/solutions/{element}/n{n}.npz"
            for element in scene(wildcards.scene).elements
            for n in levels
        ]

    return found


def cost_of_shown_errors(wildcards):
    """Seconds and bytes; the benchmark has references of its own."""
    asked = scene(wildcards.scene)
    if asked.truth["kind"] == "reference":
        return errors_cost(asked, benchmark_reference_level(wildcards))
    return errors_cost(asked, max(shown_levels(measured(), asked)))


def benchmark_truth(wildcards):
    needed = scene(wildcards.scene).truth["kind"] == "reference"
    return [f"{BENCHMARK}/references/{wildcards.scene}.npz"] * needed


def rivals():
    from signorini.rivals import RIVALS  # NumPy: only for the benchmark

    return list(RIVALS)


def points(wildcards):
    return [
        f"{BENCHMARK}/points/{name}/{element}/{method}/n{n}.csv"
        for name in measured()["scenes"]
        for element in scene(name).elements
        for method in routes()
        for n in measured_levels(measured(), scene(name))
    ]


def point_before(wildcards):
    n = int(wildcards.n)
    return [str(Path(BENCHMARK, "points", *wildcards[:3], f"n{n // 2}.csv"))] * (
        n > scene(wildcards.scene).levels[0]
    )


def rival_files(wildcards):
    return [
        f"{BENCHMARK}/rivals/{name}/{element}/{rival}.csv"
        for name in measured()["scenes"]
        for element in scene(name).elements
        for rival in rivals()
    ]


def all_cores(wildcards):
    """As many as Snakemake was given; one where it was given none, as by `snakemake --unlock` or for a cluster."""
    return workflow.global_resources["_cores"].value or 1


def benchmark_error_tables(folder):
    """An input: the errors of every scene."""
    return lambda wildcards: [f"{BENCHMARK}/{folder}/{name}.csv" for name in measured()["scenes"]]


def coarse_errors(wildcards):
    """The errors of the scenes whose own reference is coarser than the benchmark's."""
    scenes = [scene(name) for name in measured()["scenes"]]
    return [f"results/{name}/errors.csv" for name in coarse_references(measured(), scenes)]
