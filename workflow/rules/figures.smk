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
    priority: 9
    shell:
        "python3 workflow/scripts/surface.py --mesh {input.mesh:q} --reference {input.reference:q}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule figure_surface:
    input:
        library("figure_surface.py"),
        surface="results/{scene}/surface.npz",
    output:
        pdf="results/{scene}/figures/surface.pdf",
        png=report("results/{scene}/figures/surface.png", caption="../report/surface.rst", category="{scene}"),
    log:
        "results/{scene}/logs/figure_surface.log",
    priority: 7
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
    shell:
        "python3 workflow/scripts/field.py --mesh {input.mesh:q} --solution {input.solution:q}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule figure_solution:
    input:
        library("figure_field.py"),
        field="results/{scene}/field.npz",
    output:
        pdf="results/{scene}/figures/solution.pdf",
        png=report("results/{scene}/figures/solution.png", caption="../report/solution.rst", category="{scene}"),
    log:
        "results/{scene}/logs/figure_solution.log",
    params:
        title=lambda wildcards: scene(wildcards.scene).document["title"],
    shell:
        "python3 workflow/scripts/figure_field.py --field {input.field:q} --title={params.title:q}"
        " {output:q} 2>&1 | tee {log:q}"


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
    shell:
        "python3 workflow/scripts/contact_line.py --mesh {input.mesh:q} --output {output:q}"
        " {input.solutions:q} 2>&1 | tee {log:q}"


rule figure_contact_line:
    input:
        library("figure_contact_line.py"),
        line="results/{scene}/contact_line.csv",
    output:
        pdf="results/{scene}/figures/contact_line.pdf",
        png=report("results/{scene}/figures/contact_line.png", caption="../report/contact_line.rst", category="{scene}"),
    log:
        "results/{scene}/logs/figure_contact_line.log",
    shell:
        "python3 workflow/scripts/figure_contact_line.py --line {input.line:q} {output:q} 2>&1 | tee {log:q}"


rule gallery:
    input:
        library("figure_gallery.py"),
        fields=gallery_fields,
    output:
        report("results/gallery.png", caption="../report/gallery.rst"),
    log:
        "results/logs/gallery.log",
    params:
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
    shell:
        "python3 workflow/scripts/vtu.py --mesh {input.mesh:q} --solution {input.solution:q}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule figure_convergence:
    input:
        library("figure_convergence.py"),
        errors="results/{scene}/errors.csv",
        rates="results/{scene}/rates.csv",
    output:
        pdf="results/{scene}/figures/{norm}.pdf",
        png=report("results/{scene}/figures/{norm}.png", caption="../report/convergence.rst", category="{scene}"),
    log:
        "results/{scene}/logs/figure_{norm}.log",
    priority: 5
    params:
        norm="{norm}",
        slope=lambda wildcards: scene(wildcards.scene).document["slope"],
    shell:
        "python3 workflow/scripts/figure_convergence.py --errors {input.errors:q} --rates {input.rates:q}"
        " --norm {params.norm} --slope {params.slope} {output:q} 2>&1 | tee {log:q}"
