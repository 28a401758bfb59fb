"""What happens on the contact part: trace, contact force and critical points.

At a critical point u starts to bind. The part may have several components, and each may turn
corners; they are walked as `mesh.paths` says, and the arc length runs on from one to the next.
"""

from dataclasses import dataclass, fields
from math import isclose

import numpy as np

from signorini.fem.elements import find_element
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


_NOTHING = ContactLine(
    which=np.zeros(0, int),
    component=np.zeros(0, int),
    s=np.zeros(0),
    points=np.zeros((2, 0)),
    critical=np.zeros(0),
    critical_points=np.zeros((2, 0)),
)


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
    line = _ordered(mesh, find_element(solution.element), solution.contact, solution.active)
    return {
        "contact_x": _position(line),
        "contact_u": solution.u[solution.contact][line.which],
        "contact_obstacle": solution.lower[line.which],
        "critical_points": line.critical_points.T,
    }


def _position(line):
    width, height = np.ptp(line.points, axis=1) if line.s.size else (0.0, 0.0)
    on_an_axis = min(width, height) == 0.0
    if not on_an_axis or np.any(line.component != 1):
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
        A row for each contact dof in the order of the line: ``element``, ``n``; the mesh width
        ``h`` where it is not 1/n; ``component``, counted from 1; arc length ``s``, ``x`` and ``y``,
        unit of length; ``u`` and ``obstacle``; ``flux``, see `contact_flux`; ``threshold``, what
        flux is held against, where that is not 0; ``binding``, 1 or 0; ``critical``, the arc length
        of the critical point between this row and the next of its component (in a closed one the
        first follows the last), or None; ``resultant``, the whole contact force, unit of k u, the
        same in each row. Empty without contact part.
    """
    element = find_element(solution.element)
    line = _ordered(mesh, element, solution.contact, solution.active)
    flux = contact_flux(mesh, element, solution.contact, solution.force)
    threshold = {}
    if solution.threshold is not None:
        density = contact_flux(mesh, element, solution.contact, solution.threshold)
        threshold = {"threshold": density[line.which]}
    columns = {
        "component": line.component,
        "s": line.s,
        "x": line.points[0],
        "y": line.points[1],
        "u": solution.u[solution.contact][line.which],
        "obstacle": solution.lower[line.which],
        "flux": flux[line.which],
        **threshold,
        "binding": solution.active[line.which].astype(int),
        "critical": np.where(np.isnan(line.critical), None, line.critical),
        "resultant": np.full(line.s.size, solution.force.sum()),
    }
    width = {} if isclose(solution.n * solution.h, 1.0) else {"h": solution.h}
    level = {"element": solution.element, "n": solution.n} | width
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    return [level | dict(zip(columns, row, strict=True)) for row in rows]


def contact_flux(mesh, element, contact, force):
    """Density of the contact force, k du/dnu, at each contact dof.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    contact : ndarray of int, shape (nc,)
        Contact dofs.
    force : ndarray, shape (nc,)
        Force on each: `Solution.force`.

    Returns
    -------
    ndarray, shape (nc,)
        The force over the length on which the dof holds: for CR its facet, for P1 the adjacent
        halves of the contact facets that meet there. Unit of k u per length.
    """
    element = find_element(element)
    length = np.zeros(element.size(mesh))
    for path in boundary_paths(mesh, "contact"):
        for dofs in element.half_facet_dofs(path):
            np.add.at(length, dofs, 0.5 * path.lengths)
    return force / length[contact]


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
    element = find_element(solution.element)
    state = np.full(element.size(mesh), np.nan)  # stays NaN under a Dirichlet condition
    state[solution.contact] = solution.active
    pieces = [np.zeros((0, 2, 2))]
    for path in boundary_paths(mesh, "contact"):
        first, second = (state[dofs] for dofs in element.half_facet_dofs(path))
        first_binds = np.where(np.isnan(first), second, first) == 1
        second_binds = np.where(np.isnan(second), first, second) == 1
        pieces.append(_pieces_of(path, first_binds, second_binds))
    return np.concatenate(pieces)


def _pieces_of(path, first, second):
    """The binding pieces of one path, by whether the first and the second half of a facet bind."""
    begin, middle, end = path.marks[:, :-1:2], path.marks[:, 1::2], path.marks[:, 2::2]
    start = np.where(first, begin, middle)
    end = np.where(second, end, middle)
    return np.stack([start, end]).transpose(2, 0, 1)[first | second]


def critical_points(mesh, element, contact, active):
    """The critical points of a solution: midway between contact dofs of which one binds.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    contact : ndarray of int, shape (nc,)
        Contact dofs.
    active : ndarray of bool, shape (nc,)
        Which of them bind.

    Returns
    -------
    ndarray, shape (2, k)
        Unit of length.
    """
    return _ordered(mesh, find_element(element), contact, active).critical_points


def critical_places(mesh, solution):
    """The critical points of a solution with their arc lengths, in the order of the line.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The solution's.
    solution : StoredSolution

    Returns
    -------
    ndarray, shape (3, k)
        Arc length, x and y; unit of length.
    """
    line = _ordered(mesh, find_element(solution.element), solution.contact, solution.active)
    arc = line.critical[~np.isnan(line.critical)]
    return np.concatenate([arc[None], line.critical_points])


def _ordered(mesh, element, contact, active):
    """The `ContactLine` of a solution, by its contact dofs and which of them bind."""
    position = np.full(element.size(mesh), -1)
    position[contact] = np.arange(contact.size)
    start, lines = 0.0, [_NOTHING]
    for component, path in enumerate(boundary_paths(mesh, "contact"), start=1):
        lines.append(_ordered_path(path, element, active, position, component, start))
        start += path.arc_length[-1]
    return ContactLine(
        *(
            np.concatenate([getattr(line, field.name) for line in lines], axis=-1)
            for field in fields(ContactLine)
        )
    )


def _ordered_path(path, element, active, position, component, start):
    """The `ContactLine` of one path, which starts at arc length `start`.

    Marks are the vertices and midpoints of the path by turns; dofs sit on every second one, and
    critical points on those between::

        P1   dof  .  dof  .  dof        CR   .  dof  .  dof  .
              0   1   2   3   4              0   1   2   3   4
    """
    dofs, first = element.path_dofs(path)
    s, marks = start + path.arc_length, path.marks
    at = np.arange(first, s.size - path.closed, 2)
    which = position[dofs[at // 2]]
    known = which >= 0
    binds = np.append(active, False)[which]  # dofs off the contact part, -1, do not bind
    turns = known & np.roll(known, -1) & (binds != np.roll(binds, -1))
    turns[-1] &= path.closed
    between = at[turns] + 1
    critical = np.full(at.size, np.nan)
    critical[turns] = s[between]
    at = at[known]
    return ContactLine(
        which=which[known],
        component=np.full(at.size, component),
        s=s[at],
        points=marks[:, at],
        critical=critical[known],
        critical_points=marks[:, between],
    )


def sampled_surface(grid, u, cells):
    """A P1 function at every k-th vertex of a grid.

    Parameters
    ----------
    grid : Grid
    u : ndarray, shape (number_of_vertices,)
    cells : int
        The most cells a side that are left; k is the smallest that leaves no more.

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
