"""A rectangle of a scene, cut anew at every level, mostly into a `Grid`, which is arithmetic."""

import math
from dataclasses import dataclass

from signorini.memory import GRID, MESH, check_memory
from signorini.mesh.boundary import SIDES, by_formula
from signorini.mesh.cell_counts import count_cells
from signorini.mesh.grid import Grid
from signorini.mesh.lattice import CORNERS, Lattice


@dataclass(frozen=True)
class Rectangle:
    """A rectangle and what holds on its boundary.

    Parameters
    ----------
    origin, size : sequence of float
        Lower left corner and side lengths, in the user's unit of length.
    diagonal : {"falling", "rising", "alternating", "alternating-rising", "criss-cross"}
        How every cell is cut.
    cells : {"per-unit", "per-side"}
        Whether level n has n cells per unit of length (h = 1/n) or n along each side.
    boundary : dict
        Side -> label, or label -> formula.
    grade : dict, optional
        ``towards`` (sides) and ``exponent`` of a grading.
    perturb : dict, optional
        ``amount`` and ``seed`` of a random perturbation of the interior vertices.

    Examples
    --------
    >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
    >>> Rectangle([0, 0], [2, 1], "falling", "per-unit", sides).level(4).number_of_triangles
    64
    """

    origin: tuple[float, float]
    size: tuple[float, float]
    diagonal: str
    cells: str
    boundary: dict
    grade: dict | None = None
    perturb: dict | None = None

    def counts(self, n):
        """Cells along x and y at level n.

        Raises
        ------
        MeshError
            If a side is not a whole number of cells.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> Rectangle((0.0, 0.0), (2.0, 1.0), "falling", "per-unit", sides).counts(4)
        (8, 4)
        """
        return count_cells(self.size, self.cells, n)

    @property
    def uniform(self):
        """Whether arithmetic describes every level, a `Grid`.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> Rectangle((0.0, 0.0), (1.0, 1.0), "falling", "per-unit", sides).uniform
        True
        >>> Rectangle((0.0, 0.0), (1.0, 1.0), "criss-cross", "per-unit", sides).uniform
        False
        """
        altered = self.grade is not None or self.perturb is not None
        return self.diagonal in CORNERS and not altered and not by_formula(self.boundary)

    def count_triangles(self, n):
        """Number of triangles of level n, which is not made; errors as for `counts`.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> Rectangle((0.0, 0.0), (1.0, 1.0), "falling", "per-unit", sides).count_triangles(512)
        524288
        """
        return math.prod(self.counts(n)) * (4 if self.diagonal == "criss-cross" else 2)

    def level(self, n):
        """The triangulation of level n: a `Grid` where arithmetic describes it.

        Otherwise it is a `Triangulation`.

        Raises
        ------
        MeshError
            If a side is not a whole number of cells, or the level is beyond the coordinates'
            resolution or the memory.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> rectangle = Rectangle((0.0, 0.0), (2.0, 1.0), "falling", "per-unit", sides)
        >>> rectangle.level(4).number_of_triangles
        64
        """
        check_memory(self.count_triangles(n), GRID if self.uniform else MESH, f"n = {n}")
        grid = self.grid(n)
        return grid if self.uniform else self._cut((grid.nx, grid.ny), grid.origin, grid.size)

    def grid(self, n):
        """The grid of level n, whether its memory is there or not; it takes none before it is used.

        Parameters
        ----------
        n : int

        Returns
        -------
        Grid
            The labels are those of the sides, or where the boundary is given by formulas none.

        Raises
        ------
        MeshError
            As `level`, but for the memory.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> grid = Rectangle((0.0, 0.0), (2.0, 1.0), "falling", "per-unit", sides).grid(10**6)
        >>> grid.nx, grid.ny
        (2000000, 1000000)
        """
        from signorini.mesh.resolution import check_resolution

        counts = self.counts(n)
        origin, size = tuple(map(float, self.origin)), tuple(map(float, self.size))
        upper = [start + length for start, length in zip(origin, size, strict=True)]
        spacing = [length / count for length, count in zip(size, counts, strict=True)]
        check_resolution(origin, upper, spacing, "domain")
        labels = tuple(self.boundary.get(side, "") for side in SIDES)
        return Grid(*counts, origin, size, self.diagonal, labels)

    def _cut(self, counts, origin, size):
        """The triangulation that is no `Grid`."""
        from signorini.mesh import patterns
        from signorini.mesh.labels import labelled
        from signorini.mesh.named_mesh import NamedMesh, with_sides
        from signorini.mesh.rules import boundary_rules

        if self.diagonal in CORNERS:
            lattice = Lattice(*counts, origin, size, self.diagonal)
            mesh = with_sides(NamedMesh(lattice.p, lattice.t, source="rectangle"))
        else:
            mesh = patterns.PATTERNS[self.diagonal](*counts, origin, size)
        if self.grade is not None:
            mesh = patterns.graded(mesh, self.grade["towards"], self.grade["exponent"])
        if self.perturb is not None:
            mesh = patterns.perturbed(mesh, self.perturb["amount"], self.perturb["seed"])
        return labelled(mesh, boundary_rules(self.boundary))

    def mesh_size(self, n):
        """The mesh width h of level n: 1/n, or the longer side of a cell; unit of length.

        Examples
        --------
        >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
        >>> Rectangle((0.0, 0.0), (2.0, 1.0), "falling", "per-unit", sides).mesh_size(4)
        0.25
        """
        return 1.0 / n if self.cells == "per-unit" else max(self.size) / n
