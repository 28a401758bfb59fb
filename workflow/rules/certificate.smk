# Guaranteed bounds of the energy errors: a job for each level, and their table.
# Durations are in the benchmark files alone: the same scene gives the same table, byte for byte.


rule certificate:
    input:
        library("certificate"),
        scene=ancient(scene_file),
        mesh=mesh_file,
        solutions=expand("results/{{scene}}/solutions/{element}/n{{n}}.npz", element=ELEMENT_NAMES),
    output:
        "results/{scene}/certificates/n{n}.npz",
    log:
        "results/{scene}/logs/certificate/n{n}.log",
    benchmark:
        "results/{scene}/benchmarks/certificate/n{n}.tsv"
    priority: 7
    resources:
        mem_mb=asked_megabytes(cost_of_certificate),
        runtime=asked_runtime(cost_of_certificate),
    params:
        content=content("certificate"),
        asked=parts("elements"),
        statement=statement,
        method=method,
    shell:
        "python3 -m signorini certificate {input.scene:q} {input.solutions:q} --n {wildcards.n}"
        " --mesh {input.mesh:q} -o {output:q} 2>&1 | tee {log:q}"


rule certificate_table:
    input:
        library("certificates"),
        scene=ancient(scene_file),
        levels=certificate_files,
    output:
        csv="results/{scene}/certificates.csv",
        tex="results/{scene}/certificates.tex",
        markdown="results/{scene}/certificates.md",
    log:
        "results/{scene}/logs/certificates.log",
    params:
        content=content("certificates"),
        asked=parts("elements", "levels"),
    shell:
        "python3 -m signorini certificates {input.scene:q} {input.levels:q} -o {output.csv:q}"
        " --tex {output.tex:q} --markdown {output.markdown:q} 2>&1 | tee {log:q}"


# The errors of the scene that is studied, and those that were published, between the bounds of one fine mesh.
GUARANTEED = f"{STUDIES}/guaranteed"


rule guaranteed:
    """The published errors of the scene that is studied, between guaranteed bounds."""
    input:
        library("guaranteed"),
        scene=ancient(studied_scene),
        solutions=lambda wildcards: solutions(studied()),
        published=studied_published,
    output:
        tex=f"{GUARANTEED}/guaranteed.tex",
        markdown=f"{GUARANTEED}/guaranteed.md",
        csv=f"{GUARANTEED}/guaranteed.csv",
    log:
        f"{GUARANTEED}/logs/page.log",
    params:
        content=content("guaranteed", studied_published),
        statement=studied_statement,
        fine=128 if QUICK else 1024,
        quick=QUICK_OPTION,
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini guaranteed {input.scene:q} {input.solutions:q} --fine {params.fine}"
        " --published {input.published:q} {params.quick} -o {params.folder:q} 2>&1 | tee {log:q}"
