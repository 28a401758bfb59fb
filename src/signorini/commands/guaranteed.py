"""Hold the errors of a scene, and published ones, against guaranteed bounds from one fine mesh.

The fine level is solved here for both elements, under the exact load. Its enclosure certifies the
solutions of all coarser levels against the continuous problem, however their load was integrated.

example:
  signorini guaranteed config/scenes/paper.yaml u4.npz u8.npz --fine 512 -o guaranteed
"""

import logging
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.publication.published import read_published
from signorini.scene.scene import naming
from signorini.solvers.stored import read_solution
from signorini.storage import write_csv, write_text
from signorini.studies.guaranteed.page import page
from signorini.studies.guaranteed.rows import fine_enclosure, rows_of

_log = logging.getLogger(__name__)


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="+", help="to be certified, .npz")
    parser.add_argument("--fine", type=int, required=True, metavar="N", help="the fine level")
    parser.add_argument("--published", metavar="FILE", help="published errors, .csv")
    parser.add_argument("--quick", action="store_true", help="say that the fine level is coarse")
    parser.add_argument("-o", "--output", required=True, type=Path, metavar="FOLDER")


def run(arguments):
    """Write guaranteed.csv, guaranteed.md and guaranteed.tex."""
    scene, folder = scene_of(arguments.scene), arguments.output
    solutions = [read_solution(path) for path in arguments.solutions]
    published = _published(arguments.published) if arguments.published else {}
    statement = scene.problem_statement
    with naming(scene.source):
        _log.info("n = %d: solving and certifying", arguments.fine)
        fine = fine_enclosure(statement, arguments.fine, scene.document["solver"]["method"])
        rows = rows_of(fine, statement.triangulations, solutions, published)
    write_csv(folder / "guaranteed.csv", rows)
    for layout, ending in (("latex", "tex"), ("markdown", "md")):
        write_text(folder / f"guaranteed.{ending}", page(layout, rows, fine, arguments.quick))
    return Outcome(f"page: guaranteed, {len(rows)} errors", rows)


def _published(path):
    """(norm, element, n) -> error."""
    numbers = read_published(path).values()
    return {
        (number.quantity, number.element, int(number.n)): float(number.value)
        for number in numbers
        if number.n
    }
