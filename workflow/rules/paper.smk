# What only the scene "paper" has: the paper's own names for its table and figures, the check against the published
# numbers, and the PDF.


use rule table as table_5_1 with:
    output:
        tex="results/{scene,paper}/table_5_1.tex",
        markdown="results/{scene}/table_5_1.md",


use rule figure_surface as figure_5_1 with:
    output:
        pdf="results/{scene,paper}/figure_5_1.pdf",
        png=report(
            "results/{scene}/figure_5_1.png", caption="../report/surface.rst", category="paper"
        ),


rule figures_5_2_and_5_3:
    input:
        library("draw-convergence"),
        scene=ancient(paper_scene),
        errors="results/paper/errors.csv",
        rates="results/paper/rates.csv",
    output:
        l2="results/paper/figure_5_2.pdf",
        h1="results/paper/figure_5_3.pdf",
        l2_png=report(
            "results/paper/figure_5_2.png", caption="../report/convergence.rst", category="paper"
        ),
        h1_png=report(
            "results/paper/figure_5_3.png", caption="../report/convergence.rst", category="paper"
        ),
    log:
        "results/paper/logs/figures_5_2_and_5_3.log",
    priority: 5
    params:
        content=content("draw-convergence"),
        asked=of_paper("elements", "levels", "norms", "slope"),
        note=lambda wildcards: scene("paper").reference_note or "",
    shell:
        "python3 -m signorini draw-convergence {input.scene:q} {input.errors:q} {input.rates:q}"
        " --l2 {output.l2:q} {output.l2_png:q} --h1 {output.h1:q} {output.h1_png:q} 2>&1 | tee {log:q}"


rule check:
    input:
        library("compare"),
        scene=ancient(paper_scene),
        errors="results/paper/errors.csv",
        rates="results/paper/rates.csv",
        published=PUBLISHED,
    output:
        report("results/paper/check.csv", caption="../report/check.rst", category="paper"),
    log:
        "results/paper/logs/check.log",
    params:
        content=content("compare", PUBLISHED),
        asked=of_paper("elements", "levels", "norms"),
    shell:
        "python3 -m signorini compare {input.scene:q} {input.published:q} {input.errors:q}"
        " {input.rates:q} -o {output:q} 2>&1 | tee {log:q}"


# check.csv stays for inspection when a number is off; this rule then stops the build and says which.
rule verify:
    input:
        library("verify"),
        check="results/paper/check.csv",
    output:
        "results/paper/check.txt",
    log:
        "results/paper/logs/verify.log",
    params:
        content=content("verify"),
    shell:
        "python3 -m signorini verify {input.check:q} -o {output:q} 2>&1 | tee {log:q}"


rule effects:
    input:
        library("effects"),
        scene=ancient(paper_scene),
        errors="results/paper/errors.csv",
    output:
        "results/paper/effects.csv",
    log:
        "results/paper/logs/effects.log",
    benchmark:
        "results/paper/benchmarks/effects.tsv"
    params:
        content=content("effects"),
        statement=lambda wildcards: statement_of("paper"),
        asked=of_paper("elements", "levels", "truth", "norms"),
    shell:
        "python3 -m signorini effects {input.scene:q} {input.errors:q} -o {output:q} 2>&1 | tee {log:q}"


rule macros:
    input:
        library("macros"),
        scene=ancient(paper_scene),
        errors="results/paper/errors.csv",
        rates="results/paper/rates.csv",
        surface="results/paper/surface.npz",
        check="results/paper/check.csv",
        effects="results/paper/effects.csv",
        published=PUBLISHED,
    output:
        "results/paper/macros.tex",
    log:
        "results/paper/logs/macros.log",
    params:
        content=content("macros", PUBLISHED),
        asked=of_paper("elements", "levels", "norms", "truth"),
    shell:
        "python3 -m signorini macros {input.scene:q} --results results/paper"
        " --published {input.published:q} -o {output:q} 2>&1 | tee {log:q}"


rule paper:
    input:
        library("typeset"),
        check="results/paper/check.txt",
        source="paper/main.tex",
        parts=["results/paper/table_5_1.tex", "results/paper/macros.tex"],
        figures=expand("results/paper/{figure}.pdf", figure=FIGURES),
    output:
        report("results/paper/paper.pdf", caption="../report/paper.rst", category="paper"),
    log:
        "results/paper/logs/paper.log",
    params:
        content=content("typeset", "paper/main.tex"),
        appendix=lambda wildcards: [str(path) for path in appendix()],
        digest=lambda wildcards: digest(appendix()),
    shell:
        "python3 -m signorini typeset {input.source:q} {input.parts:q} {input.figures:q}"
        " {params.appendix:q} --check {input.check:q} -o {output:q} 2>&1 | tee {log:q}"
