# `snakemake sensitivity`: the paper's table under all combinations of the choices that the paper leaves unsaid. Every job
# solves what one diagonal needs; the rest is arithmetic on its errors.

from signorini.studies.sensitivity.unsaid import DIAGONALS

SENSITIVITY = f"{STUDIES}/sensitivity"


def sensitivity_levels():
    """The levels of the paper's table, or the coarse ones of them."""
    return [n for n in scene("paper").levels if n <= 16 or not CONFIG["quick"]]


def sensitivity_reference():
    return scene("paper").truth["n"] // (4 if CONFIG["quick"] else 1)


rule sensitivity_errors:
    input:
        library("sensitivity_errors.py"),
    output:
        f"{SENSITIVITY}/errors/{{diagonal,[a-z-]+}}.csv",
    log:
        f"{SENSITIVITY}/logs/errors_{{diagonal}}.log",
    benchmark:
        f"{SENSITIVITY}/benchmarks/errors_{{diagonal}}.tsv"
    priority: lambda wildcards: DIAGONALS.index(wildcards.diagonal)
    params:
        content=content("sensitivity_errors.py"),
        statement=lambda wildcards: statement_of("paper"),
        levels=lambda wildcards: as_json(sensitivity_levels()),
        reference=lambda wildcards: sensitivity_reference(),
    shell:
        "python3 workflow/scripts/sensitivity_errors.py --statement {params.statement:q}"
        " --diagonal {wildcards.diagonal} --levels {params.levels:q} --reference-n {params.reference}"
        " --output {output:q} 2>&1 | tee {log:q}"


rule sensitivity_combinations:
    input:
        library("sensitivity_combinations.py"),
        errors=expand(f"{SENSITIVITY}/errors/{{diagonal}}.csv", diagonal=DIAGONALS),
        published=PUBLISHED,
    output:
        combinations=f"{SENSITIVITY}/sensitivity.csv",
        ratios=f"{SENSITIVITY}/sensitivity_ratios.csv",
    log:
        f"{SENSITIVITY}/logs/combinations.log",
    params:
        content=content("sensitivity_combinations.py", PUBLISHED),
        levels=lambda wildcards: as_json(sensitivity_levels()),
    shell:
        "python3 workflow/scripts/sensitivity_combinations.py --published {input.published:q}"
        " --levels {params.levels:q}"
        " --combinations {output.combinations:q} --ratios {output.ratios:q} {input.errors:q} 2>&1 | tee {log:q}"


rule figure_sensitivity:
    input:
        library("figure_sensitivity.py"),
        combinations=f"{SENSITIVITY}/sensitivity.csv",
        ratios=f"{SENSITIVITY}/sensitivity_ratios.csv",
    output:
        matches=[f"{SENSITIVITY}/sensitivity_matches.{ending}" for ending in ("pdf", "png")],
        ratios=[f"{SENSITIVITY}/sensitivity_ratios.{ending}" for ending in ("pdf", "png")],
    log:
        f"{SENSITIVITY}/logs/figure.log",
    params:
        content=content("figure_sensitivity.py"),
    shell:
        "python3 workflow/scripts/figure_sensitivity.py --combinations {input.combinations:q} --ratios {input.ratios:q}"
        " --matches-to {output.matches:q} --ratios-to {output.ratios:q} 2>&1 | tee {log:q}"


# The page comes last, so that where it is there are its figures.
rule sensitivity:
    input:
        library("sensitivity.py"),
        rules.sensitivity_combinations.output,
        rules.figure_sensitivity.output,
        errors=rules.sensitivity_combinations.input.errors,
        published=PUBLISHED,
    output:
        tex=f"{SENSITIVITY}/sensitivity.tex",
        markdown=f"{SENSITIVITY}/sensitivity.md",
    log:
        f"{SENSITIVITY}/logs/page.log",
    params:
        content=content("sensitivity.py", PUBLISHED),
        levels=lambda wildcards: as_json(sensitivity_levels()),
        reference=lambda wildcards: sensitivity_reference(),
        quick="--quick" if CONFIG["quick"] else "",
    shell:
        "python3 workflow/scripts/sensitivity.py --published {input.published:q} --reference-n {params.reference}"
        " --levels {params.levels:q} {params.quick} --tex {output.tex:q} --markdown {output.markdown:q} {input.errors:q} 2>&1 | tee {log:q}"
