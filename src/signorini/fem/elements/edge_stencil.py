"""The stencil of CR: differences between the edges of a cell and its diagonal edge."""

import numpy as np

from signorini.fem.elements.grid_stencil import GridStencil, couplings, halved_ends


class _EdgeStencil(GridStencil):
    def add_product(self, grid, u, result, first, last):
        kx, ky = couplings(grid)
        u_h, u_v, u_d = grid.split_edges(u, first, last)
        h, v, d = np.zeros_like(u_h), np.zeros_like(u_v), np.zeros_like(u_d)
        # The four edges of each cell: below and above the diagonal one, left and right of it.
        for k, values, into in (
            (ky, u_h[:-1], h[:-1]),
            (ky, u_h[1:], h[1:]),
            (kx, u_v[:, :-1], v[:, :-1]),
            (kx, u_v[:, 1:], v[:, 1:]),
        ):
            flux = 2.0 * k * (values - u_d)
            into += flux
            d -= flux
        grid.add_edges(result, first, h, v, d)

    def diagonal(self, grid):
        kx, ky = couplings(grid)
        result = np.zeros(grid.number_of_facets)
        for first, last in grid.row_chunks():
            rows = last - first
            h = np.full((rows + 1, grid.nx), 4.0 * ky)
            h[[0, -1]] *= 0.5
            v = np.tile(4.0 * kx * halved_ends(grid.nx + 1), (rows, 1))
            d = np.full((rows, grid.nx), 4.0 * (kx + ky))
            grid.add_edges(result, first, h, v, d)
        return result

    def contact_fluxes(self, grid, u, contact):
        """An edge along an axis couples with the diagonal edge of its triangle alone.

        In `t2f` the diagonal edge is the second of the three.
        """
        kx, ky = couplings(grid)
        behind = grid.triangles_at("contact").t2f
        weights = (ky, kx) if grid.diagonal == "falling" else (kx, ky)
        force, sizes = np.zeros((2, contact.size))
        for leg, k in zip((0, 2), weights, strict=True):
            place = np.minimum(np.searchsorted(contact, behind[leg]), contact.size - 1)
            held = contact[place] == behind[leg]
            own, other = u[behind[leg][held]], u[behind[1][held]]
            force[place[held]] = 2.0 * k * (own - other)
            sizes[place[held]] = 2.0 * k * (np.abs(own) + np.abs(other))
        return force, np.abs(force), sizes


EDGE_STENCIL = _EdgeStencil()
