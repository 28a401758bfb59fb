# `snakemake adaptive`: guaranteed errors on adaptive and on uniform meshes. Runs are measured one at a time.

ADAPTIVE = f"{STUDIES}/adaptive"
ADAPTIVE_SCENES = ["l-shape", "notch", "inclusion", "corner", "many-contacts", "paper-exact"]
ADAPTIVE_DOFS = {"adaptive": 5000 if QUICK else 70000, "uniform": 20000 if QUICK else 230000}


rule adaptive_run:
    input:
        library("adapt", scene=ADAPTIVE_SCENES, run=list(ADAPTIVE_DOFS)),
        scene=ancient(scene_file),
    output:
        steps=f"{ADAPTIVE}/{{scene}}/{{run}}/steps.csv",
        seconds=f"{ADAPTIVE}/{{scene}}/{{run}}/seconds.csv",
        picture=f"{ADAPTIVE}/{{scene}}/{{run}}/picture.npz",
    log:
        f"{ADAPTIVE}/logs/{{scene}}_{{run}}.log",
    wildcard_constraints:
        run=NAME,
    threads: all_cores
    params:
        content=content("adapt"),
        statement=statement,
        dofs=lambda wildcards: ADAPTIVE_DOFS[wildcards.run],
        start=lambda wildcards: scene(wildcards.scene).levels[0],
        uniform=lambda wildcards: "--uniform" if wildcards.run == "uniform" else "",
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini adapt {input.scene:q} --bound 0 --start {params.start}"
        " --max-dofs {params.dofs} {params.uniform} --warm --restart -o {params.folder:q} 2>&1 | tee {log:q}"


rule figure_adaptive:
    input:
        library("adaptive figures"),
        expand(
            f"{ADAPTIVE}/{{scene}}/{{run}}/{{file}}",
            scene=ADAPTIVE_SCENES,
            run=ADAPTIVE_DOFS,
            file=("steps.csv", "seconds.csv", "picture.npz"),
        ),
    output:
        [
            f"{ADAPTIVE}/adaptive_{name}.{ending}"
            for name in ("dofs", "seconds", "meshes")
            for ending in ("pdf", "png")
        ],
    log:
        f"{ADAPTIVE}/logs/figures.log",
    params:
        content=content("adaptive figures"),
        folder=subpath(output[0], parent=True),
        scenes=expand(f"{ADAPTIVE}/{{scene}}", scene=ADAPTIVE_SCENES),
    shell:
        "python3 -m signorini adaptive figures {params.scenes} -o {params.folder:q} 2>&1 | tee {log:q}"


# The page comes last, so that where it is there are its figures.
rule adaptive:
    """Adaptive meshes beside uniform ones, at the same guaranteed bound."""
    input:
        library("adaptive report"),
        rules.figure_adaptive.output,
        rules.figure_adaptive.input[1:],
    output:
        tex=f"{ADAPTIVE}/adaptive.tex",
        markdown=f"{ADAPTIVE}/adaptive.md",
        table=f"{ADAPTIVE}/adaptive.csv",
    log:
        f"{ADAPTIVE}/logs/page.log",
    params:
        content=content("adaptive report"),
        folder=subpath(output[0], parent=True),
        scenes=expand(f"{ADAPTIVE}/{{scene}}", scene=ADAPTIVE_SCENES),
        quick=QUICK_OPTION,
    shell:
        "python3 -m signorini adaptive report {params.scenes} {params.quick} -o {params.folder:q}"
        " 2>&1 | tee {log:q}"
