"""Tell what a scene takes before it is built: solves, jobs, processor time, memory and disk.

Nothing is solved, nor meshed beyond what the check of a scene needs. Counted are the jobs that
mesh, solve and sweep. Other jobs measure, tabulate and draw; `snakemake --dry-run` counts them too.
With --sample, a few points or levels are solved as the jobs do, and the forecast for them is held
against the time that they took.

example:
  signorini forecast config/scenes/punch-widths.yaml --cores 2
  signorini forecast config/scenes/punch-widths.yaml --sample 5
"""

import math
import os
import time
from argparse import Namespace
from pathlib import Path
from tempfile import TemporaryDirectory

from signorini.commands import mesh, solve
from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_scene, scene_of
from signorini.exceptions import SceneError
from signorini.scene.sweep import sweep_points
from signorini.sweeps.bundles import bundles
from signorini.sweeps.forecast import level_cost, scene_jobs, sweep_jobs
from signorini.sweeps.jobs import by_rule, elapsed, peak_memory
from signorini.sweeps.sample import sample_points, spread
from signorini.wording import counted

_HEAD = ("rule", "jobs", "solves", "processor time, s", "peak memory, MB", "on disk, MB")
_NOT_COUNTED = "Not counted: jobs that measure, tabulate and draw, and Snakemake itself."
_UNCOUNTED = "The triangles of a mesh file are not counted: all figures but counts are too low."


def add_arguments(parser):
    """Declare the command's arguments."""
    add_scene(parser)
    parser.add_argument(
        "--cores", type=int, metavar="N", help="as of snakemake; default: those of this machine"
    )
    parser.add_argument(
        "--sweep-jobs", type=int, metavar="N", help="as of snakemake --config sweep_jobs=N"
    )
    parser.add_argument(
        "--sample", type=int, metavar="K", help="solve K points, or levels, and compare"
    )


def run(arguments):
    """Count, add up, and solve a sample if one is asked for.

    Raises
    ------
    SceneError
        Where an option is no positive number; or as `scene_of`.
    """
    for option in ("cores", "sweep_jobs", "sample"):
        _check_positive(option, getattr(arguments, option))
    scene, cores = scene_of(arguments.scene), arguments.cores or os.cpu_count() or 1
    data = _forecast(scene, cores, arguments.sweep_jobs)
    lines = _summary(scene, data)
    if arguments.sample:
        data["sample"] = _sampled(scene, arguments.sample)
        lines.append(_told_sample(data["sample"]))
    return Outcome("\n".join(lines), data)


def _check_positive(option, value):
    if value is not None and value < 1:
        flag = option.replace("_", "-")
        raise SceneError(f"--{flag} {value}: expected a positive whole number, for instance 4")


def _forecast(scene, cores, most):
    """All numbers of a forecast; seconds and bytes."""
    swept = "sweep" in scene.document
    jobs = scene_jobs(scene) + (sweep_jobs(scene, most) if swept else [])
    return {
        "scene": scene.name,
        "points": len(sweep_points(scene.document["sweep"])) if swept else 0,
        "rules": by_rule(jobs),
        "jobs": len(jobs),
        "solves": sum(job.solves for job in jobs),
        "seconds": math.fsum(job.seconds for job in jobs),
        "cores": cores,
        "elapsed": elapsed(jobs, cores),
        "memory": peak_memory(jobs, cores),
        "disk": math.fsum(job.disk for job in jobs),
        "counted": scene.document["domain"]["kind"] != "mesh",
    }


def _summary(scene, data):
    """The lines of a forecast."""
    largest = max(row["memory"] for row in data["rules"])
    total = data | {"rule": "sum", "memory": largest}
    rows = [_HEAD, *map(_cells, [*data["rules"], total])]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    points = f"{counted(data['points'], 'point')}, " if data["points"] else ""
    solves, jobs = counted(data["solves"], "solve"), counted(data["jobs"], "job")
    last = (
        f"With {counted(data['cores'], 'core')} about {data['elapsed']:.1f} s, "
        f"and at most {data['memory'] / 1e6:.0f} MB at once."
    )
    uncounted = [] if data["counted"] else [_UNCOUNTED]
    return [
        f"{scene.name}: {points}{solves} in {jobs}",
        *(_line(row, widths) for row in rows),
        last,
        _NOT_COUNTED,
        *uncounted,
    ]


def _cells(row):
    memory, disk = f"{row['memory'] / 1e6:.0f}", f"{row['disk'] / 1e6:.2f}"
    counts = (str(row["jobs"]), str(row["solves"]))
    return row["rule"], *counts, f"{row['seconds']:.2f}", memory, disk


def _line(row, widths):
    first, *others = (
        cell.ljust(width) if k == 0 else cell.rjust(width)
        for k, (cell, width) in enumerate(zip(row, widths, strict=True))
    )
    return "  ".join([first, *others])


def _sampled(scene, count):
    """A sample, solved: how much of what, and the seconds that were forecast and measured."""
    with TemporaryDirectory() as folder:
        if "sweep" in scene.document:
            (ordered,) = bundles(scene.document["sweep"], most=1)
            chosen, kind = spread(ordered, count), "points"
            solves, forecast, measured = sample_points(scene, chosen, folder)
        else:
            chosen, kind = spread(scene.levels, count), "levels"
            solves, forecast, measured = _sampled_levels(scene, chosen, Path(folder))
    found = {"of": kind, "asked": count, "count": len(chosen), "solves": solves}
    times = {"forecast": forecast, "measured": measured, "ratio": forecast / measured}
    return found | times


def _sampled_levels(scene, levels, folder):
    """Solve levels as the jobs do, without the start of a process."""
    asked = [(element, n) for element in scene.elements for n in levels]
    file = str(folder / "mesh.npz")
    mesh.run(Namespace(scene=scene.source, output=file))
    _solve(scene, file, folder, *asked[0])  # loads what a process loads once
    start = time.process_time()
    for element, n in asked:
        _solve(scene, file, folder, element, n)
    measured = time.process_time() - start
    foreseen = math.fsum(level_cost(scene, *pair)[0] for pair in asked)
    return len(asked), foreseen, measured


def _solve(scene, file, folder, element, n):
    asked = {"scene": scene.source, "element": element, "n": n, "mesh": file}
    default = {"reference": False, "method": None, "accuracy": None}
    solve.run(Namespace(**asked, **default, output=str(folder / "u.npz")))


def _told_sample(sample):
    of, solves = sample["of"].removesuffix("s"), counted(sample["solves"], "solve")
    fewer = f" (there are no {sample['asked']})" if sample["asked"] > sample["count"] else ""
    return (
        f"A sample of {counted(sample['count'], of)}{fewer}, {solves}: forecast "
        f"{sample['forecast']:.3g} s, measured {sample['measured']:.3g} s of processor time, "
        f"forecast over measured {sample['ratio']:.2f}."
    )
