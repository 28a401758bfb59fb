"""What the viewer of a scene shows: every solution on few triangles, its contact line, its numbers.

All of it becomes JSON within one page, so that arrays are kept small: surfaces on the finest of the
coarser meshes that has few triangles, contact lines by every so many points, single precision.
"""

import base64
from decimal import ROUND_CEILING, ROUND_FLOOR, Context

import numpy as np

from signorini.errors.norms import NORMS
from signorini.fem.contact_line import contact_rows, critical_places
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.report.contact_side import critical_runs
from signorini.report.field import field_of, sums_on_coarser
from signorini.scene.certified import is_certifiable
from signorini.solvers.stored import mesh_of

MOST_TRIANGLES = 4096  # of a surface, where the mesh has coarser ones
MOST_POINTS = 400  # of a contact line, besides those at its critical points
_LINE = ("s", "x", "y", "u", "obstacle", "flux", "threshold")
_DIGITS = 4  # of a guaranteed bound


def viewer_data(scene, domain, solutions, errors=(), certificates=(), contributions=None):
    """Gather what the viewer of a scene shows.

    Parameters
    ----------
    scene : Scene
    domain : Rectangle or Refined
        The scene's.
    solutions : iterable of StoredSolution
        Taken one after the other; only what is shown is kept.
    errors : sequence of mapping, optional
        Rows of errors.csv, as text or numbers.
    certificates : sequence of mapping, optional
        Rows of certificates.csv: ``element``, ``n``, ``lower`` and ``upper``.
    contributions : mapping of (str, int) to ndarray, optional
        Element and n -> what each triangle of the mesh has in the square of the guaranteed bound.

    Returns
    -------
    dict
        Lists, dicts, text and numbers: ``name``, ``title``, ``elements`` (name -> label),
        ``levels``, ``norms`` (name -> label), ``certifiable``, ``meshes`` and ``solutions``, see
        `_shown`.

    Examples
    --------
    >>> import signorini
    >>> from signorini.api.solving import solve_levels
    >>> scene = signorini.load_scene("config/scenes/punch.yaml")
    >>> domain = scene.problem_statement.triangulations
    >>> data = viewer_data(scene, domain, solve_levels(scene))
    >>> data["levels"], len(data["solutions"]), len(data["meshes"])
    ([8, 16, 32, 64], 8, 3)
    """
    meshes, shown, contributions = {}, [], contributions or {}
    errors, certificates = _by_solution(errors), _by_solution(certificates)
    for solution in solutions:
        mesh = mesh_of(domain, solution)
        key = (solution.element, solution.n)
        shown.append(
            _shown(mesh, solution, meshes)
            | {"errors": _errors(errors.get(key, {}), scene.document["norms"])}
            | {"certificate": _certificate(certificates.get(key))}
            | {"shares": _shares(mesh, contributions.get(key))}
        )
    norms = [norm for norm in scene.document["norms"] if any(norm in s["errors"] for s in shown)]
    return {
        "name": scene.name,
        "title": scene.document["title"] or scene.name,
        "elements": {element: ELEMENT_FACTS[element].label for element in scene.elements},
        "levels": sorted({solution["n"] for solution in shown}),
        "norms": {norm: NORMS[norm].text for norm in norms},
        "certifiable": is_certifiable(scene.document),
        "meshes": [mesh for _, mesh in meshes.values()],
        "solutions": shown,
    }


def _by_solution(rows):
    return {(row["element"], int(row["n"])): row for row in rows}


def _errors(row, norms):
    return {norm: float(row[norm]) for norm in norms if row.get(norm) not in (None, "")}


def _certificate(row):
    """The bounds as text, rounded outward."""
    if row is None:
        return None
    ends = (("lower", ROUND_FLOOR), ("upper", ROUND_CEILING))
    return [
        str(Context(prec=_DIGITS, rounding=rounding).create_decimal(str(row[end])))
        for end, rounding in ends
    ]


def _shares(mesh, contributions):
    """Percent of all contributions that the triangles of the surface have; None without any."""
    if contributions is None:
        return None
    found = sums_on_coarser(mesh, contributions, MOST_TRIANGLES)
    return packed(100.0 * found / found.sum(), "f4")


def _shown(mesh, solution, meshes):
    """One solution: its numbers, its surface and its contact line.

    ``z`` is u at the corners of the triangles of mesh number ``mesh``: (3, nt), row after row.
    """
    field = field_of(mesh, solution, MOST_TRIANGLES)
    return {
        "element": solution.element,
        "n": solution.n,
        "h": solution.h,
        "dofs": int(solution.dofs),
        "triangles": int(mesh.number_of_triangles),
        "in_contact": int(np.sum(solution.active)),
        "resultant": float(np.sum(solution.force)),
        "steps": int(solution.iterations),
        "status": solution.status,
        "mesh": _number_of(field, meshes),
        "z": packed(field["values"], "f4"),
        "line": _line(mesh, solution),
    }


def _number_of(field, meshes):
    """The place of a mesh among those that are shown, where it is put if it is new.

    Levels that are shown on the same coarser mesh share it.
    """
    p, t = packed(field["p"], "f4"), packed(field["t"], "u4")
    number = len(meshes)
    return meshes.setdefault((p["base64"], t["base64"]), (number, {"p": p, "t": t}))[0]


def packed(values, kind):
    """An array as text.

    Parameters
    ----------
    values : array_like
        Taken row after row.
    kind : {"f4", "u4"}
        Single precision, or whole numbers of 32 bits; little-endian.

    Returns
    -------
    dict
        ``kind`` and ``base64``.

    Examples
    --------
    >>> packed([1.0], "f4")
    {'kind': 'f4', 'base64': 'AACAPw=='}
    """
    content = np.ascontiguousarray(values, dtype=f"<{kind}").tobytes()
    return {"kind": kind, "base64": base64.b64encode(content).decode()}


def _line(mesh, solution):
    """The contact line, its components apart by NaN; None without a contact part.

    ``critical`` has s, x, y and the obstacle of critical points that stand alone, ``turns`` the
    ends of the intervals on which contact and gaps alternate.
    """
    rows = contact_rows(mesh, solution)
    if not rows:
        return None
    columns = {name: np.array([row.get(name, 0.0) for row in rows]) for name in _LINE}
    component = np.array([row["component"] for row in rows])
    critical = np.array([row["critical"] is not None for row in rows])
    place, x, y = critical_places(mesh, solution)
    height = np.interp(place, columns["s"], columns["obstacle"])
    alone, turns = critical_runs({"s": columns["s"], "critical": place})
    kept = kept_points(component, critical)
    ends = np.flatnonzero(np.diff(component[kept])) + 1
    shown = {name: np.insert(column[kept], ends, np.nan) for name, column in columns.items()}
    if not columns["threshold"].any():
        del shown["threshold"]
    return {
        "columns": {name: packed(column, "f4") for name, column in shown.items()},
        "critical": np.array([place, x, y, height]).T[np.isin(place, alone)].tolist(),
        "turns": turns.tolist(),
    }


def kept_points(component, critical, most=MOST_POINTS):
    """Which points of a contact line are shown.

    Parameters
    ----------
    component : ndarray of int, shape (m,)
    critical : ndarray of bool, shape (m,)
        Whether a critical point lies between a point and the next.
    most : int, optional
        So many at even distances; the ends of components and both sides of critical points besides.

    Returns
    -------
    ndarray of int
        Increasing.

    Examples
    --------
    >>> ten = np.arange(10)
    >>> kept_points(np.ones(10, int), ten == 4, most=3).tolist()
    [0, 4, 5, 8, 9]
    """
    stride = -(-component.size // most)
    kept = np.arange(component.size) % stride == 0
    turns = critical | np.append(np.diff(component) != 0, True)
    kept |= turns | np.roll(turns, 1)
    return np.flatnonzero(kept)
