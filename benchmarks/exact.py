"""What an exact truth costs beside the solve: discretising and errors, in solves, of all scenes.

    python benchmarks/exact.py [--sizes 8,512] [--elements P1,CR] [--repeats 7] [--before FOLDER]

Processor time of one process on one thread; medians, each repeat doing everything once. With
`--before`, the folder `src` of another version of this project, the two versions take turns, each
in processes of its own.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STEPS = ("discretise", "solve", "errors")


def measure(path, element, n, repeats):
    """Seconds of each step in each repeat; printed as JSON."""
    import signorini
    from signorini.errors.exact import ExactErrors

    scene = signorini.load_scene(path)
    found = {step: [] for step in STEPS}
    for _ in range(repeats + 1):
        start = time.process_time()
        problem = signorini.discretize(scene, element, n)
        discretised = time.process_time()
        solution = signorini.solve(problem)
        solved = time.process_time()
        ExactErrors(scene.problem_statement.exact).of(problem.mesh, element, solution.u)
        ends = start, discretised, solved, time.process_time()
        for step, begin, end in zip(STEPS, ends, ends[1:], strict=False):
            found[step].append(end - begin)
    print(json.dumps({step: seconds[1:] for step, seconds in found.items()}))


def run(source, path, element, n, repeats):
    """Seconds of each step, in a process of its own with the version in the folder `source`."""
    command = [sys.executable, __file__, "--child", str(path), element, str(n), str(repeats)]
    environment = os.environ | {"PYTHONPATH": str(source), "OMP_NUM_THREADS": "1"}
    return json.loads(
        subprocess.run(
            command, check=True, stdout=subprocess.PIPE, text=True, env=environment
        ).stdout
    )


def compare(sources, path, element, n, repeats, turns=3):
    """Median seconds of each step for each version, which take turns."""
    found = [{step: [] for step in STEPS} for _ in sources]
    for _ in range(turns):
        for seconds, source in zip(found, sources, strict=True):
            for step, values in run(source, path, element, n, repeats).items():
                seconds[step] += values
    return [
        {step: statistics.median(values) for step, values in seconds.items()} for seconds in found
    ]


def row(name, element, n, now, before=None):
    """A line of the table: milliseconds now, the ratios to the solve, and how many times longer it
    took before.
    """
    parts = [name, element, str(n), *(f"{1e3 * now[step]:.1f}" for step in STEPS)]
    parts += [f"{now[step] / now['solve']:.1f}" for step in ("discretise", "errors")]
    parts += (
        [f"{before[step] / now[step]:.1f}" for step in ("discretise", "errors")] if before else []
    )
    return f"| {' | '.join(parts)} |"


def main():
    """Measure and print the table."""
    if sys.argv[1:2] == ["--child"]:
        path, element, n, repeats = sys.argv[2:]
        return measure(path, element, int(n), int(repeats))
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--sizes", default="8,512")
    parser.add_argument("--elements", default="P1,CR")
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--before", type=Path)
    arguments = parser.parse_args()
    sources = [ROOT / "src", *([arguments.before.resolve()] if arguments.before else [])]
    titles = [
        "scene",
        "element",
        "n",
        *(f"{step}, ms" for step in STEPS),
        "discretise / solve",
        "errors / solve",
    ]
    titles += ["discretise, before / now", "errors, before / now"] if arguments.before else []
    print(f"| {' | '.join(titles)} |\n| :--- | :--- |{' ---: |' * (len(titles) - 2)}")
    for path in sorted((ROOT / "config/scenes").glob("*.yaml")):
        if "kind: exact" not in path.read_text(encoding="utf-8"):
            continue
        for element in arguments.elements.split(","):
            for n in map(int, arguments.sizes.split(",")):
                print(
                    row(
                        path.stem,
                        element,
                        n,
                        *compare(sources, path, element, n, arguments.repeats),
                    ),
                    flush=True,
                )


if __name__ == "__main__":
    main()
