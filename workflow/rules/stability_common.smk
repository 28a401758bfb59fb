# What the rules of the stability suite generate and ask for.
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
