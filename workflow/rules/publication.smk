# What a scene's section `publication` asks for: its own names of table and figures, the check against published numbers,
# the numbers of a manuscript, and its PDF.


use rule table as named_table with:
    output:
        tex="results/{scene}/{table}.tex",
        markdown="results/{scene}/{table}.md",
    log:
        "results/{scene}/logs/{table}.log",
    wildcard_constraints:
        table=stem_pattern(TABLE),


use rule figure_surface as named_surface with:
    output:
        pdf="results/{scene}/{surface}.pdf",
        png=report(
            "results/{scene}/{surface}.png",
            caption="../report/surface.rst",
            category="{scene}",
            labels={"shows": "3 reference solution"},
        ),
    log:
        "results/{scene}/logs/{surface}.log",
    wildcard_constraints:
        surface=stem_pattern(SURFACE),


# Convergence plots with names of their own, all of a scene in one job: importing Matplotlib takes longer than drawing.
for name in scenes_with_names():
    if norm_figures(name):

        rule:
            name:
                f"named_convergence_{name.replace('-', '__')}"
            input:
                library("draw-convergence"),
                scene=ancient(scene_file),
                errors="results/{scene}/errors.csv",
                rates="results/{scene}/rates.csv",
            output:
                pdf=[f"results/{{scene}}/{stem}.pdf" for stem in norm_figures(name).values()],
                png=[
                    report(
                        f"results/{{scene}}/{stem}.png",
                        caption="../report/convergence.rst",
                        category="{scene}",
                        labels={"shows": f"3 figure: {norm}"},
                    )
                    for norm, stem in norm_figures(name).items()
                ],
            log:
                "results/{scene}/logs/named_convergence.log",
            wildcard_constraints:
                scene=name,
            priority: 5
            params:
                content=content("draw-convergence"),
                asked=parts("elements", "levels", "norms", "slope"),
                note=reference_note,
                figures=" ".join(
                    f"--figure {norm} results/{name}/{stem}.pdf results/{name}/{stem}.png"
                    for norm, stem in norm_figures(name).items()
                ),
            shell:
                "python3 -m signorini draw-convergence {input.scene:q} {input.errors:q} {input.rates:q}"
                " {params.figures} 2>&1 | tee {log:q}"


rule check:
    input:
        library("compare"),
        tables_of_check,
        scene=ancient(scene_file),
        published=published_file,
    output:
        report(
            "results/{scene}/check.csv",
            caption="../report/check.rst",
            category="{scene}",
            labels={"shows": "1 check against published numbers"},
        ),
    log:
        "results/{scene}/logs/check.log",
    params:
        content=content("compare", published_file),
        asked=parts("elements", "levels", "norms", "slope"),
    shell:
        "python3 -m signorini compare {input.scene:q} {input.published:q} -o {output:q} 2>&1 | tee {log:q}"


# check.csv stays for inspection when a number is off; this rule then stops the build and says which.
rule verify:
    input:
        library("verify"),
        check="results/{scene}/check.csv",
    output:
        "results/{scene}/check.txt",
    log:
        "results/{scene}/logs/verify.log",
    params:
        content=content("verify"),
    shell:
        "python3 -m signorini verify {input.check:q} -o {output:q} 2>&1 | tee {log:q}"


rule effects:
    input:
        library("effects"),
        scene=ancient(scene_file),
        errors="results/{scene}/errors.csv",
    output:
        "results/{scene}/effects.csv",
    log:
        "results/{scene}/logs/effects.log",
    benchmark:
        "results/{scene}/benchmarks/effects.tsv"
    params:
        content=content("effects"),
        statement=statement,
        asked=parts("elements", "levels", "truth", "norms"),
    shell:
        "python3 -m signorini effects {input.scene:q} {input.errors:q} -o {output:q} 2>&1 | tee {log:q}"


rule macros:
    input:
        library("macros"),
        tables_of_macros,
        scene=ancient(scene_file),
        published=published_if_any,
        source=source_if_any,
    output:
        "results/{scene}/macros.tex",
    log:
        "results/{scene}/logs/macros.log",
    params:
        content=content("macros", published_if_any, source_if_any),
        asked=asked_of_macros,
    shell:
        "python3 -m signorini macros {input.scene:q} -o {output:q} 2>&1 | tee {log:q}"


rule paper:
    input:
        library("typeset"),
        check=verdict_if_any,
        source=source_files,
        parts=lambda wildcards: parts_of(wildcards.scene),
    output:
        report(
            "results/{scene}/paper.pdf",
            caption="../report/paper.rst",
            category="{scene}",
            labels={"shows": "7 article"},
        ),
    log:
        "results/{scene}/logs/paper.log",
    params:
        content=content("typeset", source_files),
        check=lambda wildcards, input: f"--check {quote(str(input.check))}" if input.check else "",
        appendix=lambda wildcards: [str(path) for path in appendix(wildcards.scene)],
        digest=lambda wildcards: digest(appendix(wildcards.scene)),
        source=lambda wildcards: publication_file(wildcards.scene, "manuscript"),
        strict=lambda wildcards: "--strict" if publication(wildcards.scene)["strict"] else "",
    shell:
        "python3 -m signorini typeset {params.source:q} {input.parts:q} {params.appendix:q}"
        " {params.check} {params.strict} -o {output:q} 2>&1 | tee {log:q}"
