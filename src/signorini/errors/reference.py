"""Errors against a reference on a finer, nested mesh, integrated exactly.

The reference is read once for all solutions. With Pi the L2 projection onto affine functions of a
coarser mesh, Pythagoras gives for every u_h on it

    |u - u_h|^2 = |u - Pi u|^2 + |Pi u - u_h|^2,

and |u - Pi u|^2 adds up over the meshes between. So one pass from the reference's mesh down to the
coarsest serves every solution of every level, at the cost of one evaluation; all terms are squares
of differences, so nothing cancels. The same holds for gradients with the mean over the children;
and where they are weighted with a coefficient that is constant on each triangle of the reference's
mesh, with the weighted mean and the mean of the weights.
"""

from functools import cached_property

import numpy as np

from signorini.errors.graded import scaled_weight
from signorini.errors.norms import ALWAYS_NAMED, check_in_domain
from signorini.errors.projection import project, prolong, squared_l2
from signorini.exceptions import MeshError
from signorini.fem.elements import find_element
from signorini.fem.quadrature import triangle_rule
from signorini.mesh.curved import curves_of


class ReferenceErrors:
    """Norms of u - u_h for a reference u.

    Parameters
    ----------
    mesh : Grid or Triangulation
        The reference's mesh.
    element : {"P1", "CR"} or Element
    u : ndarray, shape (ndof,)
    norms : sequence of str
        Of ``"l2"``, ``"h1_semi"``, ``"h1"``, ``"energy"``; what is not named is not computed.
    quadrature : str
        ``"exact"`` or the name of a rule applied on the reference's mesh.
    coefficient : ndarray, shape (nt,), optional
        Diffusion coefficient of each of its triangles, 1 where not given: the weight of the energy
        norm.

    Raises
    ------
    SceneError
        If a norm is unknown.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> fine = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> truth = ReferenceErrors(fine, "P1", fine.p[0] ** 2, ["l2", "h1"])
    >>> coarse = fine.coarser()
    >>> errors = truth.of(coarse, "P1", coarse.p[0] ** 2)
    >>> errors["l2"] < errors["h1"]
    True
    """

    def __init__(self, mesh, element, u, norms=ALWAYS_NAMED, quadrature="exact", coefficient=None):
        check_in_domain(norms)
        if curves_of(mesh):
            raise MeshError(
                "mesh: the levels of a curved side do not nest in a reference; use an exact truth"
            )
        self.mesh = mesh
        self.norms = tuple(norms)
        self.quadrature = quadrature
        # Powers of two near max |u|, of four near max k: squares do not under- or overflow, and no
        # digit changes.
        self.exponent = int(np.frexp(np.max(np.abs(u), initial=0.0))[1])
        self.weight, self.weight_exponent = None, 0
        if coefficient is not None:
            self.weight, self.weight_exponent = scaled_weight(coefficient)
        self.values = find_element(element).vertex_values(mesh, np.ldexp(u, -self.exponent))

    def of(self, mesh, element, u):
        """Norms of the error of a discrete solution.

        Parameters
        ----------
        mesh : Grid or Triangulation
            The reference's mesh or one that it was refined from, of equal numbering.
        element : {"P1", "CR"} or Element
        u : ndarray, shape (ndof,)

        Returns
        -------
        dict
            The value of each of `norms.ALWAYS_NAMED`, or None for those that no norm asked for
            needs (h1 needs the other two), and of ``"energy"`` if asked for. Units: l2 that of u
            times length, h1_semi that of u, energy that of u times the root of the coefficient's;
            h1 adds the squares of l2 and h1_semi as numbers.

        Raises
        ------
        MeshError
            If the reference's mesh is not a refinement of `mesh`.
        """
        values = find_element(element).vertex_values(mesh, np.ldexp(u, -self.exponent))
        squares = {}
        if {"l2", "h1"} & set(self.norms):
            squares["l2"] = self._squared_l2(mesh, values)
        if {"h1_semi", "h1"} & set(self.norms):
            squares["h1_semi"] = self._squared_semi(mesh, values)
        if "h1" in self.norms:
            squares["h1"] = squares["l2"] + squares["h1_semi"]
        if "energy" in self.norms:
            squares["energy"] = self._squared_energy(mesh, values)
        return {
            norm: self._root(norm, squares[norm]) if norm in squares else None
            for norm in dict.fromkeys((*ALWAYS_NAMED, *self.norms))
        }

    def unresolved(self, mesh, norms):
        """Norms of what no function that is affine on each triangle of a mesh has of the reference.

        It is a part of every error that `of` measures on this mesh, if integrated exactly.

        Parameters
        ----------
        mesh : Grid or Triangulation
            As in `of`.
        norms : sequence of str
            Of `norms.DOMAIN`.

        Returns
        -------
        dict
            Norm -> value, unit as in `of`.

        Examples
        --------
        No affine function comes nearer to a reference than its projection does:

        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> fine = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> truth, coarse = ReferenceErrors(fine, "P1", fine.p[0] ** 2, ["l2"]), fine.coarser()
        >>> least = truth.unresolved(coarse, ["l2"])["l2"]
        >>> 0.0 < least < truth.of(coarse, "P1", coarse.p[0] ** 2)["l2"]
        True
        """
        return {norm: self._root(norm, self._lost(norm, mesh)) for norm in norms}

    def _lost(self, norm, mesh):
        """The square of what projections down to `mesh` have lost of the reference."""
        if norm == "h1":
            return self._lost("l2", mesh) + self._lost("h1_semi", mesh)
        if norm == "l2":
            projections = self._affine
        elif norm == "energy" and self.weight is not None:
            projections = self._weighted
        else:
            projections = self._constant
        _, lost = self._at(projections, mesh)
        return lost

    def _root(self, norm, square):
        exponent = self.exponent + (self.weight_exponent if norm == "energy" else 0)
        return float(np.ldexp(np.sqrt(square), exponent))

    def _squared_l2(self, mesh, values):
        if self.quadrature != "exact":
            return self._squared_by_rule(mesh, values)
        projection, rest = self._at(self._affine, mesh)
        return rest + squared_l2(mesh.area, projection - values)

    def _squared_semi(self, mesh, values):
        mean, rest = self._at(self._constant, mesh)
        return rest + _squared_constant(mesh.area, mean - mesh.gradients(values))

    def _squared_energy(self, mesh, values):
        if self.weight is None:
            return self._squared_semi(mesh, values)
        projection, rest = self._at(self._weighted, mesh)
        mean, weight = projection[:2], projection[2]
        return rest + _squared_constant(mesh.area * weight, mean - mesh.gradients(values))

    def _at(self, projections, mesh):
        """The projection on one of the meshes, and the squared norm of what it has lost."""
        _, projection, lost = projections[len(self._finer_than(mesh))]
        return projection, lost

    def _finer_than(self, mesh):
        """The meshes from the reference's down to the one that was refined from `mesh`."""
        finer, level = [], self.mesh
        while not level.same_as(mesh):
            finer.append(level)
            level = level.coarser()
            if level is None:
                raise _do_not_nest(mesh, self.mesh)
        return finer

    @cached_property
    def _affine(self):
        """For each mesh, finest first: the mesh, the projection of u, and what it has lost.

        That is the square of the L2 norm of the difference.
        """
        return list(_descend(self.mesh, self.values, project))

    @cached_property
    def _constant(self):
        """The same for the gradient."""
        return list(_descend(self.mesh, self.mesh.gradients(self.values), _mean))

    @cached_property
    def _weighted(self):
        """The same for the gradient under the coefficient, which is the third row."""
        slopes_and_weight = np.stack([*self.mesh.gradients(self.values), self.weight])
        return list(_descend(self.mesh, slopes_and_weight, _weighted_mean))

    def _squared_by_rule(self, mesh, values):
        for finer in reversed(self._finer_than(mesh)):
            values = prolong(finer, values)
        points, weights = triangle_rule(self.quadrature)
        difference = self.values - values
        squares = (
            w * (point @ difference) ** 2 for point, w in zip(points.T, weights, strict=True)
        )
        return float(np.sum(self.mesh.area * sum(squares)))


def _descend(mesh, values, coarsen):
    """Yield each mesh down to the coarsest, the values on it, and what `coarsen` has lost."""
    lost = 0.0
    while mesh is not None:
        yield mesh, values, lost
        coarser = mesh.coarser()
        if coarser is not None:
            values, rest = coarsen(mesh, values)
            lost += rest
        mesh = coarser


def _mean(mesh, values):
    """Mean over the children of a piecewise constant field (2, nt).

    And the squared L2 norm of the difference.
    """
    family = mesh.children(values)
    mean = family.mean(axis=0)
    area = 0.25 * np.asarray(mesh.coarser().area)
    return mean, _total(_squared_constant(area, child - mean) for child in family)


def _weighted_mean(mesh, values):
    """The same for a field under a weight, which is its third row.

    Means are weighted, and the third row of the result is the mean of the weights.
    """
    family = mesh.children(values)
    slopes, weights = family[:, :2], family[:, 2:]
    mean = (weights * slopes).sum(axis=0) / weights.sum(axis=0)
    area = 0.25 * np.asarray(mesh.coarser().area)
    rest = _total(
        _squared_constant(area * w[0], child - mean)
        for child, w in zip(slopes, weights, strict=True)
    )
    return np.concatenate([mean, weights.mean(axis=0)]), rest


def _total(values):
    """Of a few floats, by NumPy: the built-in sum rounds otherwise from Python 3.12 on."""
    return float(np.sum(list(values)))


def _squared_constant(area, values):
    density = (values * values).sum(axis=0)
    return float(area @ density if np.ndim(area) else area * density.sum())


def _do_not_nest(mesh, reference):
    """The error of a mesh that a reference's was not refined from."""
    counts = mesh.number_of_triangles, reference.number_of_triangles
    remedy = "the reference's n must be a power of two times n"
    if counts[0] > counts[1]:
        remedy = "the reference is the coarser one: exchange the two"
    return MeshError(
        f"mesh: {counts[0]} triangles do not nest in the reference's {counts[1]}; {remedy}"
    )
