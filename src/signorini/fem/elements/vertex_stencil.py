"""The stencil of P1: differences between neighbouring vertices of a grid."""

import numpy as np

from signorini.fem.elements.grid_stencil import GridStencil, couplings, halved_ends


class _VertexStencil(GridStencil):
    def add_product(self, grid, u, result, first, last):
        kx, ky = couplings(grid)
        shape, rows = (grid.ny + 1, grid.nx + 1), slice(first, last + 1)
        u, result = u.reshape(shape)[rows], result.reshape(shape)[rows]
        # An edge has a cell on either side, and each gives half of its coupling. The edges along
        # the rim of the block have one cell in it; the next block, if any, gives the rest.
        along_x = kx * np.diff(u, axis=1)
        along_x[[0, -1]] *= 0.5
        result[:, 1:] += along_x
        result[:, :-1] -= along_x
        along_y = ky * np.diff(u, axis=0)
        along_y[:, [0, -1]] *= 0.5
        result[1:] += along_y
        result[:-1] -= along_y

    def diagonal(self, grid):
        kx, ky = couplings(grid)
        across, along = halved_ends(grid.ny + 1), halved_ends(grid.nx + 1)
        return np.outer(2.0 * (kx + ky) * across, along).ravel()

    def contact_fluxes(self, grid, u, contact):
        kx, ky = couplings(grid)
        j, i = np.divmod(contact, grid.nx + 1)
        on_row, on_column = np.isin(j, (0, grid.ny)), np.isin(i, (0, grid.nx))
        along_x = kx * np.where(on_row, 0.5, 1.0)
        along_y = ky * np.where(on_column, 0.5, 1.0)
        force, fluxes, sizes = np.zeros((3, contact.size))
        for step, inside, k in (
            (-1, i > 0, along_x),
            (1, i < grid.nx, along_x),
            (-grid.nx - 1, j > 0, along_y),
            (grid.nx + 1, j < grid.ny, along_y),
        ):
            own, other = u[contact[inside]], u[contact[inside] + step]
            flux = k[inside] * (own - other)
            force[inside] += flux
            fluxes[inside] += np.abs(flux)
            sizes[inside] += k[inside] * (np.abs(own) + np.abs(other))
        return force, fluxes, sizes


VERTEX_STENCIL = _VertexStencil()
