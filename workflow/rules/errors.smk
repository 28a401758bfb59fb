# From solutions to numbers: errors against the truth, their slopes, and whether they are what the scene expects.


rule errors:
    input:
        library("errors"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        reference=reference_file,
        solutions=solution_files,
    output:
        report(
            "results/{scene}/errors.csv",
            caption="../report/errors.rst",
            category="{scene}",
            labels={"shows": "2 errors of every solution"},
        ),
    log:
        "results/{scene}/logs/errors.log",
    benchmark:
        "results/{scene}/benchmarks/errors.tsv"
    priority: 8
    resources:
        mem_mb=asked_megabytes(cost_of_errors),
        runtime=asked_runtime(cost_of_errors),
    params:
        content=content("errors"),
        asked=parts("norms", "norm_quadrature"),
        truth=lambda wildcards: as_json(truth_part(wildcards)),
        norms="",
        reference=reference_option,
    shell:
        "python3 -m signorini errors {input.scene:q} {input.solutions:q} --mesh {input.mesh:q}"
        " {params.reference} {params.norms} -o {output:q} 2>&1 | tee {log:q}"


# The quantities that a scene asks for, of each solution and of the reference.
rule outputs:
    input:
        library("outputs"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        reference=reference_file,
        solutions=solution_files,
    output:
        "results/{scene}/outputs.csv",
    log:
        "results/{scene}/logs/outputs.log",
    benchmark:
        "results/{scene}/benchmarks/outputs.tsv"
    params:
        content=content("outputs"),
        asked=parts("quantities"),
        statement=statement,
    shell:
        "python3 -m signorini outputs {input.scene:q} {input.solutions:q} {input.reference:q}"
        " --mesh {input.mesh:q} -o {output:q} 2>&1 | tee {log:q}"


# Active-set steps beside those of a plain active set.
rule steps:
    input:
        library("steps"),
        scene=ancient(scene_file),
    output:
        "results/{scene}/steps.csv",
    log:
        "results/{scene}/logs/steps.log",
    params:
        content=content("steps"),
        asked=parts("elements", "levels"),
        statement=statement,
        method=method,
    shell:
        "python3 -m signorini steps {input.scene:q} -o {output:q} 2>&1 | tee {log:q}"


rule rates:
    input:
        library("rates"),
        scene=ancient(scene_file),
        errors="results/{scene}/errors.csv",
    output:
        "results/{scene}/rates.csv",
    log:
        "results/{scene}/logs/rates.log",
    priority: 6
    params:
        content=content("rates"),
        asked=parts("elements", "levels"),
    shell:
        "python3 -m signorini rates {input.scene:q} {input.errors:q} -o {output:q} 2>&1 | tee {log:q}"


rule expect:
    input:
        library("expect"),
        scene=ancient(scene_file),
        errors="results/{scene}/errors.csv",
        rates=lambda wildcards: ["results/{scene}/rates.csv"]
        * bool(scene(wildcards.scene).document["expect"]["slopes"]),
    output:
        "results/{scene}/expect.txt",
    log:
        "results/{scene}/logs/expect.log",
    params:
        content=content("expect"),
        asked=parts("elements", "levels", "norms", "slope", "expect"),
        rates=lambda wildcards, input: f"--rates {quote(str(input.rates))}" if input.rates else "",
    shell:
        "python3 -m signorini expect {input.scene:q} {input.errors:q} {params.rates} -o {output:q}"
        " 2>&1 | tee {log:q}"
