"""What happens on the contact part: the trace of u, the contact force, and the critical points
where u starts to bind.

The part may have several components, and each may turn corners; they are walked as `mesh.paths`
says, and the arc length runs on from one to the next.
"""

from dataclasses import dataclass

import numpy as np

from signorini.fem.elements import element as find_element
from signorini.mesh.paths import boundary_paths


@dataclass(frozen=True, eq=False)
class ContactLine:
    """The contact dofs of a solution in the order of the line.

    Parameters
    ----------
    which : ndarray of int, shape (m,)
        Positions in ``solution.contact``. A vertex where three or more facets of the part meet
        comes once for each path that ends there.
    component : ndarray of int, shape (m,)
        Counted from 1.
    s : ndarray, shape (m,)
        Arc length, unit of length.
    points : ndarray, shape (2, m)
    critical : ndarray, shape (m,)
        Arc length of the critical point between a dof and the next of its component; NaN where
        there is none.
    critical_points : ndarray, shape (2, c)
    """

    which: np.ndarray
    component: np.ndarray
    s: np.ndarray
    points: np.ndarray
    critical: np.ndarray
    critical_points: np.ndarray


_NOTHING = (
    np.zeros(0, int),
    np.zeros(0, int),
    np.zeros(0),
    np.zeros((2, 0)),
    np.zeros(0),
    np.zeros((2, 0)),
)

# The degrees of freedom on a path, and the first of the marks that they sit on, every second one.
_PLACES = {"P1": ("vertices", 0), "CR": ("facets", 1)}

# The degrees of freedom that hold on the first and on the second half of each facet of a path.
_HALVES = {
    "P1": lambda path: (path.vertices[:-1], path.vertices[1:]),
    "CR": lambda path: (path.facets, path.facets),
}


def contact_line(mesh, solution):
    """The discrete contact line of a stored solution.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution

    Returns
    -------
    dict
        ``contact_x`` (nc,), unit of length: on a single side parallel to an axis the coordinate
        along it, on any other contact part the arc length; ``contact_u`` and ``contact_obstacle``
        (nc,); ``critical_points`` (k, 2), between neighbouring nodes of which one binds: known to
        half a mesh width.
    """
    line = _ordered(mesh, solution.element, solution.contact, solution.active)
    return {
        "contact_x": _position(line),
        "contact_u": solution.u[solution.contact][line.which],
        "contact_obstacle": solution.lower[line.which],
        "critical_points": line.critical_points.T,
    }


def _position(line):
    width, height = np.ptp(line.points, axis=1) if line.s.size else (0.0, 0.0)
    if min(width, height) > 0.0 or np.any(line.component != 1):
        return line.s
    return line.points[int(height > width)]


def contact_rows(mesh, solution):
    """The contact line as a table.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution

    Returns
    -------
    list of dict
        A row for each contact dof in the order of the line: ``element``, ``n``; ``component``,
        counted from 1; arc length ``s``, ``x`` and ``y``, unit of length; ``u`` and ``obstacle``;
        ``flux``, see `contact_flux`; ``binding``, 1 or 0; ``critical``, the arc length of the
        critical point between this row and the next of its component (in a closed one the first
        follows the last), or None. Empty without contact part.
    """
    line = _ordered(mesh, solution.element, solution.contact, solution.active)
    flux = contact_flux(mesh, solution.element, solution.contact, solution.multiplier)
    columns = {
        "component": line.component,
        "s": line.s,
        "x": line.points[0],
        "y": line.points[1],
        "u": solution.u[solution.contact][line.which],
        "obstacle": solution.lower[line.which],
        "flux": flux[line.which],
        "binding": solution.active[line.which].astype(int),
        "critical": np.where(np.isnan(line.critical), None, line.critical),
    }
    level = {"element": solution.element, "n": solution.n}
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    return [level | dict(zip(columns, row, strict=True)) for row in rows]


def contact_flux(mesh, element, contact, multiplier):
    """Density of the contact force, k du/dnu, at each contact dof.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"}
    contact : ndarray of int, shape (nc,)
        Contact dofs.
    multiplier : ndarray, shape (nc,)
        Force on each.

    Returns
    -------
    ndarray, shape (nc,)
        The force over the length on which the dof holds: for CR its facet, for P1 the adjacent
        halves of the contact facets that meet there. Unit of k u per length.
    """
    length = np.zeros(find_element(element).size(mesh))
    for path in boundary_paths(mesh, "contact"):
        for dofs in _HALVES[element](path):
            np.add.at(length, dofs, 0.5 * path.lengths)
    return multiplier / length[contact]


def binding_pieces(mesh, solution):
    """The pieces of contact facets on which the constraint binds.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution

    Returns
    -------
    ndarray, shape (m, 2, 2)
        Start (x, y) and end (x, y) of each piece in the order of the line: whole facets, and the
        halves of those whose two dofs differ. A dof under a Dirichlet condition leaves its half to
        the other.
    """
    state = np.full(find_element(solution.element).size(mesh), np.nan)
    state[solution.contact] = solution.active
    pieces = [np.zeros((0, 2, 2))]
    for path in boundary_paths(mesh, "contact"):
        first, second = (state[dofs] for dofs in _HALVES[solution.element](path))
        first, second = (
            np.where(np.isnan(first), second, first) == 1,
            np.where(np.isnan(second), first, second) == 1,
        )
        marks = path.marks
        start = np.where(first, marks[:, :-1:2], marks[:, 1::2])
        end = np.where(second, marks[:, 2::2], marks[:, 1::2])
        pieces.append(np.stack([start, end]).transpose(2, 0, 1)[first | second])
    return np.concatenate(pieces)


def critical_points(mesh, element, contact, active):
    """The critical points of a solution, where of two neighbouring contact dofs one binds: midway,
    shape (2, k).

    `contact` are the contact dofs of the `element`, `active` says which of them bind.
    """
    return _ordered(mesh, element, contact, active).critical_points


def _ordered(mesh, element, contact, active):
    """The `ContactLine` of a solution, by its contact dofs and which of them bind."""
    position = np.full(find_element(element).size(mesh), -1)
    position[contact] = np.arange(contact.size)
    start, parts = 0.0, [_NOTHING]
    for component, path in enumerate(boundary_paths(mesh, "contact"), start=1):
        parts.append(_ordered_path(path, element, active, position, component, start))
        start += path.arc_length[-1]
    return ContactLine(*(np.concatenate(arrays, axis=-1) for arrays in zip(*parts, strict=True)))


def _ordered_path(path, element, active, position, component, start):
    """The fields of a `ContactLine` for the dofs of one path, which starts at arc length `start`."""
    kind, first = _PLACES[element]
    s, marks = start + path.arc_length, path.marks
    at = np.arange(first, s.size - path.closed, 2)
    which = position[getattr(path, kind)[at // 2]]
    known = which >= 0
    binds = np.append(active, False)[which]
    turns = known & np.roll(known, -1) & (binds != np.roll(binds, -1))
    turns[-1] &= path.closed
    between = at[turns] + 1
    critical = np.full(at.size, np.nan)
    critical[turns] = s[between]
    at = at[known]
    return (
        which[known],
        np.full(at.size, component),
        s[at],
        marks[:, at],
        critical[known],
        marks[:, between],
    )


def sampled_surface(grid, u, cells):
    """A P1 function at every k-th vertex of a grid, k the smallest that leaves at most `cells`
    cells a side.

    Returns
    -------
    dict
        ``x`` (mx,), ``y`` (my,), unit of length, and ``u`` (my, mx).
    """
    stride_x, stride_y = (_stride(count, cells) for count in (grid.nx, grid.ny))
    values = u.reshape(grid.ny + 1, grid.nx + 1)
    return {"x": grid.x[::stride_x], "y": grid.y[::stride_y], "u": values[::stride_y, ::stride_x]}


def _stride(count, cells):
    return next(k for k in range(1, count + 1) if count % k == 0 and count // k <= cells)
