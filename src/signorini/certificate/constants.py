"""Constants of inequalities, each an upper bound; docs/certificate.md proves them."""

import numpy as np

from signorini.exceptions import SceneError
from signorini.fem.elements import find_element
from signorini.fem.stiffness import assemble_stiffness
from signorini.mesh.grid import Grid

# Below the first zero of J_1, 3.83170597: |w - mean of w|_T <= h_T / j |grad w|_T on every triangle
# (Laugesen and Siudeja, J. Differential Equations 249 (2010), 118-135).
FIRST_ZERO = 3.8317
# |w - w_CR|_T <= kappa h_T |grad (w - w_CR)|_T, with w_CR the CR interpolant: w - w_CR has mean
# zero on every facet (Carstensen and Gedicke, Math. Comp. 83 (2014), 2605-2629).
INTERPOLATION = (1.0 / 48.0 + FIRST_ZERO**-2) ** 0.5
_CELLS = 24  # of a grid, along its longer side, on which the eigenvalue is computed
_FEWEST, _MOST = 2**10, 2**12  # triangles of any other mesh, refined or coarsened if it can be
_DIGITS = 1e-6  # relative, far more than what the eigenvalue's residual is


def friedrichs_constant(mesh):
    """C with |w| <= C |grad w| for all w that vanish on the Dirichlet part, unit of length.

    Without a Dirichlet part it is for all w of mean zero.

    Parameters
    ----------
    mesh : Grid or Triangulation

    Returns
    -------
    float

    Raises
    ------
    SceneError
        If there is none: a part of the body hangs together with no Dirichlet facet.

    Notes
    -----
    1 / C^2 is the first eigenvalue of the Laplacian, which is at least
    lambda / (1 + kappa^2 h^2 lambda) for the eigenvalue lambda of CR on any mesh of the domain, h
    its longest edge.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> 2 / np.pi < friedrichs_constant(grid) < 1.001 * 2 / np.pi
    True
    """
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import eigsh

    mesh = _moderate(mesh)
    element, areas = find_element("CR"), np.broadcast_to(mesh.area, mesh.number_of_triangles)
    free = np.setdiff1d(np.arange(mesh.number_of_facets), element.boundary_dofs(mesh, "dirichlet"))
    facets = element.triangle_dofs(mesh).ravel()
    mass = np.bincount(facets, np.tile(areas / 3.0, 3))[free]
    root = diags_array(mass**-0.5)
    A = root @ assemble_stiffness(mesh, element)[free][:, free] @ root
    held = free.size < mesh.number_of_facets
    length = _longest(mesh)
    shift = 0.0 if held else -1.0 / areas.sum()
    start = np.sqrt(mass)
    count = 1 if held else 2
    try:
        values = eigsh(A.tocsc(), count, sigma=shift, v0=start, return_eigenvectors=False)
    except RuntimeError:  # a singular factor: a rigid part
        values = np.zeros(1)
    eigenvalue = float(np.max(values)) * (1.0 - _DIGITS)
    if not eigenvalue * areas.sum() > _DIGITS:
        raise SceneError(
            "certificate: a part of the body is held by no dirichlet part, so that no constant "
            "bounds what it moves; hold it, or certify it alone"
        )
    return (1.0 / eigenvalue + (INTERPOLATION * length) ** 2) ** 0.5


def _moderate(mesh):
    """A mesh of the same domain with the same labels, neither coarse nor large."""
    if isinstance(mesh, Grid):
        longer = max(mesh.nx, mesh.ny)
        nx, ny = (max(1, round(count * _CELLS / longer)) for count in (mesh.nx, mesh.ny))
        return Grid(nx, ny, mesh.origin, mesh.size, mesh.diagonal, mesh.labels)
    while mesh.number_of_triangles > _MOST and mesh.coarser() is not None:
        mesh = mesh.coarser()
    while mesh.number_of_triangles < _FEWEST:
        mesh = mesh.refined()
    return mesh


def _longest(mesh):
    """The longest edge of a mesh."""
    edges = mesh.edge_vectors(slice(0, mesh.number_of_triangles))
    return float(np.sqrt((edges**2).sum(axis=1)).max())
