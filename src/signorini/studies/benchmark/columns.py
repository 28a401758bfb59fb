"""The columns and rows of the benchmark's tables, for those who write and those who read them."""

STAGES = ("mesh", "assembly", "solve")
TIMES = (*STAGES, "total")
COUNTS = ("products", "cycles", "factorisations", "steps", "inner")
SERIES = ("scene", "element", "method")


def with_range(name):
    """A measured column and those of its least and largest value.

    Examples
    --------
    >>> with_range("seconds")
    ('seconds', 'seconds_min', 'seconds_max')
    """
    return name, f"{name}_min", f"{name}_max"


POINT_NUMBERS = (
    *("n", "h", "dofs", "repeats"),
    *(column for name in TIMES for column in with_range(name)),
    *("memory", "peak", "iterations", *COUNTS, "residual", "difference", "load"),
)
POINT = (*SERIES, "status", "note", *POINT_NUMBERS)
"""A point: scene, element, route and level. Times in seconds: medians, least and largest over the
repeats. `memory` and `peak` in bytes: beyond what the process held before, and in all. `status` is
"measured", or "skipped" for the reason in `note`; a `note` of a measured one says why its solution
is in full and not to discretisation accuracy. `difference` is that of u from the stored
solution, whose errors are listed, relative to max |u|. `load` is the machine's load average over
the last minute when the point began. Counts as in `signorini.work.Work`."""

RIVAL_NUMBERS = (
    *("n", "dofs", "claimed", "residual", "difference", "iterations", *with_range("seconds")),
    *("auto", "ours_seconds", "ours_min", "ours_max", *with_range("ratio")),
)
RIVAL = ("scene", "element", "rival", "ours", "status", "note", *RIVAL_NUMBERS)
"""A rival, a problem and one of our routes: seconds of the solves alone, and the rival's over ours,
pair by pair. `status` is "solved", "inaccurate" or "failed" by our residual, "absent" (`note`: how
to install it) or "left out"; `claimed` is what the rival says; `difference` that of u, relative;
`auto` whether "auto" takes this route."""

TOLERANCE = 1e-9
"""Asked of the rivals; ours have none to ask for."""

WHOLE = ("n", "dofs", "repeats", "memory", "peak", "iterations", *COUNTS, "claimed", "auto")
"""Of both tables, the columns of whole numbers."""


def series(points):
    """(scene, element, method) -> its measured points, coarsest first.

    Examples
    --------
    >>> point = {"scene": "paper", "element": "P1", "method": "direct", "status": "measured"}
    >>> points = [point | {"n": 4}, point | {"n": 2}, point | {"n": 8, "status": "skipped"}]
    >>> by_series = series(points)
    >>> [row["n"] for row in by_series["paper", "P1", "direct"]]
    [2, 4]
    """
    by_series = {}
    for row in points:
        if row["status"] == "measured":
            by_series.setdefault(tuple(row[key] for key in SERIES), []).append(row)
    return {key: sorted(rows, key=lambda row: int(row["n"])) for key, rows in by_series.items()}
