"""Where on a mesh an error of the gradient is: its root mean square on each triangle."""

import numpy as np

from signorini.chunks import chunk_slices
from signorini.errors.graded import graded, times_to_cut
from signorini.errors.pieces import CHUNK, FEWEST_TRIANGLES, RADON
from signorini.exceptions import MeshError
from signorini.fem.elements import find_element


def gradient_errors(mesh, element, u, exact):
    """The root mean square of grad (u - u_h) on each triangle, for an exact solution u.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"} or Element
    u : ndarray, shape (ndof,)
        The discrete solution.
    exact : ExactSolution

    Returns
    -------
    ndarray, shape (nt,)
        Unit of u per length. Its squares times the areas add up to the square of the H1 seminorm,
        by the quadrature of `errors.exact`.

    Raises
    ------
    FormulaError
        Where the gradient of the exact solution is not finite.

    Examples
    --------
    >>> from signorini.exact import family
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> errors = gradient_errors(grid, "P1", 3.0 - 3.0 * grid.p[1], family("patch"))
    >>> errors.round(12).tolist()
    [2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0]
    """
    slopes = mesh.gradients(find_element(element).vertex_values(mesh, u))
    p, t = mesh.p, mesh.t
    least = times_to_cut(t.shape[1], FEWEST_TRIANGLES, corners=3)
    squares = np.zeros(t.shape[1])
    for piece in chunk_slices(t.shape[1], CHUNK):
        corners = p[:, t[:, piece]]
        squares[piece] = _mean_squares(corners, slopes[:, piece], exact, least)
    return np.sqrt(squares)


def _mean_squares(corners, slopes, exact, least):
    """Of the difference of gradients on each of some triangles, (2, 3, m)."""
    squares = np.zeros(corners.shape[2])
    for cells, points, shares, weights in graded(corners, exact.singular_points, RADON, least):
        x, y = np.einsum("dkm,kmq->dmq", corners[:, :, cells], _for_each(points, cells))
        pairs = zip(exact.gradient(x, y), slopes[:, cells, None], strict=True)
        density = sum((there - here) ** 2 for there, here in pairs)
        means = (density * weights).sum(axis=1)
        np.add.at(squares, cells, shares * means)
    return squares


def _for_each(points, cells):
    """Barycentric points of every cell, where one set may serve all."""
    return np.broadcast_to(points, (3, cells.size, points.shape[2]))


def gradient_errors_by_reference(mesh, element, u, finer, reference):
    """The same for a reference on a mesh that was refined from this one, integrated exactly.

    Parameters
    ----------
    mesh, element, u
        As in `gradient_errors`.
    finer : Grid or Triangulation
        The reference's mesh.
    reference : StoredSolution

    Returns
    -------
    ndarray, shape (nt,)
        Unit of u per length.

    Raises
    ------
    MeshError
        If `finer` is not a refinement of `mesh`.

    Examples
    --------
    A reference on the same mesh leaves nothing:

    >>> from signorini import load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/paper.yaml")
    >>> solution = solve_level(scene, "CR", 4)
    >>> mesh = scene.problem_statement.triangulations.level(4)
    >>> errors = gradient_errors_by_reference(mesh, "CR", solution.u, mesh, solution)
    >>> float(errors.max())
    0.0
    """
    kind = find_element(reference.element)
    mean = finer.gradients(kind.vertex_values(finer, reference.u))
    variance = np.zeros(mean.shape[1])
    while not finer.same_as(mesh):
        coarser = finer.coarser()
        if coarser is None:
            raise MeshError("mesh: the reference's is no refinement of it; give that of its scene")
        mean, variance = _coarsened(finer, mean, variance)
        finer = coarser
    slopes = mesh.gradients(find_element(element).vertex_values(mesh, u))
    return np.sqrt(variance + ((mean - slopes) ** 2).sum(axis=0))


def _coarsened(mesh, mean, variance):
    """Mean and variance over the four children, of equal area, of every triangle."""
    family, own = mesh.children(mean), mesh.children(variance[None])
    coarse = family.mean(axis=0)
    between = ((family - coarse) ** 2).sum(axis=1).mean(axis=0)
    return coarse, own.mean(axis=0)[0] + between
