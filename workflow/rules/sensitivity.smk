# `snakemake sensitivity`: the paper's table under all combinations of the options that the paper leaves open. Every job
# solves what one diagonal needs; the rest is arithmetic on its errors.

from signorini.open_choices.options import DIAGONALS

SENSITIVITY = f"{STUDIES}/sensitivity"


rule sensitivity_errors:
    input:
        library("sensitivity errors", diagonal=DIAGONALS),
        scene=ancient(studied_scene),
    output:
        f"{SENSITIVITY}/errors/{{diagonal}}.csv",
    log:
        f"{SENSITIVITY}/logs/errors_{{diagonal}}.log",
    benchmark:
        f"{SENSITIVITY}/benchmarks/errors_{{diagonal}}.tsv"
    wildcard_constraints:
        diagonal=NAME,
    priority: lambda wildcards: DIAGONALS.index(wildcards.diagonal)
    params:
        content=content("sensitivity errors"),
        statement=studied_statement,
        asked=of_studied("levels", "truth"),
        quick=QUICK_OPTION,
    shell:
        "python3 -m signorini sensitivity errors {input.scene:q} --diagonal {wildcards.diagonal}"
        " {params.quick} -o {output:q} 2>&1 | tee {log:q}"


rule sensitivity_combinations:
    input:
        library("sensitivity combinations"),
        scene=ancient(studied_scene),
        errors=expand(f"{SENSITIVITY}/errors/{{diagonal}}.csv", diagonal=DIAGONALS),
        published=studied_published,
    output:
        combinations=f"{SENSITIVITY}/sensitivity.csv",
        ratios=f"{SENSITIVITY}/sensitivity_ratios.csv",
    log:
        f"{SENSITIVITY}/logs/combinations.log",
    params:
        content=content("sensitivity combinations", studied_published),
        asked=of_studied("levels"),
        quick=QUICK_OPTION,
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini sensitivity combinations {input.scene:q} {input.errors:q}"
        " --published {input.published:q} {params.quick} -o {params.folder:q} 2>&1 | tee {log:q}"


# The last printed digits. Among the hypotheses of the full study is a solver of many sweeps, which takes minutes.
rule sensitivity_digits:
    input:
        library("sensitivity digits"),
        scene=ancient(studied_scene),
        published=studied_published,
    output:
        digits=f"{SENSITIVITY}/sensitivity_digits.csv",
        chance=f"{SENSITIVITY}/sensitivity_chance.csv",
    log:
        f"{SENSITIVITY}/logs/digits.log",
    benchmark:
        f"{SENSITIVITY}/benchmarks/digits.tsv"
    priority: 10
    params:
        content=content("sensitivity digits", studied_published),
        statement=studied_statement,
        asked=of_studied("elements", "levels", "truth"),
        quick=QUICK_OPTION,
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini sensitivity digits {input.scene:q} --published {input.published:q}"
        " {params.quick} -o {params.folder:q} 2>&1 | tee {log:q}"


rule figure_sensitivity:
    input:
        library("sensitivity figures"),
        combinations=f"{SENSITIVITY}/sensitivity.csv",
        ratios=f"{SENSITIVITY}/sensitivity_ratios.csv",
    output:
        matches=[f"{SENSITIVITY}/sensitivity_matches.{ending}" for ending in ("pdf", "png")],
        ratios=[f"{SENSITIVITY}/sensitivity_ratios.{ending}" for ending in ("pdf", "png")],
    log:
        f"{SENSITIVITY}/logs/figure.log",
    params:
        content=content("sensitivity figures"),
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini sensitivity figures {params.folder:q} 2>&1 | tee {log:q}"


# The page comes last, so that where it is there are its figures.
rule sensitivity:
    """What the paper leaves open, and what another choice does to its numbers."""
    input:
        library("sensitivity report"),
        rules.sensitivity_combinations.output,
        rules.figure_sensitivity.output,
        scene=ancient(studied_scene),
        errors=rules.sensitivity_combinations.input.errors,
        digits=rules.sensitivity_digits.output.digits,
        chance=rules.sensitivity_digits.output.chance,
        published=studied_published,
    output:
        tex=f"{SENSITIVITY}/sensitivity.tex",
        markdown=f"{SENSITIVITY}/sensitivity.md",
    log:
        f"{SENSITIVITY}/logs/page.log",
    params:
        content=content("sensitivity report", studied_published),
        asked=of_studied("levels", "truth"),
        quick=QUICK_OPTION,
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini sensitivity report {input.scene:q} {input.errors:q}"
        " --digits {input.digits:q} --chance {input.chance:q}"
        " --published {input.published:q} {params.quick} -o {params.folder:q} 2>&1 | tee {log:q}"
