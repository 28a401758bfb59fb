# The domain of a scene, which every level is refined from. Scenes with the same domain and boundary share the file.


rule mesh:
    input:
        library("mesh.py"),
        source=mesh_source,
    output:
        "results/meshes/{mesh}.npz",
    log:
        "results/logs/mesh/{mesh}.log",
    benchmark:
        "results/benchmarks/mesh/{mesh}.tsv"
    params:
        content=content("mesh.py", mesh_source),
        domain=lambda wildcards: as_json(mesh_domain(wildcards.mesh)),
    shell:
        "python3 workflow/scripts/mesh.py --domain {params.domain:q} --output {output:q} 2>&1 | tee {log:q}"
