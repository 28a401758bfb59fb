"""The numbers of a scene's results by key, as the text that stands in their tables."""

from itertools import pairwise
from pathlib import Path

from signorini.errors.rates import rate_between
from signorini.publication.compare import check_summary
from signorini.publication.keys import (
    BOUNDS,
    CERTIFICATE,
    CHOICES,
    COARSEST,
    DEVIATION,
    EFFECT,
    FACTS,
    FILES,
    FINEST,
    LINE,
    PUBLISHED,
    QUANTITY,
    RATE,
    SLOPE,
    THRESHOLD,
    key_of,
)
from signorini.publication.published import read_published
from signorini.publication.swept import SWEEP, swept_values
from signorini.report.result_files import read_errors, read_rates
from signorini.scene.sweep import sweep_points
from signorini.scene.table import computed_norms
from signorini.storage import read_csv, read_npz


def read_numbers(scene, folder, tables):
    """The numbers of some tables.

    Parameters
    ----------
    scene : Scene
    folder : str or Path
        Of its results.
    tables : iterable of str
        Of `keys.FILES`.

    Returns
    -------
    dict
        Key -> text: a number, or ``inf``. What a table leaves empty has no key.

    Raises
    ------
    StorageError
        If a table is missing, altered, or lacks a row.
    """
    found = {}
    for table in tables:
        found |= _READERS[table](scene, Path(folder, FILES[table]))
    return {key: str(value) for key, value in found.items() if value not in (None, "")}


def _of_scene(scene, _):
    levels, truth = scene.levels, scene.truth
    found = {"level, coarsest": levels[0], "level, finest": levels[-1], "level, count": len(levels)}
    if SWEEP in scene.document:
        found["sweep, count"] = len(sweep_points(scene.document[SWEEP]))
    return found | ({"reference, n": truth["n"]} if truth["kind"] == "reference" else {})


def _of_errors(scene, path):
    rows = read_errors(path, scene.section("elements", "levels"))
    return error_numbers(rows, computed_norms(scene.document))


def error_numbers(rows, norms):
    """Errors, what is known of their solves, and the rate from the level before.

    Parameters
    ----------
    rows : sequence of mapping
        Of errors.csv, by increasing level.
    norms : sequence of str

    Returns
    -------
    dict
        Key -> value as it stands in the row; a rate is log(e'/e) / log(h'/h), dimensionless.

    Examples
    --------
    Halved h, a quarter of the error: a rate of two.

    >>> rows = [{"element": "CR", "n": n, "h": 1 / n, "l2": n**-2.0} for n in (2, 4)]
    >>> error_numbers(rows, ["l2"])["rate, l2, CR, 4"]
    2.0
    """
    found = {}
    for element in dict.fromkeys(row["element"] for row in rows):
        own = [row for row in rows if row["element"] == element]
        named = {row["n"]: row for row in own} | {COARSEST: own[0], FINEST: own[-1]}
        for n, row in named.items():
            found |= {key_of(name, element, n): row.get(name) for name in (*norms, *FACTS)}
        steps = {fine["n"]: (coarse, fine) for coarse, fine in pairwise(own)}
        for n, step in (steps | ({FINEST: steps[own[-1]["n"]]} if steps else {})).items():
            found |= {key_of(RATE, norm, element, n): rate_between(*step, norm) for norm in norms}
    return found


def _of_rates(scene, path):
    rows = read_rates(path, scene.section("elements", "norms"))
    return slope_numbers(rows, scene.document["slope"])


def slope_numbers(rows, kind):
    """Slopes of every kind, and those of the scene's kind without saying which.

    Parameters
    ----------
    rows : sequence of mapping
        Of rates.csv.
    kind : {"mean", "fit"}

    Returns
    -------
    dict
        Key -> slope as it stands in the row, dimensionless.

    Examples
    --------
    >>> row = {"element": "CR", "norm": "l2", "kind": "mean", "slope": "2.1"}
    >>> slope_numbers([row], "mean")
    {'slope, l2, CR, mean': '2.1', 'slope, l2, CR': '2.1'}
    """
    found = {}
    for row in rows:
        key = key_of(SLOPE, row["norm"], row["element"])
        found[key_of(key, row["kind"])] = row["slope"]
        if row["kind"] == kind:
            found[key] = row["slope"]
    return found


def _of_outputs(scene, path):
    found = {}
    ends = {str(scene.levels[0]): COARSEST, str(scene.levels[-1]): FINEST}
    for row in read_csv(path):
        words = QUANTITY, row["name"], row["element"]
        found[key_of(*words, row["n"])] = row["value"]
        if row["n"] in ends and row["element"] in scene.elements:
            found[key_of(*words, ends[row["n"]])] = row["value"]
    return found


def _of_certificates(scene, path):
    found = {}
    every = {"element": scene.elements, "n": list(map(str, scene.levels))}
    ends = {str(scene.levels[0]): COARSEST, str(scene.levels[-1]): FINEST}
    for row in read_csv(path, every=every):
        for n in filter(None, (row["n"], ends.get(row["n"]))):
            words = row["element"], n
            found |= {key_of(CERTIFICATE, name, *words): row[name] for name in BOUNDS}
    return found


def _of_line(scene, path):
    found = {}
    rows = read_csv(path)
    for element in scene.elements:
        own = [row for row in rows if row["element"] == element]
        for number, row in enumerate(own, start=1):
            cells = {name: row.get(name) for name in (*LINE, THRESHOLD)}
            found |= {key_of("contact", name, element, number): cells[name] for name in cells}
        critical = [row["critical"] for row in own if row["critical"]]
        found[key_of("critical", element, "count")] = len(critical)
        for number, place in enumerate(critical, start=1):
            found[key_of("critical", element, number)] = place
    return found


def _of_check(scene, path):
    published = read_published(scene.document["publication"]["published"])
    rows = read_csv(path, every={"cell": [number.cell for number in published.values()]})
    summary = check_summary(rows)
    counts = {"total": summary.total, "matched": summary.matched, "exact": summary.exact}
    found = {key_of("check", name): count for name, count in counts.items()}
    found["check, largest"] = summary.largest
    by_cell = {row["cell"]: row for row in rows}
    for number in published.values():
        found[key_of(PUBLISHED, number.key)] = number.value
        found[key_of(DEVIATION, number.key)] = by_cell[number.cell]["units"]
    return found


def _of_effects(_, path):
    rows = read_csv(path, every={"choice": CHOICES})
    return {key_of(EFFECT, row["choice"]): row["change"] for row in rows}


def _of_sweep(scene, path):
    found = swept_values(scene.document, read_csv(path))
    return {key_of(SWEEP, *words): text for words, text in found.items()}


def _of_surface(_, path):
    surface = read_npz(path, kind="surface")
    u, obstacle = surface["contact_u"], surface["contact_obstacle"]
    free = [k for k in range(len(u)) if u[k] != obstacle[k]]
    found = {
        "surface, cells": len(surface["x"]) - 1,
        "surface, corner": float(surface["u"][0][0]),
        "surface, contact_cells": len(surface["contact_x"]) - 1,
        "surface, last_free": free[-1] if free else None,
    }
    for number, (x, y) in enumerate(surface["critical_points"], start=1):
        found[f"surface, critical_x, {number}"] = float(x)
        found[f"surface, critical_y, {number}"] = float(y)
    return found


_READERS = {
    "scene": _of_scene,
    "errors": _of_errors,
    "rates": _of_rates,
    "outputs": _of_outputs,
    "contact_line": _of_line,
    "check": _of_check,
    "effects": _of_effects,
    "certificates": _of_certificates,
    "surface": _of_surface,
    "sweep": _of_sweep,
}
