"""What a timing depends on besides the code: machine, versions, threads, load."""

import os
import platform
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

OURS = ("numpy", "scipy", "scikit-fem", "snakemake")


def describe(packages=OURS):
    """The machine and the programs at hand; ``machine.md.j2`` puts it in words.

    Parameters
    ----------
    packages : sequence of str
        Distributions whose versions count.

    Returns
    -------
    dict
        ``processor``, ``cores``, ``memory`` (GB), ``system``, ``python``, ``blas``, ``threads`` (of
        a measured process), ``load`` (average of the last minute), ``date``, and ``versions`` of
        the packages that are installed.

    Examples
    --------
    >>> sorted(describe(["numpy", "no-such-package"])["versions"])
    ['numpy']
    """
    import numpy as np

    blas = np.show_config(mode="dicts")["Build Dependencies"]["blas"]
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {
        "processor": _processor() or platform.processor() or platform.machine(),
        "cores": os.cpu_count(),
        "memory": round(memory / 1e9, 1),
        "system": f"{platform.system()} {platform.release()}",
        "python": platform.python_version(),
        "blas": f"{blas['name']} {blas['version']}",
        "threads": int(os.environ.get("OMP_NUM_THREADS", os.cpu_count())),
        "load": os.getloadavg()[0],
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "versions": {name: number for name in packages if (number := _version(name))},
    }


def _version(name):
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _processor():
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.is_file() else []
    return next((line.split(":", 1)[1].strip() for line in lines if "model name" in line), None)
