"""What every stage does around its work: find the library, report a user's mistake in one line, run
on one thread.
"""

import gc
import os
import sys
import time
from argparse import ArgumentParser
from pathlib import Path

# A job is short: looking for cyclic garbage, above all while importing and at exit, takes a fifth
# of its time.
gc.disable()
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "src"))
# Jobs share the machine's cores among themselves, and sums must not depend on how many threads
# there are.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

from signorini.exceptions import SignoriniError, StorageError  # noqa: E402 (needs the path above)


def run(main, description):
    """Parse the command line with the options that `main` declares and call it.

    Parameters
    ----------
    main : callable
        ``main(arguments)``; its attribute ``options`` is a tuple of (flag, keyword arguments of
        add_argument).
    description : str
        First line of ``--help``.
    """
    parser = ArgumentParser(description=description)
    parser.add_argument("--scene-file", help="the file of the scene, which errors name")
    for flag, settings in main.options:
        parser.add_argument(
            flag, **({"required": True} if flag.startswith("--") else {}) | settings
        )
    arguments, start = parser.parse_args(), time.perf_counter()
    try:
        line = main(arguments)
    except StorageError as error:  # which names the file to delete
        sys.exit(f"error: {error}")
    except SignoriniError as error:
        sys.exit(
            f"error: {arguments.scene_file}: {error}" if arguments.scene_file else f"error: {error}"
        )
    gc.freeze()
    print(f"{line} ({time.perf_counter() - start:.2f} s)")


def options(*declared):
    """Attach options, each a flag or a pair (flag, settings), to a stage's main function."""

    def attach(main):
        main.options = tuple(item if isinstance(item, tuple) else (item, {}) for item in declared)
        return main

    return attach
