# The domain of a scene: its coarsest labelled triangulation. Scenes with the same domain and boundary share the file.


rule mesh:
    input:
        library("mesh.py"),
    output:
        "results/meshes/{mesh}.npz",
    log:
        "results/logs/mesh/{mesh}.log",
    benchmark:
        "results/benchmarks/mesh/{mesh}.tsv"
    params:
        domain=mesh_statement,
    shell:
        "python3 workflow/scripts/mesh.py --domain {params.domain:q} --output {output:q} 2>&1 | tee {log:q}"
