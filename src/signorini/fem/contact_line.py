"""What happens on the contact part: trace, contact force, critical points; see `contact_walk`."""

from math import isclose

import numpy as np

from signorini.fem.contact_walk import walk_contact
from signorini.fem.elements import find_element
from signorini.mesh.paths import boundary_paths


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

    Examples
    --------
    A punch of half width 0.6, to half a mesh width:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(32)
    >>> contact_line(mesh, solve_level(scene, "CR", 32))["critical_points"].tolist()
    [[-0.625, 0.0], [0.625, 0.0]]
    """
    line = walk_contact(mesh, find_element(solution.element), solution.contact, solution.active)
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

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> rows = contact_rows(mesh, solve_level(scene, "CR", 4))
    >>> [(row["s"], row["binding"]) for row in rows]
    [(0.125, 0), (0.375, 0), (0.625, 1), (0.875, 1)]
    """
    element = find_element(solution.element)
    line = walk_contact(mesh, element, solution.contact, solution.active)
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

    Examples
    --------
    A force of h on each facet is a density of one; P1 has half a facet at each end:

    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> contact_flux(grid, "P1", np.arange(5), np.full(5, 0.25))
    array([2., 1., 1., 1., 2.])
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

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> binding_pieces(mesh, solve_level(scene, "CR", 4))[:, :, 0]
    array([[0.5 , 0.75],
           [0.75, 1.  ]])
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

    Examples
    --------
    Between the second and the third midpoint:

    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> facets = find_element("CR").boundary_dofs(grid, "contact")
    >>> critical_points(grid, "CR", facets, np.array([True, True, False, False])).ravel()
    array([0.5, 0. ])
    """
    return walk_contact(mesh, find_element(element), contact, active).critical_points


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

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> mesh = scene.problem_statement.triangulations.level(32)
    >>> critical_places(mesh, solve_level(scene, "CR", 32))[1].tolist()
    [-0.625, 0.625]
    """
    line = walk_contact(mesh, find_element(solution.element), solution.contact, solution.active)
    arc = line.critical[~np.isnan(line.critical)]
    return np.concatenate([arc[None], line.critical_points])


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

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> sampled_surface(grid, grid.p[0] * grid.p[1], cells=2)["u"]
    array([[0.  , 0.  , 0.  ],
           [0.  , 0.25, 0.5 ],
           [0.  , 0.5 , 1.  ]])
    """
    stride_x, stride_y = (_stride(count, cells) for count in (grid.nx, grid.ny))
    values = u.reshape(grid.ny + 1, grid.nx + 1)
    return {"x": grid.x[::stride_x], "y": grid.y[::stride_y], "u": values[::stride_y, ::stride_x]}


def _stride(count, cells):
    return next(k for k in range(1, count + 1) if count % k == 0 and count // k <= cells)
