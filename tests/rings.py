"""Bodies with a hole, and solutions on them that are made up, for what is seen along the contact
line.
"""

from types import SimpleNamespace

import numpy as np
from skfem import MeshTri

from signorini.fem.elements import find_element
from signorini.mesh.triangulation import Triangulation

HELD = (
    "contact",
    "contact",
    "dirichlet",
    "contact",
)  # one part with two corners that ends at a Dirichlet side


def ring(labels=("contact", "dirichlet")):
    """A square with a square hole: `labels` of the inner and of the outer boundary."""
    mesh = MeshTri.init_tensor(np.linspace(0, 1, 7), np.linspace(0, 1, 7))
    centre = mesh.p[:, mesh.t].mean(axis=1)
    mesh = mesh.restrict(np.flatnonzero(np.abs(centre - 0.5).max(axis=0) > 1 / 6))
    facets = mesh.boundary_facets()
    inner = np.abs(mesh.p[:, mesh.facets[:, facets]].mean(axis=1) - 0.5).max(axis=0) < 0.4
    label = np.where(inner, *labels)
    return Triangulation.from_skfem(
        mesh.with_boundaries({name: facets[label == name] for name in set(labels)})
    )


def solution(mesh, element, binds=lambda x, y: x + y > 0.7, u=lambda x, y: 1 + x - y * y):
    """A stored solution that binds where it is told to, with a force of its own on each contact
    dof.
    """
    kind = find_element(element)
    fixed = kind.boundary_dofs(mesh, "dirichlet")
    contact = np.setdiff1d(kind.boundary_dofs(mesh, "contact"), fixed)
    x, y = kind.nodes(mesh, contact)
    active = np.broadcast_to(binds(x, y), contact.shape)
    values = u(*kind.nodes(mesh, np.arange(kind.size(mesh))))
    force = np.where(active, 1 + x + 2 * y, 0)
    return SimpleNamespace(
        element=element,
        n=8,
        h=0.125,
        u=values,
        contact=contact,
        active=active,
        lower=0.1 * x,
        force=force,
        threshold=None,
    )
