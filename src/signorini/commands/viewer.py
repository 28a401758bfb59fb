"""Write the viewer of a scene: a page with its solutions as surfaces to turn, for any browser.

The solutions are those of a build, and beside them its errors.csv, certificates.csv and the local
contributions of its certificates where it has them. Without --results the scene is solved here, and
these are left out. With --certify the bounds are computed here, so that surfaces can be coloured by
what each triangle contributes to them.

example:
  signorini viewer config/scenes/punch.yaml --results results/punch -o viewer.html
  signorini viewer config/scenes/punch.yaml --certify -o viewer.html
"""

from pathlib import Path

from signorini.api.solving import certify_levels, solve_levels
from signorini.certificate.level import read_level
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, domain_of, scene_of
from signorini.exceptions import SceneError
from signorini.report.viewer import viewer_data
from signorini.report.viewer_page import viewer_page
from signorini.scene.certified import check_certifiable
from signorini.scene.scene import naming
from signorini.solvers.stored import read_solution
from signorini.storage import read_csv, write_text


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--results", metavar="FOLDER", type=Path, help="where the scene was built, results/NAME"
    )
    parser.add_argument(
        "--mesh", metavar="FILE", help="the output of `signorini mesh`; made here if not given"
    )
    parser.add_argument(
        "--certify",
        action="store_true",
        help="compute guaranteed bounds here, as `certificate: true` in the scene does",
    )
    add_output(parser, "the page, .html", ending=".html")


def run(arguments):
    """Gather and write.

    Raises
    ------
    SceneError
        If a solution of the scene is not in the folder, or nothing of it can be certified.
    """
    scene, folder = scene_of(arguments.scene), arguments.results
    with naming(scene.source):
        domain, solutions = domain_of(scene, arguments.mesh), _solutions(scene, folder)
        if arguments.certify:
            check_certifiable(scene.document, "--certify")
            solutions = list(solutions)
            levels = certify_levels(scene, solutions)
            bounds = [row for level in levels for row in level.rows()]
        else:
            levels, bounds = _stored(scene, folder), _table(folder, "certificates.csv")
        errors = _table(folder, "errors.csv")
        data = viewer_data(scene, domain, solutions, errors, bounds, _contributions(levels))
    page = viewer_page(data)
    write_text(arguments.output, page)
    megabytes = len(page.encode()) / 1e6
    return Outcome(f"viewer: {len(data['solutions'])} solutions, {megabytes:.1f} MB")


def _solutions(scene, folder):
    """Those of a build, or without one solved here, one after the other."""
    if folder is None:
        return solve_levels(scene)
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"--results {folder}: is a file; name the folder of a build")
    files = [
        folder / "solutions" / element / f"n{n}.npz"
        for element in scene.elements
        for n in scene.levels
    ]
    missing = [file for file in files if not file.is_file()]
    if missing:
        raise SceneError(
            f"--results {folder}: there is no {missing[0]}; build the scene with "
            f"snakemake --cores 2 --config 'scenes=[{scene.name}]', or drop --results"
        )
    return map(read_solution, files)


def _table(folder, name):
    """The rows of a table of a build, or none where there is no such table."""
    return read_csv(folder / name) if folder and (folder / name).is_file() else ()


def _stored(scene, folder):
    """The certificates of a build, where it has some."""
    if folder is None:
        return []
    files = [folder / "certificates" / f"n{n}.npz" for n in scene.levels]
    return [read_level(file) for file in files if file.is_file()]


def _contributions(levels):
    """What each triangle has in the square of a bound, by element and n."""
    return {
        (element, level.n): level.of_triangles(element)["contribution"]
        for level in levels
        for element in level.elements
    }
