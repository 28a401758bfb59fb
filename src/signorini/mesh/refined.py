"""A domain that is triangulated once, its root: every level is a uniform refinement of it."""

from dataclasses import dataclass, replace
from functools import cached_property

from signorini.exceptions import MeshError
from signorini.memory import MESH, check_memory


@dataclass(frozen=True, eq=False)
class Refined:
    """A root triangulation and its uniform refinements.

    Parameters
    ----------
    root : Triangulation
    coarsest : int
        The root's level.
    width : float
        The root's mesh width, unit of length.
    boundary : dict, optional
        Label -> formula; applied again on every level. Without it the root's labels are inherited.

    Examples
    --------
    >>> from signorini.mesh.triangulation import Triangulation
    >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
    >>> root = Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends)
    >>> domain = Refined(root, coarsest=1, width=1.0)
    >>> domain.level(4).number_of_triangles, domain.mesh_size(4)
    (16, 0.25)
    """

    root: object
    coarsest: int
    width: float
    boundary: dict | None = None

    @cached_property
    def _levels(self):
        return {self.coarsest: self.root}

    def count_triangles(self, n):
        """Number of triangles of level n, which is not made.

        Raises
        ------
        MeshError
            If n is no power of two times the root's level.

        Examples
        --------
        >>> from types import SimpleNamespace
        >>> domain = Refined(SimpleNamespace(number_of_triangles=2), coarsest=1, width=1.0)
        >>> [domain.count_triangles(n) for n in (1, 2, 1024)]
        [2, 8, 2097152]
        """
        ratio, rest = divmod(n, self.coarsest)
        is_power_of_two = ratio >= 1 and ratio & (ratio - 1) == 0
        if rest or not is_power_of_two:
            below = self.coarsest << (max(ratio, 1).bit_length() - 1)
            raise MeshError(
                f"levels: {n} is not {self.coarsest} times a power of two; "
                f"for instance {below} or {2 * below}"
            )
        return ratio**2 * self.root.number_of_triangles

    def level(self, n):
        """The triangulation of level n.

        Raises
        ------
        MeshError
            If n is no power of two times the root's level, or the memory is too small.

        Examples
        --------
        >>> from signorini.mesh.triangulation import Triangulation
        >>> ends = {"contact": [[0], [1]], "dirichlet": [[1, 0], [2, 2]]}
        >>> domain = Refined(Triangulation([[0, 1, 0], [0, 0, 1]], [[0], [1], [2]], ends), 1, 1.0)
        >>> domain.level(4).number_of_triangles, float(domain.level(4).area.sum())
        (16, 0.5)
        """
        triangles = self.count_triangles(n)
        if n not in self._levels:
            check_memory(triangles, MESH, f"n = {n}")
            self._levels[n] = self._refined(self.level(n // 2))
        return self._levels[n]

    def _refined(self, parent):
        finer = parent.refined()
        if self.boundary is None:
            return finer
        from signorini.mesh.labels import labelled_ends
        from signorini.mesh.named_mesh import NamedMesh
        from signorini.mesh.rules import boundary_rules

        ends = labelled_ends(NamedMesh(finer.p, finer.t), boundary_rules(self.boundary))
        return replace(finer, ends=finer.ends | ends)

    def mesh_size(self, n):
        """The mesh width h of level n: half the root's for each doubling of n; unit of length.

        Examples
        --------
        >>> [Refined(None, coarsest=2, width=0.5).mesh_size(n) for n in (2, 4, 8)]
        [0.5, 0.25, 0.125]
        """
        return self.width * self.coarsest / n
