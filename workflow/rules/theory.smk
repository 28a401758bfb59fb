# `snakemake theory`: both sides of the paper's statements, on scenes with exact solutions.

THEORY = f"{STUDIES}/theory"
THEORY_SCENES = ["corner", "punch", "smooth", "biactive"]
THEORY_LEVELS = [4, 8, 16, 32] if QUICK else [4, 8, 16, 32, 64, 128, 256]


rule theory_estimates:
    input:
        library("theory estimates", scene=THEORY_SCENES),
        scene=ancient(scene_file),
    output:
        estimates=f"{THEORY}/{{scene}}/estimates.csv",
        terms=f"{THEORY}/{{scene}}/terms.csv",
    log:
        f"{THEORY}/logs/estimates_{{scene}}.log",
    benchmark:
        f"{THEORY}/benchmarks/estimates_{{scene}}.tsv"
    params:
        content=content("theory estimates"),
        statement=statement,
        levels=THEORY_LEVELS,
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini theory estimates {input.scene:q} --levels {params.levels}"
        " -o {params.folder:q} 2>&1 | tee {log:q}"


rule theory_traces:
    input:
        library("theory traces"),
    output:
        f"{THEORY}/traces.csv",
    log:
        f"{THEORY}/logs/traces.log",
    params:
        content=content("theory traces"),
    shell:
        "python3 -m signorini theory traces -o {output:q} 2>&1 | tee {log:q}"


rule figure_theory:
    input:
        library("theory figures"),
        estimates=expand(f"{THEORY}/{{scene}}/estimates.csv", scene=THEORY_SCENES),
        terms=expand(f"{THEORY}/{{scene}}/terms.csv", scene=THEORY_SCENES),
        traces=f"{THEORY}/traces.csv",
    output:
        [
            f"{THEORY}/theory_{name}.{ending}"
            for name in ("estimates", "terms", "traces")
            for ending in ("pdf", "png")
        ],
    log:
        f"{THEORY}/logs/figures.log",
    params:
        content=content("theory figures"),
        folder=subpath(output[0], parent=True),
        scenes=THEORY_SCENES,
    shell:
        "python3 -m signorini theory figures {params.folder:q} --scenes {params.scenes}"
        " 2>&1 | tee {log:q}"


# The page comes last, so that where it is there are its figures.
rule theory:
    """Both sides of the paper's statements, on scenes with exact solutions."""
    input:
        library("theory report"),
        rules.figure_theory.output,
        estimates=rules.figure_theory.input.estimates,
        terms=rules.figure_theory.input.terms,
        traces=rules.figure_theory.input.traces,
    output:
        tex=f"{THEORY}/theory.tex",
        markdown=f"{THEORY}/theory.md",
        estimates=f"{THEORY}/estimates.csv",
        terms=f"{THEORY}/terms.csv",
    log:
        f"{THEORY}/logs/page.log",
    params:
        content=content("theory report"),
        folder=subpath(output[0], parent=True),
        scenes=THEORY_SCENES,
        quick=QUICK_OPTION,
    shell:
        "python3 -m signorini theory report {params.folder:q} --scenes {params.scenes}"
        " {params.quick} 2>&1 | tee {log:q}"
