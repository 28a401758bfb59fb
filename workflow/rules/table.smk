# The error table in LaTeX and in Markdown.


rule table:
    input:
        library("table.py"),
        errors="results/{scene}/errors.csv",
        rates="results/{scene}/rates.csv",
    output:
        tex="results/{scene}/table.tex",
        markdown="results/{scene}/table.md",
    log:
        "results/{scene}/logs/table.log",
    params:
        content=content("table.py"),
        asked=asked_rows,
        slope=lambda wildcards: scene(wildcards.scene).document["slope"],
        note=reference_note,
    shell:
        "python3 workflow/scripts/table.py --errors {input.errors:q} --rates {input.rates:q}"
        " --asked {params.asked:q} --slope {params.slope} --note={params.note:q}"
        " --tex {output.tex:q} --markdown {output.markdown:q} 2>&1 | tee {log:q}"
