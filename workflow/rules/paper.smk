# What only the scene "paper" has: the paper's own names for its table and figures, the check against the published
# numbers, and the PDF.

PUBLISHED = "config/published/table_5_1.csv"
LATEX = shutil.which("latexmk") and shutil.which("pdflatex")
PAPER_NAMES = {"table": "table_5_1.tex", "surface": "figure_5_1", "l2": "figure_5_2", "h1": "figure_5_3"}
FIGURES = ["figure_5_1", "figure_5_2", "figure_5_3"]


def output_names(name):
    """File names of a scene's table and figures."""
    generic = {norm: f"figures/{norm}" for norm in ("l2", "h1_semi", "h1")}
    names = {"table": "table.tex", "surface": "figures/surface"} | generic
    return names | PAPER_NAMES if name == "paper" else names


def paper_output():
    files = ["check.csv", "check.txt"] + (["paper.pdf"] if LATEX else [])
    return [f"results/paper/{file}" for file in files]


use rule table as table_5_1 with:
    output:
        tex="results/{scene,paper}/table_5_1.tex",
        markdown="results/{scene}/table_5_1.md",


use rule figure_surface as figure_5_1 with:
    output:
        pdf="results/{scene,paper}/figure_5_1.pdf",
        png=report("results/{scene}/figure_5_1.png", caption="../report/surface.rst", category="paper"),


use rule figure_convergence as figure_5_2 with:
    output:
        pdf="results/{scene,paper}/figure_5_2.pdf",
        png=report("results/{scene}/figure_5_2.png", caption="../report/convergence.rst", category="paper"),
    params:
        norm="l2",
        slope=lambda wildcards: scene(wildcards.scene).document["slope"],
    log:
        "results/{scene}/logs/figure_5_2.log",


use rule figure_convergence as figure_5_3 with:
    output:
        pdf="results/{scene,paper}/figure_5_3.pdf",
        png=report("results/{scene}/figure_5_3.png", caption="../report/convergence.rst", category="paper"),
    params:
        norm="h1",
        slope=lambda wildcards: scene(wildcards.scene).document["slope"],
    log:
        "results/{scene}/logs/figure_5_3.log",


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
    shell:
        "{PYTHON:q} {SCRIPTS}/check.py --errors {input.errors:q} --rates {input.rates:q}"
        " --published {input.published:q} --output {output:q} 2>&1 | tee {log:q}"


# check.csv stays for inspection when a number is off; this rule then stops the build and says which.
rule verify:
    input:
        library("verify.py"),
        check="results/paper/check.csv",
    output:
        "results/paper/check.txt",
    log:
        "results/paper/logs/verify.log",
    shell:
        "{PYTHON:q} {SCRIPTS}/verify.py --check {input.check:q} --output {output:q} 2>&1 | tee {log:q}"


rule effects:
    input:
        library("effects.py"),
        errors="results/paper/errors.csv",
    output:
        "results/paper/effects.csv",
    params:
        statement=lambda wildcards: statement_of("paper"),
        scene=lambda wildcards: as_json(scene("paper").section("elements", "levels", "truth", "norms")),
    log:
        "results/paper/logs/effects.log",
    benchmark:
        "results/paper/benchmarks/effects.tsv"
    shell:
        "{PYTHON:q} {SCRIPTS}/effects.py --statement {params.statement:q} --scene {params.scene:q}"
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
    params:
        n=lambda wildcards: scene("paper").truth["n"],
    log:
        "results/paper/logs/macros.log",
    shell:
        "{PYTHON:q} {SCRIPTS}/macros.py --errors {input.errors:q} --rates {input.rates:q}"
        " --surface {input.surface:q} --reference-n {params.n} --check {input.check:q}"
        " --published {input.published:q} --effects {input.effects:q} --output {output:q} 2>&1 | tee {log:q}"


rule paper:
    input:
        library("paper.py"),
        "results/paper/check.txt",
        source="paper/main.tex",
        parts=["results/paper/table_5_1.tex", "results/paper/macros.tex"],
        figures=expand("results/paper/{figure}.pdf", figure=FIGURES),
    output:
        report("results/paper/paper.pdf", caption="../report/paper.rst", category="paper"),
    log:
        "results/paper/logs/paper.log",
    shell:
        "{PYTHON:q} {SCRIPTS}/paper.py --source {input.source:q} --output {output:q}"
        " {input.parts:q} {input.figures:q} 2>&1 | tee {log:q}"


if not LATEX:
    onsuccess:
        print(
            "The PDF was not built: latexmk or pdflatex is missing. On Debian: apt-get install latexmk"
            " texlive-latex-recommended texlive-latex-extra texlive-fonts-recommended lmodern"
        )
