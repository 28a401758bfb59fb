"""Measure errors against a scene's reference or exact solution.

Solutions are files that `signorini solve` wrote. Without any, all elements and levels of the scene
are solved here, and the reference, too. The slopes are then shown, with a star where they mean
nothing, for an error is round-off alone.

example:
  signorini errors config/scenes/smooth.yaml
  signorini errors config/scenes/paper.yaml --reference reference.npz -o errors.csv u4.npz u8.npz
"""

from signorini.api.scene_study import check_truth, scene_errors
from signorini.api.solving import solve_levels
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, domain_of, scene_of
from signorini.commands.text_table import text_table
from signorini.errors.measure import error_row
from signorini.errors.rates import SOUND, rate_rows
from signorini.scene.scene import naming
from signorini.solvers.stored import read_solution
from signorini.storage import write_csv

_SHOWN = ("element", "n", "h", "dofs")


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="*", help="solutions, .npz")
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    parser.add_argument(
        "--reference", metavar="FILE", help="the reference, .npz; solved here if not given"
    )
    parser.add_argument("--norms", nargs="+", metavar="NORM", help="default: those of the scene")
    add_output(parser, "the table, errors.csv", required=False, ending=".csv")


def run(arguments):
    """Measure, and write or show the table."""
    scene = scene_of(arguments.scene)
    check_truth(scene)
    norms = arguments.norms or scene.document["norms"]
    with naming(scene.source):
        domain = domain_of(scene, arguments.mesh)
        reference = read_solution(arguments.reference) if arguments.reference else None
        errors = scene_errors(scene, domain, norms, reference)
        solutions = solve_levels(scene)
        if arguments.solutions:
            solutions = map(read_solution, arguments.solutions)
        rows = [error_row(solution, errors) for solution in solutions]
    if arguments.output:
        write_csv(arguments.output, rows)
        return Outcome(f"errors: {len(rows)} solutions", rows)
    slopes = [] if arguments.solutions else _slopes(scene, rows, norms)
    return Outcome(text_table(rows + slopes, [*_SHOWN, *norms, "status"]), rows)


def _slopes(scene, rows, norms):
    """A row of slopes for each element, where there are two levels or more."""
    if len(scene.levels) < 2:
        return []
    kind = scene.document["slope"]
    empty = dict.fromkeys([*_SHOWN, *norms, "status"])
    found = {element: empty | {"element": element, "n": "slope"} for element in scene.elements}
    for rate in rate_rows(rows):
        if rate["kind"] == kind and rate["slope"] is not None:
            mark = "" if rate["floor"] == SOUND else "*"
            found[rate["element"]][rate["norm"]] = f"{rate['slope']:.2f}{mark}"
    return list(found.values())
