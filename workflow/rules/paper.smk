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
        library("figure_convergence.py"),
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
        content=content("figure_convergence.py"),
        asked=lambda wildcards: asked_rows_of("paper"),
        slope=lambda wildcards: scene("paper").document["slope"],
        note=lambda wildcards: scene("paper").reference_note or "",
    shell:
        "python3 workflow/scripts/figure_convergence.py --errors {input.errors:q} --rates {input.rates:q}"
        " --asked {params.asked:q} --slope {params.slope} --l2 {output.l2:q} {output.l2_png:q}"
        " --h1 {output.h1:q} {output.h1_png:q} 2>&1 | tee {log:q}"


rule check:
    input:
        library("check.py"),
        errors="results/paper/errors.csv",
        rates="results/paper/rates.csv",
        published=PUBLISHED,
    output:
        report("results/paper/check.csv", caption="../report/check.rst", category="paper"),
    log:
        "results/paper/logs/check.log",
    params:
        content=content("check.py", PUBLISHED),
        asked=lambda wildcards: asked_rows_of("paper"),
    shell:
        "python3 workflow/scripts/check.py --errors {input.errors:q} --rates {input.rates:q}"
        " --asked {params.asked:q} --published {input.published:q} --output {output:q} 2>&1 | tee {log:q}"


# check.csv stays for inspection when a number is off; this rule then stops the build and says which.
rule verify:
    input:
        library("verify.py"),
        check="results/paper/check.csv",
    output:
        "results/paper/check.txt",
    log:
        "results/paper/logs/verify.log",
    params:
        content=content("verify.py"),
    shell:
        "python3 workflow/scripts/verify.py --check {input.check:q} --output {output:q} 2>&1 | tee {log:q}"


rule effects:
    input:
        library("effects.py"),
        errors="results/paper/errors.csv",
    output:
        "results/paper/effects.csv",
    log:
        "results/paper/logs/effects.log",
    benchmark:
        "results/paper/benchmarks/effects.tsv"
    params:
        content=content("effects.py"),
        statement=lambda wildcards: statement_of("paper"),
        scene=lambda wildcards: as_json(
            scene("paper").section("elements", "levels", "truth", "norms")
        ),
    shell:
        "python3 workflow/scripts/effects.py --statement {params.statement:q} --scene {params.scene:q}"
        " --errors {input.errors:q} --output {output:q} 2>&1 | tee {log:q}"


rule macros:
    input:
        library("macros.py"),
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
        content=content("macros.py", PUBLISHED),
        asked=lambda wildcards: asked_rows_of("paper"),
        n=lambda wildcards: scene("paper").truth["n"],
    shell:
        "python3 workflow/scripts/macros.py --errors {input.errors:q} --rates {input.rates:q}"
        " --asked {params.asked:q} --surface {input.surface:q} --reference-n {params.n} --check {input.check:q}"
        " --published {input.published:q} --effects {input.effects:q} --output {output:q} 2>&1 | tee {log:q}"


rule paper:
    input:
        library("paper.py"),
        check="results/paper/check.txt",
        source="paper/main.tex",
        parts=["results/paper/table_5_1.tex", "results/paper/macros.tex"],
        figures=expand("results/paper/{figure}.pdf", figure=FIGURES),
    output:
        report("results/paper/paper.pdf", caption="../report/paper.rst", category="paper"),
    log:
        "results/paper/logs/paper.log",
    params:
        content=content("paper.py", "paper/main.tex"),
        appendix=lambda wildcards: [str(path) for path in appendix()],
        digest=lambda wildcards: digest(appendix()),
    shell:
        "python3 workflow/scripts/paper.py --source {input.source:q} --check {input.check:q} --output {output:q}"
        " {input.parts:q} {input.figures:q} {params.appendix:q} 2>&1 | tee {log:q}"


if WITHOUT and paper_output() and workflow.is_main_process:
    # Snakemake's own onsuccess is silent where there is nothing to do.
    atexit.register(
        print,
        f"results/paper/paper.pdf: not built, for want of {' and '.join(WITHOUT)}. On Debian: apt-get install latexmk"
        " texlive-latex-recommended lmodern",
        file=sys.stderr,
    )
