# The domain of a scene, which every level is refined from. Scenes with the same domain and boundary share the file.


def domain_of(name):
    asked = written(name)
    return asked.section("domain", "boundary") | {"coarsest": asked.levels[0]}


@cache
def mesh_key(name):
    """Scenes with the same domain, boundary and coarsest level have the same mesh."""
    return hashlib.sha256(as_json(domain_of(name)).encode()).hexdigest()[:12]


@cache
def scene_of_mesh(key):
    """Of the scenes asked for first, so that a broken file elsewhere in config/scenes does no harm."""
    names = dict.fromkeys([*CONFIG["scenes"], *known_scenes()])
    return next(name for name in names if mesh_key(name) == key)


def mesh_source(wildcards):
    """The files that the domain is read from."""
    domain = domain_of(scene_of_mesh(wildcards.mesh))["domain"]
    return list(map(str, files_read(domain["file"]))) if domain["kind"] == "mesh" else []


def mesh_file(wildcards):
    return f"results/meshes/{mesh_key(wildcards.scene)}.npz"


rule mesh:
    input:
        library("mesh"),
        scene=ancient(lambda wildcards: f"results/{scene_of_mesh(wildcards.mesh)}/scene.json"),
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
