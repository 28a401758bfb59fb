# Figures: first the numbers that a figure shows, then the drawing.


rule surface:
    input:
        library("surface.py"),
        mesh=mesh_file,
        reference="results/{scene}/reference.npz",
    output:
        "results/{scene}/surface.npz",
    log:
        "results/{scene}/logs/surface.log",
    benchmark:
        "results/{scene}/benchmarks/surface.tsv"
    params:
        content=content("surface.py"),
    shell:
        "python3 workflow/scripts/surface.py --mesh {input.mesh:q} --reference {input.reference:q}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule figure_surface:
    input:
        library("figure_surface.py"),
        surface="results/{scene}/surface.npz",
    output:
        pdf="results/{scene}/surface.pdf",
        png=report(
            "results/{scene}/surface.png", caption="../report/surface.rst", category="{scene}"
        ),
    log:
        "results/{scene}/logs/figure_surface.log",
    params:
        content=content("figure_surface.py"),
    shell:
        "python3 workflow/scripts/figure_surface.py --surface {input.surface:q} {output:q} 2>&1 | tee {log:q}"


rule field:
    input:
        library("field.py"),
        mesh=mesh_file,
        solution=finest,
    output:
        "results/{scene}/field.npz",
    log:
        "results/{scene}/logs/field.log",
    benchmark:
        "results/{scene}/benchmarks/field.tsv"
    params:
        content=content("field.py"),
    shell:
        "python3 workflow/scripts/field.py --mesh {input.mesh:q} --solution {input.solution:q}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule contact_line:
    input:
        library("contact_line.py"),
        mesh=mesh_file,
        solutions=finest_of_each,
    output:
        "results/{scene}/contact_line.csv",
    log:
        "results/{scene}/logs/contact_line.log",
    benchmark:
        "results/{scene}/benchmarks/contact_line.tsv"
    params:
        content=content("contact_line.py"),
    shell:
        "python3 workflow/scripts/contact_line.py --mesh {input.mesh:q} --output {output:q}"
        " {input.solutions:q} 2>&1 | tee {log:q}"


# All figures of a scene at once: importing Matplotlib takes longer than drawing them.
rule figures:
    input:
        library("figures.py"),
        unpack(shown),
    output:
        report(
            directory("results/{scene}/figures"),
            patterns=["{figure}.png"],
            caption="../report/figures.rst",
            category="{scene}",
        ),
    log:
        "results/{scene}/logs/figures.log",
    params:
        content=content("figures.py"),
        title=lambda wildcards: scene(wildcards.scene).document["title"],
        options=figure_options,
        note=reference_note,
    shell:
        "python3 workflow/scripts/figures.py --title={params.title:q} {params.options} --output {output:q}"
        " 2>&1 | tee {log:q}"


rule gallery:
    input:
        library("figure_gallery.py"),
        fields=gallery_fields,
    output:
        report("results/gallery.png", caption="../report/gallery.rst"),
    log:
        "results/logs/gallery.log",
    params:
        content=content("figure_gallery.py"),
        titles=gallery_titles,
    shell:
        "python3 workflow/scripts/figure_gallery.py --titles {params.titles:q} --fields {input.fields:q}"
        " --outputs {output:q} 2>&1 | tee {log:q}"


rule vtu:
    input:
        library("vtu.py"),
        mesh=mesh_file,
        solution=lambda wildcards: finest(wildcards, wildcards.element),
    output:
        "results/{scene}/vtu/{element}.vtu",
    log:
        "results/{scene}/logs/vtu_{element}.log",
    benchmark:
        "results/{scene}/benchmarks/vtu_{element}.tsv"
    params:
        content=content("vtu.py"),
    shell:
        "python3 workflow/scripts/vtu.py --mesh {input.mesh:q} --solution {input.solution:q}"
        " --output {output:q} 2>&1 | tee {log:q}"
