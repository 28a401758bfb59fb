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
