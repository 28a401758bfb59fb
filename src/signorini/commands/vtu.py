"""Write solutions as VTU, which ParaView and meshio read: u, its gradient, boundary and contact.

Several levels of one element become a series, FILE.pvd, with a file for each level in the folder
FILE beside it. With --scene the coefficient is written, too, and with --certificates what each
triangle contributes to the bound of the error, and the mean of the guaranteed gradient.

example:
  signorini vtu mesh.npz u.npz -o u.vtu
  signorini vtu mesh.npz n8.npz n16.npz --scene config/scenes/punch.yaml -o P1.pvd
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_mesh, add_output, scene_of
from signorini.exceptions import SignoriniError
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data import read_coefficient
from signorini.mesh.domain import read_domain
from signorini.report.vtu import write_series, write_vtu
from signorini.solvers.stored import mesh_of, read_solution


def add_arguments(parser):
    """Declare the command's arguments."""
    add_mesh(parser)
    parser.add_argument("solutions", metavar="SOLUTION", nargs="+", help="solutions, .npz")
    parser.add_argument("--scene", metavar="SCENE", type=Path, help="writes its coefficient")
    parser.add_argument(
        "--certificates",
        metavar="FILE",
        nargs="+",
        default=[],
        help="outputs of `signorini certificate`, by level as the solutions",
    )
    add_output(parser, "the file: .vtu of one solution, .pvd of a series")


def run(arguments):
    """Write the file, or the series.

    Raises
    ------
    SignoriniError
        If the ending is neither, or solutions are not one for a file or a series.
    MeshError
        If a solution is not one on this mesh.
    """
    path = Path(arguments.output)
    if path.suffix not in (".vtu", ".pvd"):
        raise SignoriniError(f"-o {path}: end it in .vtu, or in .pvd for a series of levels")
    if path.suffix == ".vtu" and len(arguments.solutions) > 1:
        raise SignoriniError(f"-o {path}: holds one solution; end it in .pvd for a series")
    domain = read_domain(arguments.mesh)
    scene = scene_of(arguments.scene) if arguments.scene else None
    certificates = _certificates(arguments.certificates)
    files = {}
    for source in arguments.solutions:
        solution = read_solution(source)
        target = _target(path, solution, files)
        mesh = mesh_of(domain, solution)
        more = _coefficient(scene, mesh) | _certified(certificates, solution, mesh)
        write_vtu(target, mesh, solution, more)
        files[solution.element, solution.n] = target
    if path.suffix == ".pvd":
        levels = {n: f"{path.stem}/{target.name}" for (_, n), target in files.items()}
        write_series(path, levels)
    names = [f"{element} n = {n}" for element, n in files]
    return Outcome(f"vtu: {', '.join(names)}")


def _target(path, solution, files):
    """Where a solution is written; those of a series are of one element, and differ in level."""
    if path.suffix == ".vtu":
        return path
    elements = {element for element, _ in files} | {solution.element}
    if len(elements) > 1 or (solution.element, solution.n) in files:
        raise SignoriniError(
            f"{solution.element} n = {solution.n}: a series takes each level of one element once; "
            "give another -o"
        )
    return path.with_suffix("") / f"n{solution.n}.vtu"


def _coefficient(scene, mesh):
    """The coefficient on every triangle, where there is a scene to ask."""
    if scene is None:
        return {}
    import numpy as np

    given = coefficient_on(mesh, read_coefficient(scene.document["data"]["coefficient"]))
    return {"coefficient": np.ones(mesh.number_of_triangles) if given is None else given}


def _certificates(paths):
    """Level -> its certificates."""
    if not paths:
        return {}
    from signorini.certificate.level import read_level

    levels = map(read_level, paths)
    return {level.n: level for level in levels}


def _certified(certificates, solution, mesh):
    """What a certificate says of every triangle, where there is one of this level and element."""
    level = certificates.get(solution.n)
    if level is None or solution.element not in level.elements:
        return {}
    found = level.of_triangles(solution.element)
    if len(found["contribution"]) != mesh.number_of_triangles:
        raise SignoriniError(
            f"--certificates: that of n = {solution.n} is of a mesh with "
            f"{len(found['contribution'])} triangles, the solution of one with "
            f"{mesh.number_of_triangles}; give those of its scene"
        )
    return found
