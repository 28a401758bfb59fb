"""How flat the triangles of a mesh are."""

import numpy as np

from signorini.mesh.geometry import cross


def minimum_angle(mesh):
    """Smallest angle of any triangle, degrees."""
    corners = [mesh.p[:, v] for v in mesh.t]
    smallest = np.inf
    for k in range(3):
        u, v = corners[k - 2] - corners[k], corners[k - 1] - corners[k]
        scale = np.abs([u, v]).max()
        u, v = u / scale, v / scale
        angle = np.arctan2(np.abs(cross(u, v)), (u * v).sum(axis=0))
        smallest = min(smallest, float(angle.min()))
    return np.degrees(smallest)
