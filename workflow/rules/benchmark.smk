# `snakemake benchmark`: time, memory and error of every element and route, and of the rivals; config/benchmark.yaml says
# of what. A measuring job takes all cores, so that nothing runs beside it.


rule benchmark_machine:
    input:
        library("benchmark_machine.py"),
    output:
        f"{BENCHMARK}/machine.json",
    log:
        f"{BENCHMARK}/logs/machine.log",
    priority: 100  # before this run is the load
    threads: all_cores
    params:
        content=content("benchmark_machine.py"),
    shell:
        "python3 workflow/scripts/benchmark_machine.py --output {output:q} 2>&1 | tee {log:q}"


rule benchmark_point:
    input:
        library("benchmark_point.py"),
        machine=ancient(f"{BENCHMARK}/machine.json"),
        before=point_before,
        solution="results/{scene}/solutions/{element}/n{n}.npz",
    output:
        f"{BENCHMARK}/points/{{scene}}/{{element}}/{{method}}/n{{n}}.csv",
    log:
        f"{BENCHMARK}/logs/points/{{scene}}_{{element}}_{{method}}_n{{n}}.log",
    threads: all_cores
    params:
        content=content("benchmark_point.py"),
        statement=statement,
        repeats=lambda wildcards: as_json(measured()["repeats"]),
        limits=lambda wildcards: as_json(measured()["limits"]),
        before=lambda wildcards, input: (
            f"--before {quote(str(input.before))}" if input.before else ""
        ),
        warm_up=lambda wildcards: max(int(wildcards.n) // 2, scene(wildcards.scene).levels[0]),
    shell:
        "python3 workflow/scripts/benchmark_point.py --statement {params.statement:q} --scene {wildcards.scene}"
        " --element {wildcards.element} --n {wildcards.n} --method {wildcards.method} --warm-up {params.warm_up}"
        " --repeats {params.repeats:q} --limits {params.limits:q} {params.before} --solution {input.solution:q}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule benchmark_rival:
    input:
        library("benchmark_rival.py"),
        machine=ancient(f"{BENCHMARK}/machine.json"),
        mesh=mesh_file,
    output:
        f"{BENCHMARK}/rivals/{{scene}}/{{element}}/{{rival}}.csv",
    log:
        f"{BENCHMARK}/logs/rivals/{{scene}}_{{element}}_{{rival}}.log",
    threads: all_cores
    params:
        content=content("benchmark_rival.py"),
        statement=statement,
        levels=lambda wildcards: as_json(measured()["rivals"]["levels"]),
        seconds=lambda wildcards: measured()["rivals"]["seconds"],
    shell:
        "python3 workflow/scripts/benchmark_rival.py --statement {params.statement:q} --mesh {input.mesh:q}"
        " --scene {wildcards.scene} --element {wildcards.element} --rival {wildcards.rival}"
        " --levels {params.levels:q} --seconds {params.seconds} --output {output:q} 2>&1 | tee {log:q}"


use rule reference as benchmark_reference with:
    output:
        f"{BENCHMARK}/references/{{scene}}.npz",
    log:
        f"{BENCHMARK}/logs/reference_{{scene}}.log",
    benchmark:
        f"{BENCHMARK}/benchmarks/reference_{{scene}}.tsv"
    params:
        content=content("solve"),
        statement=statement,
        method=method,
        element="P1",
        n=lambda wildcards: measured()["scenes"][wildcards.scene]["reference"],


use rule errors as benchmark_errors with:
    input:
        library("errors"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        reference=lambda wildcards: [f"{BENCHMARK}/references/{wildcards.scene}.npz"]
        * (scene(wildcards.scene).truth["kind"] == "reference"),
        solutions=lambda wildcards: [
            f"results/{wildcards.scene}/solutions/{element}/n{n}.npz"
            for element in scene(wildcards.scene).elements
            for n in shown_levels(wildcards.scene)
        ],
    output:
        f"{BENCHMARK}/errors/{{scene}}.csv",
    log:
        f"{BENCHMARK}/logs/errors_{{scene}}.log",
    benchmark:
        f"{BENCHMARK}/benchmarks/errors_{{scene}}.tsv"
    params:
        content=content("errors"),
        asked=parts("norm_quadrature"),
        truth=lambda wildcards: as_json(truth_part(wildcards)),
        norms="--norms l2 h1_semi h1",
        reference=reference_option,


rule benchmark_gather:
    input:
        library("benchmark_gather.py"),
        points=points,
        rivals=duels,
        errors=lambda wildcards: [f"{BENCHMARK}/errors/{name}.csv" for name in measured()["scenes"]],
        coarse=bending_files,
    output:
        points=f"{BENCHMARK}/benchmark.csv",
        rivals=f"{BENCHMARK}/rivals.csv",
        summary=f"{BENCHMARK}/summary.json",
    log:
        f"{BENCHMARK}/logs/gather.log",
    params:
        content=content("benchmark_gather.py"),
        files=lambda wildcards, input: as_json(
            {key: list(input[key]) for key in ("points", "rivals", "errors", "coarse")}
        ),
        asked=lambda wildcards: as_json(errors_asked()),
    shell:
        "python3 workflow/scripts/benchmark_gather.py --files {params.files:q} --asked {params.asked:q}"
        " --points {output.points:q} --rivals {output.rivals:q} --summary {output.summary:q} 2>&1 | tee {log:q}"


rule benchmark_figure:
    input:
        library("figure_benchmark.py"),
        points=f"{BENCHMARK}/benchmark.csv",
        rivals=f"{BENCHMARK}/rivals.csv",
        summary=f"{BENCHMARK}/summary.json",
    output:
        pdf=f"{BENCHMARK}/benchmark_{{figure}}.pdf",
        png=f"{BENCHMARK}/benchmark_{{figure}}.png",
    log:
        f"{BENCHMARK}/logs/figure_{{figure}}.log",
    params:
        content=content("figure_benchmark.py"),
    shell:
        "python3 workflow/scripts/figure_benchmark.py --figure {wildcards.figure} --points {input.points:q}"
        " --rivals {input.rivals:q} --summary {input.summary:q} {output:q} 2>&1 | tee {log:q}"


# The page comes last, so that where it is there are its figures.
rule benchmark:
    input:
        library("benchmark_report.py"),
        expand(
            f"{BENCHMARK}/benchmark_{{figure}}.{{ending}}",
            figure=BENCHMARK_FIGURES,
            ending=["pdf", "png"],
        ),
        points=f"{BENCHMARK}/benchmark.csv",
        rivals=f"{BENCHMARK}/rivals.csv",
        summary=f"{BENCHMARK}/summary.json",
        machine=ancient(f"{BENCHMARK}/machine.json"),
    output:
        tex=f"{BENCHMARK}/benchmark.tex",
        markdown=f"{BENCHMARK}/benchmark.md",
    log:
        f"{BENCHMARK}/logs/report.log",
    params:
        content=content("benchmark_report.py"),
        asked=lambda wildcards: as_json(measured() | {"truths": own_references()}),
    shell:
        "python3 workflow/scripts/benchmark_report.py --points {input.points:q} --rivals {input.rivals:q}"
        " --summary {input.summary:q} --machine {input.machine:q} --asked {params.asked:q} --tex {output.tex:q}"
        " --markdown {output.markdown:q} 2>&1 | tee {log:q}"
