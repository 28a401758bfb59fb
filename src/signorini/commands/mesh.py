"""Make the coarsest mesh of a scene; all its levels are refined from it.

example:
  signorini mesh config/scenes/l-shape.yaml -o l-shape.npz
"""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.mesh.domain import write_domain


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    add_output(parser, "the mesh, .npz", ending=".npz")


def run(arguments):
    """Make the mesh and write it."""
    scene = scene_of(arguments.scene)
    domain, coarsest = scene.problem_statement.triangulations, scene.levels[0]
    write_domain(arguments.output, domain)
    kind, triangles = scene.document["domain"]["kind"], domain.level(coarsest).number_of_triangles
    return Outcome(
        f"mesh: {kind}, {triangles} triangles at n = {coarsest}",
        {"kind": kind, "n": coarsest, "triangles": triangles},
    )
