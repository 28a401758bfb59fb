# The sweep of a scene: its points in few jobs, one table of all, its summary and its figure. A point that is there
# already is not solved again, whatever bundle it is in.


rule sweep_points:
    input:
        library("sweep-points"),
        scene=ancient(scene_file),
        source=scene_sources,
    output:
        "results/{scene}/sweep/bundle-{bundle}-of-{of}.json",
    log:
        "results/{scene}/logs/sweep/bundle-{bundle}-of-{of}.log",
    resources:
        mem_mb=asked_megabytes(cost_of_points),
        runtime=asked_runtime(cost_of_points),
    params:
        content=content("sweep-points", scene_sources),
        code=content("sweep-points"),
        asked=swept_parts,
        points=bundle_points,
    shell:
        "python3 -m signorini sweep-points {input.scene:q} --bundle {wildcards.bundle}"
        " --of {wildcards.of} --code {params.code} -o {output:q} 2>&1 | tee {log:q}"


rule sweep_table:
    input:
        library("sweep-table"),
        scene=ancient(scene_file),
        bundles=bundle_files,
    output:
        table="results/{scene}/sweep.csv",
        summary=["results/{scene}/sweep_summary.csv", "results/{scene}/sweep_summary.md"],
        tex="results/{scene}/sweep.tex",
    log:
        "results/{scene}/logs/sweep_table.log",
    params:
        content=content("sweep-table"),
        sweep=parts("sweep", "table", "norms"),
    shell:
        "python3 -m signorini sweep-table {input.scene:q} {input.bundles:q} -o {output.table:q}"
        " --summary {output.summary:q} --tex {output.tex:q} 2>&1 | tee {log:q}"


rule sweep_figure:
    input:
        library("sweep-figure"),
        scene=ancient(scene_file),
        table="results/{scene}/sweep.csv",
    output:
        pdf="results/{scene}/sweep.pdf",
        png=report(
            "results/{scene}/sweep.png",
            caption="../report/sweep.rst",
            category="{scene}",
            labels={"shows": "6 sweep"},
        ),
    log:
        "results/{scene}/logs/sweep_figure.log",
    params:
        content=content("sweep-figure"),
        sweep=parts("sweep"),
    shell:
        "python3 -m signorini sweep-figure {input.scene:q} {input.table:q} -o {output:q} 2>&1 | tee {log:q}"
