# The stability suite, `snakemake --cores 2 stability`; a finished piece is a file, so that it can be interrupted.

from datetime import date


def stability_pieces(folder, names):
    return [f"{STABILITY}/{folder}/{name}.csv" for name in names]


def stability_seeds():
    """0 for the fixed seeds; else the number asked for, or today's date as one (20261125), the same all day."""
    seeds = CONFIG["seeds"]
    if seeds == "random":
        seeds = int(date.today().strftime("%Y%m%d"))
        print(f"seeds: {seeds}; --config seeds={seeds} draws them again", file=sys.stderr)
    return 0 if seeds == "fixed" else seeds


# The first seed of every kind of problem. Random seeds, those of a day, do not touch what is documented.
SEEDS = stability_seeds()
STABILITY = f"{STUDIES}/stability" + (f"-{SEEDS}" if SEEDS else "")
STABILITY_FIGURES = ["ours", "rivals", "estimates", "floor", "stretched"]
STABILITY_TABLES = ["claims", "solvers", "statuses", "estimates", "digits", "crossings"]

# As in signorini.studies.stability.bodies.FAMILIES.
PROBLEM_FAMILIES = [
    *("right-angled", "rising", "criss-cross", "delaunay", "perturbed", "stretched", "needles"),
    *("graded", "inclusions", "layers", "oscillating"),
]
VARIANTS = {
    "auto": 1,
    "routes": 1,
    "routes-two-threads": 2,
    "last-bit": 1,
    "renumbered": 1,
}  # and their threads

_FINEST = {"smooth": 6 if QUICK else 11, "patch": 6 if QUICK else 12}
FLOOR = {
    **{
        f"{family}-{element}": [2**k for k in range(1, finest + 1)]
        for family, finest in _FINEST.items()
        for element in ("P1", "CR")
    },
    "conditions": [4, 8, 16, 32] if QUICK else [4, 8, 16, 32, 64, 128],
    "stretching": range(0, 9) if QUICK else [k / 2 for k in range(17)],
}
EXTREMES = {
    "scaling": [-900, 900] if QUICK else range(-900, 901, 100),
    "sizes": [-9, 9] if QUICK else range(-9, 10, 3),
    "offsets": [4, 14] if QUICK else range(2, 17, 2),
    "critical-points": [4, 64] if QUICK else [4, 64, 1024, 4096],
    "contact-sets": [],
    "walk": [50] if QUICK else [3000],
}


rule stability_success:
    input:
        library("stability success"),
    output:
        f"{STABILITY}/success/{{family}}.csv",
    log:
        f"{STABILITY}/logs/success_{{family}}.log",
    wildcard_constraints:
        family="|".join(PROBLEM_FAMILIES),
    params:
        content=content("stability success"),
        seeds=f"{1000 * SEEDS} {1 if QUICK else 25}",
        few=1 if QUICK else 3,
        limit=0.1 if QUICK else 1,
    shell:
        "python3 -m signorini stability success {wildcards.family} --seeds {params.seeds} --few {params.few}"
        " --time-limit {params.limit} -o {output:q} 2>&1 | tee {log:q}"


rule stability_digits:
    input:
        library("stability digits"),
        scene=ancient(PAPER_SCENE),
    output:
        f"{STABILITY}/digits/{{variant}}.csv",
    log:
        f"{STABILITY}/logs/digits_{{variant}}.log",
    wildcard_constraints:
        variant="|".join(VARIANTS),
    params:
        content=content("stability digits"),
        statement=lambda wildcards: statement_of("paper"),
        asked=of_paper("elements", "levels", "truth", "norms"),
        quick=QUICK_OPTION,
        name=lambda wildcards: wildcards.variant.removesuffix("-two-threads"),
        samples=lambda wildcards: {"last-bit": 5, "renumbered": 2}.get(wildcards.variant, 1),
        threads=lambda wildcards: VARIANTS[wildcards.variant],
    shell:
        "python3 -m signorini stability digits {input.scene:q} --variant {params.name}"
        " --samples {params.samples} --threads {params.threads} {params.quick} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule stability_floor:
    input:
        library("stability round-off"),
    output:
        f"{STABILITY}/floor/{{piece}}.csv",
    log:
        f"{STABILITY}/logs/floor_{{piece}}.log",
    wildcard_constraints:
        piece="|".join(FLOOR),
    priority: 5
    params:
        content=content("stability round-off"),
        levels=lambda wildcards: list(FLOOR[wildcards.piece]),
    shell:
        "python3 -m signorini stability round-off {wildcards.piece} --levels {params.levels} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule stability_extremes:
    input:
        library("stability extremes"),
    output:
        f"{STABILITY}/extremes/{{kind}}.csv",
    log:
        f"{STABILITY}/logs/extremes_{{kind}}.log",
    wildcard_constraints:
        kind="|".join(EXTREMES),
    params:
        content=content("stability extremes"),
        values=lambda wildcards: list(EXTREMES[wildcards.kind]),
    shell:
        "python3 -m signorini stability extremes {wildcards.kind} --values {params.values} -o {output:q}"
        " 2>&1 | tee {log:q}"


rule stability_report:
    input:
        library("stability report"),
        success=stability_pieces("success", PROBLEM_FAMILIES),
        digits=stability_pieces("digits", VARIANTS),
        floor=stability_pieces("floor", FLOOR),
        extremes=stability_pieces("extremes", EXTREMES),
    output:
        tex=f"{STABILITY}/stability.tex",
        markdown=f"{STABILITY}/stability.md",
        tables=expand(f"{STABILITY}/{{name}}.csv", name=STABILITY_TABLES),
    log:
        f"{STABILITY}/logs/report.log",
    params:
        content=content("stability report"),
        limit=0.1 if QUICK else 1,
        seeds=SEEDS,
        folder=STABILITY,
    shell:
        "python3 -m signorini stability report {params.folder:q} --time-limit {params.limit}"
        " --seeds {params.seeds} 2>&1 | tee {log:q}"


rule figure_stability:
    input:
        library("stability figures"),
        success=stability_pieces("success", PROBLEM_FAMILIES),
        floor=stability_pieces("floor", FLOOR),
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
        folder=STABILITY,
    shell:
        "python3 -m signorini stability figures {params.folder:q} 2>&1 | tee {log:q}"
