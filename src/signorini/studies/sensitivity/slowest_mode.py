"""The mode in which a slow iteration is last to converge."""

import numpy as np

from signorini.solvers import solve


def slowest_mode(problem):
    """First eigenfunction of the Laplacian, zero where u is given and where the constraint binds.

    Parameters
    ----------
    problem : Problem
        Of P1, with coefficient 1.

    Returns
    -------
    ndarray, shape (ndof,)
        Its largest value is 1.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> mode = slowest_mode(signorini.discretize(scene, "P1", 16))
    >>> float(mode.max()), bool(mode.min() >= 0.0)
    (1.0, True)
    """
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import eigsh

    held = problem.contact[solve(problem).active]
    free = np.setdiff1d(problem.free, held)
    masses = diags_array(_vertex_areas(problem.mesh)[free])
    start = np.ones(free.size)  # else eigsh starts at random
    _, vectors = eigsh(problem.A[free][:, free].tocsc(), k=1, M=masses, sigma=0.0, v0=start)
    mode = np.zeros(problem.b.size)
    mode[free] = vectors[:, 0]
    return mode / mode[np.abs(mode).argmax()]


def _vertex_areas(mesh):
    """A third of the triangles around each vertex."""
    areas = np.broadcast_to(mesh.area / 3.0, mesh.t.shape)
    return np.bincount(mesh.t.ravel(), areas.ravel(), minlength=mesh.number_of_vertices)
