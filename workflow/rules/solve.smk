# One job per element and level, and one for the reference: each discretises, solves, and stores u with its proof.
# Priorities follow the longest chain, from the reference by errors and rates to their figures.


rule solve:
    input:
        library("solve"),
        scene=ancient(scene_file),
        mesh=mesh_file,
    output:
        "results/{scene}/solutions/{element}/n{n}.npz",
    log:
        "results/{scene}/logs/solve/{element}_n{n}.log",
    benchmark:
        "results/{scene}/benchmarks/solve/{element}_n{n}.tsv"
    priority: 9
    resources:
        mem_mb=asked_by_solve(asked_memory),
        runtime=asked_by_solve(asked_minutes),
    params:
        content=content("solve"),
        statement=statement,
        method=method,
        accuracy=accuracy,
    shell:
        "python3 -m signorini solve {input.scene:q} --element {wildcards.element} --n {wildcards.n}"
        " --mesh {input.mesh:q} -o {output:q} 2>&1 | tee {log:q}"


rule reference:
    input:
        library("solve"),
        scene=ancient(referenced_scene),
        mesh=mesh_file,
    output:
        "results/{scene}/reference.npz",
    log:
        "results/{scene}/logs/reference.log",
    benchmark:
        "results/{scene}/benchmarks/reference.tsv"
    priority: 10
    resources:
        mem_mb=asked_by_reference(asked_memory),
        runtime=asked_by_reference(asked_minutes),
    params:
        content=content("solve"),
        statement=statement,
        method=method,
        accuracy=accuracy,
        element=lambda wildcards: scene(wildcards.scene).truth["element"],
        n=lambda wildcards: scene(wildcards.scene).truth["n"],
    shell:
        "python3 -m signorini solve {input.scene:q} --element {params.element} --n {params.n}"
        " --mesh {input.mesh:q} -o {output:q} 2>&1 | tee {log:q}"
