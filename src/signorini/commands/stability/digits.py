"""Compute a scene's table in another way that is equally right, to see which digits stay.

example:
  signorini stability digits config/scenes/paper.yaml --variant renumbered -o renumbered.csv
"""

import os

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of

_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
_QUICK_LEVELS, _QUICK_REFERENCE = 4, 64


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("--variant", required=True, metavar="NAME")
    parser.add_argument("--samples", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--quick", action="store_true", help="coarse levels only")
    add_output(parser, "a row for each number, .csv", ending=".csv")


def run(arguments):
    """Solve and write."""
    for name in _THREADS:
        os.environ[name] = str(arguments.threads)
    # NumPy counts its threads when it is imported.
    from signorini.storage import write_csv
    from signorini.studies.stability.digits import variant

    scene = scene_of(arguments.scene)
    sections = sections_of(scene, arguments.quick)
    rows = variant(arguments.variant, scene.problem_statement, sections, arguments.samples)
    if arguments.threads > 1:
        rows = [row | {"variant": f"{arguments.threads}-threads-{row['variant']}"} for row in rows]
    write_csv(arguments.output, rows)
    return Outcome(f"digits: {arguments.variant}, {len(rows)} numbers")


def sections_of(scene, quick):
    """What the scene asks, and no finer where the suite is to be quick.

    Parameters
    ----------
    scene : Scene
    quick : bool

    Returns
    -------
    dict
    """
    sections = scene.section("elements", "levels", "truth", "norms")
    if not quick:
        return sections
    truth = sections["truth"] | {"n": _QUICK_REFERENCE}
    return sections | {"levels": sections["levels"][:_QUICK_LEVELS], "truth": truth}
