# The domain of a scene, which every level is refined from. Scenes with the same domain and boundary share the file.


rule mesh:
    input:
        library("mesh"),
        scene=ancient(lambda wildcards: validated_file(scene_of_mesh(wildcards.mesh))),
        source=mesh_source,
    output:
        "results/meshes/{mesh}.npz",
    log:
        "results/logs/mesh/{mesh}.log",
    benchmark:
        "results/benchmarks/mesh/{mesh}.tsv"
    params:
        content=content("mesh", mesh_source),
        domain=lambda wildcards: as_json(domain_of(scene_of_mesh(wildcards.mesh))),
    shell:
        "python3 -m signorini mesh {input.scene:q} -o {output:q} 2>&1 | tee {log:q}"
