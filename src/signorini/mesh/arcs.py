"""Polygons with curved sides: these are cut into chords about as long as the mesh width before the
polygon is triangulated, so that its triangulation follows the curves from the start.
"""

from dataclasses import replace

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.curved import nearest_on
from signorini.mesh.polygon import triangulate

_MOST = 2**16  # chords of a side


def triangulate_curved(domain, size, curves):
    """Triangulate a polygon some of whose sides are curved.

    Parameters
    ----------
    domain : dict
        ``corners`` and ``holes`` of the polygon, and perhaps the names of its ``sides``.
    size : float
        Mesh width, unit of length.
    curves : dict of str to Circle or LevelSet
        Of the sides and holes that are curved, by their names.

    Returns
    -------
    NamedMesh
        Its parts are those of the polygon: ``side-0``, ..., or as `domain` names them; ``hole-0``,
        ....

    Raises
    ------
    MeshError, FormulaError
        As `polygon.triangulate`; where a curve has no point near a side.
    """
    count = len(domain["corners"])
    names = domain.get("sides") or [f"side-{k}" for k in range(count)]
    outline, owners = _cut(domain["corners"], names, curves, size)
    holes = [
        _cut(hole, [f"hole-{k}"] * len(hole), curves, size)[0]
        for k, hole in enumerate(domain["holes"])
    ]
    mesh = triangulate(outline, holes, size)
    pieces = {}
    for k, owner in enumerate(owners):
        pieces.setdefault(names[owner], []).append(mesh.parts[f"side-{k}"])
    parts = {name: np.concatenate(ends, axis=1) for name, ends in pieces.items()}
    parts |= {f"hole-{k}": mesh.parts[f"hole-{k}"] for k in range(len(holes))}
    return replace(mesh, parts=parts)


def _cut(loop, names, curves, size):
    """A closed outline whose curved sides are cut into chords.

    Parameters
    ----------
    loop : sequence of pairs of float
    names : sequence of str
        Of its sides.
    curves, size
        See `triangulate_curved`.

    Returns
    -------
    corners : list of [x, y]
    owners : list of int
        The side of `loop` that each side of the new outline is of.
    """
    corners, owners = [], []
    for k, name in enumerate(names):
        ends = np.array([loop[k], loop[(k + 1) % len(loop)]], dtype=float).T
        chords = _chords(ends, curves[name], name, size) if name in curves else ends
        corners += chords[:, :-1].T.tolist()
        owners += [k] * (chords.shape[1] - 1)
    return corners, owners


def _chords(ends, curve, name, size):
    """Points along a curve between two points, (2, k): chords are halved until none is longer."""
    points = ends
    while np.hypot(*np.diff(points, axis=1)).max() > size:
        if points.shape[1] > _MOST:
            raise MeshError(
                f"domain.boundary_shape.{name}: a side has more than {_MOST} edges as long as "
                f"{size:.3g}; start from a coarser level"
            )
        middles = nearest_on(curve, name, 0.5 * (points[:, :-1] + points[:, 1:]))
        merged = np.empty((2, 2 * points.shape[1] - 1))
        merged[:, ::2], merged[:, 1::2] = points, middles
        points = merged
    return points
