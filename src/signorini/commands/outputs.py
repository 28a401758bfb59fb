"""Compute the quantities that a scene asks for: lengths, places and fluxes on the boundary.

Solutions are files that `signorini solve` wrote. Without any, all elements and levels of the scene
are solved here, and its reference, too.

example:
  signorini outputs config/scenes/seepage.yaml
  signorini outputs config/scenes/seepage.yaml --mesh mesh.npz -o outputs.csv u4.npz u8.npz
"""

from signorini.api.solving import solve_level, solve_levels
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, domain_of, scene_of
from signorini.commands.text_table import text_table
from signorini.exceptions import SceneError
from signorini.fem.problem import discretize_on
from signorini.report.outputs import output_rows
from signorini.scene.scene import naming
from signorini.solvers.stored import mesh_of, read_solution
from signorini.storage import write_csv

_SHOWN = ("element", "n", "h", "name", "value", "unit")


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="*", help="solutions, .npz")
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    add_output(parser, "the table, outputs.csv", required=False, ending=".csv")


def run(arguments):
    """Compute, and write or show the table.

    Raises
    ------
    SceneError
        If the scene names no quantities.
    """
    scene = scene_of(arguments.scene)
    quantities = scene.document["quantities"]
    if not quantities:
        raise SceneError(
            f"{scene.source}: quantities: there are none; name one, for instance "
            "quantities: {contact: {kind: contact_length}}"
        )
    with naming(scene.source):
        domain = domain_of(scene, arguments.mesh)
        rows = []
        for solution in _solutions(scene, arguments.solutions):
            mesh = mesh_of(domain, solution)
            problem = discretize_on(mesh, solution.element, scene.problem_statement)
            rows += output_rows(problem, solution, quantities)
    if arguments.output:
        write_csv(arguments.output, rows)
        return Outcome(f"outputs: {len(quantities)} quantities, {len(rows)} values", rows)
    return Outcome(text_table(rows, _SHOWN), rows)


def _solutions(scene, paths):
    """Stored solutions, or without any those of the scene, its reference last."""
    if paths:
        yield from map(read_solution, paths)
        return
    yield from solve_levels(scene)
    if scene.truth["kind"] == "reference":
        yield solve_level(scene, scene.truth["element"], scene.truth["n"])
