"""Errors against an exact solution down to round-off, condition numbers, or the patch test on
stretched meshes.
"""

from stage import options, run

from signorini.storage import write_csv
from signorini.studies.stability import round_off as stability_floor


@options("--piece", ("--levels", {"type": float, "nargs": "+"}), "--output")
def main(arguments):
    """``<family>-<element>``, ``conditions`` or ``stretching`` (its levels are exponents of ten) to
    a row per level.
    """
    levels = [int(n) for n in arguments.levels]
    if arguments.piece == "conditions":
        rows = stability_floor.conditions(levels)
    elif arguments.piece == "stretching":
        rows = stability_floor.stretching([10.0**-k for k in arguments.levels])
    else:
        rows = stability_floor.errors(*arguments.piece.split("-"), levels)
    write_csv(arguments.output, rows)
    return f"floor: {arguments.piece}, {len(rows)} rows"


if __name__ == "__main__":
    run(main, __doc__)
