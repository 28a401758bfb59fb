# What the rules of the stability suite ask of config/stability.yaml.
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
STABILITY_FIGURES = ["ours", "rivals", "profiles", "estimates", "floor", "stretched"]
STABILITY_TABLES = ["claims", "solvers", "statuses", "estimates", "digits", "crossings"]

STABILITY_SETTINGS = "config/stability.yaml"
STABILITY_SCHEMA = LIBRARY / "signorini/studies/stability/settings.schema.yaml"


@cache
@reported
def suite():
    """The settings, checked; on a quick run those under quick replace the others."""
    settings = validated(
        load_yaml(STABILITY_SETTINGS), load_yaml(STABILITY_SCHEMA), STABILITY_SETTINGS
    )
    return settings | (settings.get("quick", {}) if QUICK else {})


def success_files(wildcards):
    return stability_pieces("success", suite()["families"])


def round_off_files(wildcards):
    return stability_pieces("floor", round_off_pieces())


def round_off_pieces():
    """What is measured of round-off: of a family of exact solutions a piece for each element."""
    from signorini.studies.stability.round_off import PIECES  # NumPy: only for the suite

    return [piece for piece in PIECES if piece.partition("-")[0] in suite()["round_off"]]


def digits_setting(wildcards, key, default):
    return suite()["digits"][wildcards.variant].get(key, default)
