"""The page of the adaptive study: the numbers that fill ``page.md.j2``."""

from signorini.report.document import render
from signorini.studies.adaptive.summary import compare

PAGE = "studies/adaptive/page.md.j2"
_PAYS = 2.0  # ratio of unknowns from which the page says that adaptive meshes pay


def page(layout, runs, quick=False):
    """Put the page together.

    Parameters
    ----------
    layout : {"markdown", "latex"}
    runs : dict
        Scene -> (element, "adaptive" or "uniform") -> a frame of `summary.run_of`.
    quick : bool, optional
        Whether the runs were small.

    Returns
    -------
    str
    """
    rows = {scene: _of_p1(frames) for scene, frames in runs.items()}
    pays = [scene for scene, row in rows.items() if row["fewer"] >= _PAYS]
    known = {scene: row["effectivity"] for scene, row in rows.items() if row["effectivity"]}
    return render(
        PAGE,
        layout,
        rows=rows,
        pays=pays,
        does_not=[scene for scene in rows if scene not in pays],
        best=max(rows, key=lambda scene: rows[scene]["fewer"]),
        slopes=[row["slope"] for row in rows.values()],
        known=known,
        quick=quick,
    )


def summary_rows(runs):
    """The comparison of every scene as a table.

    Parameters
    ----------
    runs : dict
        As of `page`.

    Returns
    -------
    list of dict
    """
    return [{"scene": scene} | _of_p1(frames) for scene, frames in runs.items()]


def _of_p1(frames):
    """The comparison of the element that both runs refine for."""
    return compare(frames["P1", "adaptive"], frames["P1", "uniform"])
