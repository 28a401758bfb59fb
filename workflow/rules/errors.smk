# From solutions to numbers: errors against the reference, and their slopes.


rule errors:
    input:
        library("errors.py"),
        mesh=mesh_file,
        reference="results/{scene}/reference.npz",
        solutions=solution_files,
    output:
        "results/{scene}/errors.csv",
    log:
        "results/{scene}/logs/errors.log",
    benchmark:
        "results/{scene}/benchmarks/errors.tsv"
    priority: 8
    params:
        norms=lambda wildcards: ",".join(scene(wildcards.scene).document["norms"]),
        quadrature=lambda wildcards: scene(wildcards.scene).document["norm_quadrature"],
    shell:
        "python3 workflow/scripts/errors.py --mesh {input.mesh:q} --reference {input.reference:q}"
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
    shell:
        "python3 workflow/scripts/rates.py --errors {input.errors:q} --output {output:q} 2>&1 | tee {log:q}"
