# `snakemake benchmark`: time, memory and error of every element and route, and of the rivals; config/benchmark.yaml says
# of what. A measuring job takes all cores, so that nothing runs beside it.


# Written once: no edit makes it again while the measurements stay. As an ancient input that another job of the run makes,
# it would also hide from Snakemake that what it precedes has changed.
rule benchmark_machine:
    output:
        f"{BENCHMARK}/machine.json",
    log:
        f"{BENCHMARK}/logs/machine.log",
    priority: 100  # before this run is the load
    threads: all_cores
    shell:
        "python3 -m signorini benchmark machine -o {output:q} 2>&1 | tee {log:q}"


rule benchmark_point:
    input:
        library("benchmark point", method=routes),
        scene=ancient(scene_file),
        machine=ancient(f"{BENCHMARK}/machine.json"),
        before=point_before,
        solution=measured_solution,
        settings=ancient(BENCHMARK_SETTINGS),
    output:
        f"{BENCHMARK}/points/{{scene}}/{{element}}/{{method}}/n{{n}}.csv",
    log:
        f"{BENCHMARK}/logs/points/{{scene}}_{{element}}_{{method}}_n{{n}}.log",
    threads: all_cores
    params:
        content=content("benchmark point"),
        statement=statement,
        measured=benchmark_settings("repeats", "limits"),
        before=lambda wildcards, input: (
            f"--before {quote(str(input.before))}" if input.before else ""
        ),
        coarsest=lambda wildcards: scene(wildcards.scene).levels[0],
        settings=SETTINGS,
    shell:
        "python3 -m signorini benchmark point {input.scene:q} --element {wildcards.element}"
        " --n {wildcards.n} --method {wildcards.method} --solution {input.solution:q} {params.before}"
        " {params.settings} -o {output:q} 2>&1 | tee {log:q}"


rule benchmark_rival:
    input:
        library("benchmark rival", rival=rivals),
        scene=ancient(scene_file),
        machine=ancient(f"{BENCHMARK}/machine.json"),
        mesh=mesh_file,
        settings=ancient(BENCHMARK_SETTINGS),
    output:
        f"{BENCHMARK}/rivals/{{scene}}/{{element}}/{{rival}}.csv",
    log:
        f"{BENCHMARK}/logs/rivals/{{scene}}_{{element}}_{{rival}}.log",
    threads: all_cores
    params:
        content=content("benchmark rival"),
        statement=statement,
        measured=benchmark_settings("rivals"),
        settings=SETTINGS,
    shell:
        "python3 -m signorini benchmark rival {input.scene:q} --element {wildcards.element}"
        " --rival {wildcards.rival} --mesh {input.mesh:q} {params.settings} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule benchmark_guarantee:
    input:
        library("benchmark guarantee", scene=guaranteed_scene_names),
        scene=ancient(scene_file),
        machine=ancient(f"{BENCHMARK}/machine.json"),
        settings=ancient(BENCHMARK_SETTINGS),
    output:
        f"{BENCHMARK}/guaranteed/{{scene}}.csv",
    log:
        f"{BENCHMARK}/logs/guaranteed_{{scene}}.log",
    threads: all_cores
    params:
        content=content("benchmark guarantee"),
        statement=statement,
        start=lambda wildcards: scene(wildcards.scene).levels[0],
        measured=benchmark_settings("guaranteed"),
        settings=SETTINGS,
    shell:
        "python3 -m signorini benchmark guarantee {input.scene:q} {params.settings} -o {output:q}"
        " 2>&1 | tee {log:q}"


# Multigrid only as far as it pays: its solutions have errors of their own.
rule benchmark_rough:
    input:
        library("solve", scene=benchmark_scene_names),
        scene=ancient(scene_file),
        mesh=mesh_file,
    output:
        f"{BENCHMARK}/rough/{{scene}}/solutions/{{element}}/n{{n}}.npz",
    log:
        f"{BENCHMARK}/logs/rough/{{scene}}_{{element}}_n{{n}}.log",
    benchmark:
        f"{BENCHMARK}/benchmarks/rough_{{scene}}_{{element}}_n{{n}}.tsv"
    params:
        content=content("solve"),
        statement=statement,
    shell:
        "python3 -m signorini solve {input.scene:q} --element {wildcards.element} --n {wildcards.n}"
        " --mesh {input.mesh:q} --method multigrid --accuracy discretisation -o {output:q}"
        " 2>&1 | tee {log:q}"


use rule reference as benchmark_reference with:
    output:
        f"{BENCHMARK}/references/{{scene}}.npz",
    log:
        f"{BENCHMARK}/logs/reference_{{scene}}.log",
    benchmark:
        f"{BENCHMARK}/benchmarks/reference_{{scene}}.tsv"
    resources:
        mem_mb=asked_by_reference(asked_memory, "P1", benchmark_reference_level),
        runtime=asked_by_reference(asked_minutes, "P1", benchmark_reference_level),
    params:
        content=content("solve"),
        statement=statement,
        method=method,
        element="P1",
        n=benchmark_reference_level,


use rule errors as benchmark_errors with:
    input:
        library("errors", scene=benchmark_scene_names),
        scene=ancient(scene_file),
        mesh=mesh_file,
        reference=benchmark_truth,
        solutions=shown_solutions("results"),
    output:
        f"{BENCHMARK}/errors/{{scene}}.csv",
    log:
        f"{BENCHMARK}/logs/errors_{{scene}}.log",
    benchmark:
        f"{BENCHMARK}/benchmarks/errors_{{scene}}.tsv"
    resources:
        mem_mb=asked_megabytes(cost_of_shown_errors),
        runtime=asked_runtime(cost_of_shown_errors),
    params:
        content=content("errors"),
        asked=parts("norm_quadrature"),
        truth=lambda wildcards: as_json(truth_part(wildcards)),
        norms="--norms l2 h1_semi h1",
        reference=reference_option,


use rule benchmark_errors as benchmark_rough_errors with:
    input:
        library("errors", scene=benchmark_scene_names),
        scene=ancient(scene_file),
        mesh=mesh_file,
        reference=benchmark_truth,
        solutions=shown_solutions(f"{BENCHMARK}/rough"),
    output:
        f"{BENCHMARK}/errors/rough/{{scene}}.csv",
    log:
        f"{BENCHMARK}/logs/rough_errors_{{scene}}.log",
    benchmark:
        f"{BENCHMARK}/benchmarks/rough_errors_{{scene}}.tsv"


rule benchmark_gather:
    input:
        library("benchmark gather"),
        scenes=ancient(benchmark_scenes),
        points=points,
        rivals=rival_files,
        guaranteed=guaranteed_files,
        errors=benchmark_error_tables("errors"),
        rough=benchmark_error_tables("errors/rough"),
        coarse=coarse_errors,
        settings=ancient(BENCHMARK_SETTINGS),
    output:
        points=f"{BENCHMARK}/benchmark.csv",
        rivals=f"{BENCHMARK}/rivals.csv",
        guaranteed=f"{BENCHMARK}/benchmark_guaranteed.csv",
        summary=f"{BENCHMARK}/summary.json",
    log:
        f"{BENCHMARK}/logs/gather.log",
    params:
        content=content("benchmark gather"),
        measured=benchmark_settings("scenes"),
        asked=benchmark_errors_asked,
        folder=subpath(output[0], parent=True),
        settings=SETTINGS,
    shell:
        "python3 -m signorini benchmark gather --scenes {input.scenes:q} --points {input.points:q}"
        " --rivals {input.rivals:q} --errors {input.errors:q} --rough {input.rough:q}"
        " --coarse {input.coarse:q} --guaranteed {input.guaranteed:q}"
        " {params.settings} -o {params.folder:q} 2>&1 | tee {log:q}"


rule benchmark_figure:
    input:
        library("benchmark figure", figure=BENCHMARK_FIGURES),
        points=f"{BENCHMARK}/benchmark.csv",
        rivals=f"{BENCHMARK}/rivals.csv",
        guaranteed=f"{BENCHMARK}/benchmark_guaranteed.csv",
        summary=f"{BENCHMARK}/summary.json",
    output:
        pdf=f"{BENCHMARK}/benchmark_{{figure}}.pdf",
        png=f"{BENCHMARK}/benchmark_{{figure}}.png",
    log:
        f"{BENCHMARK}/logs/figure_{{figure}}.log",
    params:
        content=content("benchmark figure"),
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini benchmark figure {params.folder:q} --figure {wildcards.figure}"
        " -o {output:q} 2>&1 | tee {log:q}"


# The page comes last, so that where it is there are its figures.
rule benchmark:
    """How fast the routes are, beside other solvers on the same matrices."""
    input:
        library("benchmark report"),
        expand(
            f"{BENCHMARK}/benchmark_{{figure}}.{{ending}}",
            figure=BENCHMARK_FIGURES,
            ending=["pdf", "png"],
        ),
        scenes=ancient(benchmark_scenes),
        points=f"{BENCHMARK}/benchmark.csv",
        rivals=f"{BENCHMARK}/rivals.csv",
        guaranteed=f"{BENCHMARK}/benchmark_guaranteed.csv",
        summary=f"{BENCHMARK}/summary.json",
        machine=ancient(f"{BENCHMARK}/machine.json"),
        settings=ancient(BENCHMARK_SETTINGS),
    output:
        tex=f"{BENCHMARK}/benchmark.tex",
        markdown=f"{BENCHMARK}/benchmark.md",
        tables=expand(
            f"{BENCHMARK}/benchmark_{{table}}.csv",
            table=["reach", "bias", "comparisons", "accuracy"],
        ),
    log:
        f"{BENCHMARK}/logs/report.log",
    params:
        content=content("benchmark report"),
        measured=benchmark_settings(),
        truths=lambda wildcards: as_json([scene(name).truth for name in measured()["scenes"]]),
        folder=subpath(output[0], parent=True),
        settings=SETTINGS,
    shell:
        "python3 -m signorini benchmark report {params.folder:q} --scenes {input.scenes:q}"
        " {params.settings} 2>&1 | tee {log:q}"
