"""The contact edges of a mesh against an exact solution, and what they contribute to the error.

Equations (3.2), (3.3) and (4.10) of the paper. With an obstacle alpha, u and u_h stand for u -
alpha and u_h - alpha in the terms on edges that meet both parts.
"""

from dataclasses import dataclass

import numpy as np

from signorini.fem.elements import find_element
from signorini.mesh.boundary_trace import find_boundary_trace
from signorini.studies.theory.exact_parts import edge_integrals

_SAMPLES = 33  # on each edge, ends included, at which u and the obstacle are compared
_TOUCHING = 1e-13  # share of the size of u below which u touches the obstacle


@dataclass(frozen=True)
class ContactTerms:
    """Sums over the contact edges F of a mesh; du/dnu is that of the exact solution.

    Attributes
    ----------
    binding, free, mixed : int
        How many edges lie where u binds (Gamma^0), where it does not (Gamma^+), and in both
        (Gamma^-).
    D1 : float
        Sum of int_F du/dnu (Pi u - u_h) over the binding ones.
    D2 : float
        Sum of int_F du/dnu Pi u over the mixed ones.
    A : float
        Sum of -int_F du/dnu u_h over the mixed ones: the left side of Lemmas 3.3 and 3.4.
    """

    binding: int
    free: int
    mixed: int
    D1: float
    D2: float
    A: float

    @property
    def total(self):
        """Sum of int_F du/dnu (Pi u - u_h) over all contact edges, as in Lemma 4.1."""
        return self.D1 + self.D2 + self.A


def contact_terms(exact, obstacle, mesh, u_h, interpolant):
    """The terms of equation (4.10).

    Parameters
    ----------
    exact : ExactSolution
    obstacle : callable
        alpha at points x, y.
    mesh : Grid or Triangulation
    u_h, interpolant : ndarray, shape (number_of_facets,)
        The CR solution and Pi u, by their values at midpoints.

    Returns
    -------
    ContactTerms
    """
    trace = find_boundary_trace(mesh, "contact")
    binds = _binding(exact, obstacle, trace)
    everywhere, somewhere = binds.all(axis=1), binds.any(axis=1)
    mixed = somewhere & ~everywhere
    of_u_h = _flux_moments(exact, trace, _on_edges(mesh, trace, u_h))
    of_interpolant = _flux_moments(exact, trace, _on_edges(mesh, trace, interpolant))
    of_obstacle = edge_integrals(
        lambda x, y, s, which: _flux(exact, trace, x, y, which) * obstacle(x, y),
        trace.ends,
        exact.singular_points,
    )
    return ContactTerms(
        binding=int(everywhere.sum()),
        free=int((~somewhere).sum()),
        mixed=int(mixed.sum()),
        D1=float((of_interpolant - of_u_h)[everywhere].sum()),
        D2=float((of_interpolant - of_obstacle)[mixed].sum()),
        A=float((of_obstacle - of_u_h)[mixed].sum()),
    )


def _binding(exact, obstacle, trace):
    """Whether u touches its obstacle at points of each edge, shape (m, _SAMPLES)."""
    x, y = trace.points(np.linspace(0.0, 1.0, _SAMPLES))
    u = exact.value(x, y)
    return u - obstacle(x, y) <= _TOUCHING * max(np.abs(u).max(), 1e-300)


def _on_edges(mesh, trace, values):
    """Values of a CR function at both ends of each edge, from inside; shape (2, m)."""
    corners = find_element("CR").vertex_values(mesh, values)
    return corners[trace.local, trace.triangles]


def _flux_moments(exact, trace, at_ends):
    """Integrals of du/dnu times a function that is affine on each edge, shape (m,)."""

    def product(x, y, s, which):
        first, last = at_ends[:, which, None]
        return _flux(exact, trace, x, y, which) * (first + s * (last - first))

    return edge_integrals(product, trace.ends, exact.singular_points)


def _flux(exact, trace, x, y, which):
    return exact.flux(x, y, *trace.normal[:, which, None])
