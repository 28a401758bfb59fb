"""The stiffness matrix of a uniform grid applied without a matrix: differences along the axes.

On right triangles the coupling along the diagonal vanishes for P1, and CR couples each diagonal
edge with the four edges of its cell alone. With kx = hy/hx and ky = hx/hy the energies are, per
triangle, kx (du along x)^2 / 2 + ky (du along y)^2 / 2 over its legs, and for CR kx (v - d)^2 + ky
(h - d)^2 over its vertical, horizontal and diagonal edges v, h, d.
"""

import numpy as np


def apply_stiffness(grid, element, u):
    """A @ u for element ``"P1"`` or ``"CR"`` on a `Grid`; u and the result have shape (ndof,)."""
    hx, hy = grid.spacing
    result = np.zeros_like(u)
    for first, last in grid.row_chunks():
        _STENCILS[element](grid, hy / hx, hx / hy, u, result, first, last)
    return result


def diagonal(grid, element):
    """Diagonal of A, shape (ndof,), dimensionless."""
    hx, hy = grid.spacing
    return _DIAGONALS[element](grid, hy / hx, hx / hy)


def _add_p1(grid, kx, ky, u, result, first, last):
    shape, rows = (grid.ny + 1, grid.nx + 1), slice(first, last + 1)
    u, result = u.reshape(shape)[rows], result.reshape(shape)[rows]
    along_x = kx * np.diff(u, axis=1)
    along_x[[0, -1]] *= 0.5
    result[:, 1:] += along_x
    result[:, :-1] -= along_x
    along_y = ky * np.diff(u, axis=0)
    along_y[:, [0, -1]] *= 0.5
    result[1:] += along_y
    result[:-1] -= along_y


def _add_cr(grid, kx, ky, u, total, first, last):
    edges_h, edges_v, edges_d = grid.split_edges(u, first, last)
    h, v, d = np.zeros_like(edges_h), np.zeros_like(edges_v), np.zeros_like(edges_d)
    for k, values, result in (
        (ky, edges_h[:-1], h[:-1]),
        (ky, edges_h[1:], h[1:]),
        (kx, edges_v[:, :-1], v[:, :-1]),
        (kx, edges_v[:, 1:], v[:, 1:]),
    ):
        flux = 2.0 * k * (values - edges_d)
        result += flux
        d -= flux
    grid.add_edges(total, first, h, v, d)


def _diagonal_p1(grid, kx, ky):
    return np.outer(2.0 * (kx + ky) * _halved_ends(grid.ny + 1), _halved_ends(grid.nx + 1)).ravel()


def _diagonal_cr(grid, kx, ky):
    result = np.zeros(grid.number_of_facets)
    for first, last in grid.row_chunks():
        h = np.full((last - first + 1, grid.nx), 4.0 * ky)
        h[[0, -1]] *= 0.5
        v = np.tile(4.0 * kx * _halved_ends(grid.nx + 1), (last - first, 1))
        grid.add_edges(result, first, h, v, np.full((last - first, grid.nx), 4.0 * (kx + ky)))
    return result


def _halved_ends(size):
    weights = np.ones(size)
    weights[[0, -1]] = 0.5
    return weights


_STENCILS = {"P1": _add_p1, "CR": _add_cr}
_DIAGONALS = {"P1": _diagonal_p1, "CR": _diagonal_cr}


def contact_fluxes(grid, element, u, contact):
    """What flows into contact dofs, as `solvers.residual` sums it.

    Parameters
    ----------
    grid : Grid
    element : {"P1", "CR"}
    u : ndarray, shape (ndof,)
    contact : ndarray of int, shape (nc,)
        Dofs on the contact part, increasing.

    Returns
    -------
    force, fluxes, sizes : ndarray, shape (nc,)
        (A u) there, the sum of the sizes of its differences, and (|A| |u|) there; unit of u.
    """
    hx, hy = grid.spacing
    return _CONTACT[element](grid, hy / hx, hx / hy, u, contact)


def _contact_p1(grid, kx, ky, u, contact):
    j, i = np.divmod(contact, grid.nx + 1)
    on_row, on_column = np.isin(j, (0, grid.ny)), np.isin(i, (0, grid.nx))
    along, across = kx * np.where(on_row, 0.5, 1.0), ky * np.where(on_column, 0.5, 1.0)
    force, fluxes, sizes = np.zeros((3, contact.size))
    for step, inside, k in (
        (-1, i > 0, along),
        (1, i < grid.nx, along),
        (-grid.nx - 1, j > 0, across),
        (grid.nx + 1, j < grid.ny, across),
    ):
        own, other = u[contact[inside]], u[contact[inside] + step]
        flux = k[inside] * (own - other)
        force[inside] += flux
        fluxes[inside] += np.abs(flux)
        sizes[inside] += k[inside] * (np.abs(own) + np.abs(other))
    return force, fluxes, sizes


def _contact_cr(grid, kx, ky, u, contact):
    """An edge along an axis couples with the diagonal edge of its triangle alone, the second in
    `t2f`.
    """
    behind = grid.triangles_at("contact").t2f
    weights = (ky, kx) if grid.diagonal == "falling" else (kx, ky)
    force, sizes = np.zeros((2, contact.size))
    for leg, k in zip((0, 2), weights, strict=True):
        at = np.minimum(np.searchsorted(contact, behind[leg]), contact.size - 1)
        found = contact[at] == behind[leg]
        own, other = u[behind[leg][found]], u[behind[1][found]]
        force[at[found]] = 2.0 * k * (own - other)
        sizes[at[found]] = 2.0 * k * (np.abs(own) + np.abs(other))
    return force, np.abs(force), sizes


_CONTACT = {"P1": _contact_p1, "CR": _contact_cr}
