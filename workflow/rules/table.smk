# The error table in LaTeX and in Markdown.


rule table:
    input:
        library("table"),
        scene=ancient(scene_file),
        errors="results/{scene}/errors.csv",
        rates="results/{scene}/rates.csv",
    output:
        tex="results/{scene}/table.tex",
        markdown="results/{scene}/table.md",
    log:
        "results/{scene}/logs/table.log",
    params:
        content=content("table"),
        asked=parts("elements", "levels", "norms", "slope", "table"),
        note=reference_note,
    shell:
        "python3 -m signorini table {input.scene:q} {input.errors:q} {input.rates:q}"
        " --tex {output.tex:q} --markdown {output.markdown:q} 2>&1 | tee {log:q}"
