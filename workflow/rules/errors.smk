# From solutions to numbers: errors against the truth, their slopes, and whether they are what the scene expects.


rule errors:
    input:
        library("errors.py"),
        mesh=mesh_file,
        reference=reference_file,
        solutions=solution_files,
    output:
        "results/{scene}/errors.csv",
    log:
        "results/{scene}/logs/errors.log",
    benchmark:
        "results/{scene}/benchmarks/errors.tsv"
    priority: 8
    params:
        content=content("errors.py"),
        norms=in_table,
        truth=truth_option,
        quadrature=lambda wildcards: scene(wildcards.scene).document["norm_quadrature"],
    shell:
        "python3 workflow/scripts/errors.py --scene-file config/scenes/{wildcards.scene}.yaml"
        " --mesh {input.mesh:q} {params.truth}"
        " --norms {params.norms} --quadrature {params.quadrature}"
        " --output {output:q} {input.solutions:q} 2>&1 | tee {log:q}"


rule rates:
    input:
        library("rates.py"),
        errors="results/{scene}/errors.csv",
    output:
        "results/{scene}/rates.csv",
    log:
        "results/{scene}/logs/rates.log",
    priority: 6
    params:
        content=content("rates.py"),
        asked=asked_rows,
    shell:
        "python3 workflow/scripts/rates.py --errors {input.errors:q} --asked {params.asked:q} --output {output:q}"
        " 2>&1 | tee {log:q}"


rule expect:
    input:
        library("expect.py"),
        errors="results/{scene}/errors.csv",
        rates=lambda wildcards: ["results/{scene}/rates.csv"] * bool(expected(wildcards)["slopes"]),
    output:
        "results/{scene}/expect.txt",
    log:
        "results/{scene}/logs/expect.log",
    params:
        content=content("expect.py"),
        asked=asked_rows,
        expected=lambda wildcards: as_json(expected(wildcards)),
        slope=lambda wildcards: scene(wildcards.scene).document["slope"],
        rates=lambda wildcards, input: f"--rates {quote(str(input.rates))}" if input.rates else "",
    shell:
        "python3 workflow/scripts/expect.py --expected {params.expected:q} --slope {params.slope}"
        " --asked {params.asked:q} --errors {input.errors:q} {params.rates} --output {output:q} 2>&1 | tee {log:q}"
