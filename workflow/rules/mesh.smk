# The domain of a scene: its coarsest labelled triangulation. Scenes with the same domain and boundary share the file.


def mesh_statement(wildcards):
    """Of the scenes asked for first, so that a broken file elsewhere in config/scenes does no harm."""
    names = dict.fromkeys([*CONFIG["scenes"], *known_scenes()])
    shared = next(name for name in names if mesh_key(name) == wildcards.mesh)
    return as_json(scene(shared).section("domain", "boundary"))


rule mesh:
    input:
        library("mesh.py"),
    output:
        "results/meshes/{mesh}.npz",
    params:
        domain=mesh_statement,
    log:
        "results/logs/mesh/{mesh}.log",
    shell:
        "{PYTHON:q} {SCRIPTS}/mesh.py --domain {params.domain:q} --output {output:q} 2>&1 | tee {log:q}"
