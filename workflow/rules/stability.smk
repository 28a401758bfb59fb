# The stability suite, `snakemake --cores 2 stability`; a finished piece is a file, so that it can be interrupted.


# The machine that measures, described again whenever the solves are to be measured again.
use rule benchmark_machine as stability_machine with:
    input:
        library("stability success"),
    output:
        f"{STABILITY}/machine.json",
    log:
        f"{STABILITY}/logs/machine.log",
    params:
        content=content("stability success"),
        settings=lambda wildcards: as_json(suite()["success"]),


rule stability_success:
    input:
        library("stability success", family=lambda: suite()["families"]),
        machine=f"{STABILITY}/machine.json",
    output:
        f"{STABILITY}/success/{{family}}.csv",
    log:
        f"{STABILITY}/logs/success_{{family}}.log",
    wildcard_constraints:
        family=NAME,
    params:
        content=content("stability success"),
        first=1000 * SEEDS,
        seeds=lambda wildcards: suite()["success"]["seeds"],
        few=lambda wildcards: suite()["success"]["few"],
        limit=lambda wildcards: suite()["success"]["time_limit"],
    shell:
        "python3 -m signorini stability success {wildcards.family} --seeds {params.first} {params.seeds} --few {params.few}"
        " --time-limit {params.limit} -o {output:q} 2>&1 | tee {log:q}"


rule stability_digits:
    input:
        library("stability digits", variant=lambda: suite()["digits"]),
        scene=ancient(studied_scene),
    output:
        f"{STABILITY}/digits/{{variant}}.csv",
    log:
        f"{STABILITY}/logs/digits_{{variant}}.log",
    wildcard_constraints:
        variant=NAME,
    params:
        content=content("stability digits"),
        statement=studied_statement,
        asked=of_studied("elements", "levels", "truth", "norms"),
        quick=QUICK_OPTION,
        name=lambda wildcards: digits_setting(wildcards, "variant", wildcards.variant),
        samples=lambda wildcards: digits_setting(wildcards, "samples", 1),
        threads=lambda wildcards: digits_setting(wildcards, "threads", 1),
    shell:
        "python3 -m signorini stability digits {input.scene:q} --variant {params.name}"
        " --samples {params.samples} --threads {params.threads} {params.quick} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule stability_floor:
    input:
        library("stability round-off", piece=round_off_pieces),
    output:
        f"{STABILITY}/floor/{{piece}}.csv",
    log:
        f"{STABILITY}/logs/floor_{{piece}}.log",
    wildcard_constraints:
        piece=NAME,
    priority: 5
    params:
        content=content("stability round-off"),
        levels=lambda wildcards: suite()["round_off"][wildcards.piece.partition("-")[0]],
    shell:
        "python3 -m signorini stability round-off {wildcards.piece} --levels {params.levels} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule stability_extremes:
    input:
        library("stability extremes", kind=lambda: suite()["extremes"]),
    output:
        f"{STABILITY}/extremes/{{kind}}.csv",
    log:
        f"{STABILITY}/logs/extremes_{{kind}}.log",
    wildcard_constraints:
        kind=NAME,
    params:
        content=content("stability extremes"),
        values=lambda wildcards: suite()["extremes"][wildcards.kind],
    shell:
        "python3 -m signorini stability extremes {wildcards.kind} --values {params.values} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule stability_report:
    input:
        library("stability report"),
        machine=f"{STABILITY}/machine.json",
        success=success_files,
        digits=lambda wildcards: stability_pieces("digits", suite()["digits"]),
        floor=round_off_files,
        extremes=lambda wildcards: stability_pieces("extremes", suite()["extremes"]),
    output:
        tex=f"{STABILITY}/stability.tex",
        markdown=f"{STABILITY}/stability.md",
        tables=expand(f"{STABILITY}/{{name}}.csv", name=STABILITY_TABLES),
    log:
        f"{STABILITY}/logs/report.log",
    params:
        content=content("stability report"),
        limit=lambda wildcards: suite()["success"]["time_limit"],
        seeds=SEEDS,
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini stability report {params.folder:q} --time-limit {params.limit}"
        " --seeds {params.seeds} 2>&1 | tee {log:q}"


rule figure_stability:
    input:
        library("stability figures"),
        success=success_files,
        floor=round_off_files,
    output:
        [
            f"{STABILITY}/stability_{figure}.{ending}"
            for figure in STABILITY_FIGURES
            for ending in ("pdf", "png")
        ],
    log:
        f"{STABILITY}/logs/figures.log",
    params:
        content=content("stability figures"),
        folder=subpath(output[0], parent=True),
    shell:
        "python3 -m signorini stability figures {params.folder:q} 2>&1 | tee {log:q}"
