"""The domain of a scene: what every level of its triangulations is made from.

A rectangle is cut anew at every level, mostly into a `Grid`, which is arithmetic. Any other domain
is triangulated once, its root, and every level is a uniform refinement of it.
"""

import json
import math
from dataclasses import asdict, dataclass, replace
from functools import cached_property

import numpy as np

from signorini.exceptions import MeshError
from signorini.memory import GRID, MESH, check_memory
from signorini.mesh.boundary import LABELS, SIDES, by_formula
from signorini.mesh.cell_counts import count_cells
from signorini.mesh.grid import CORNERS, Grid
from signorini.storage import read_npz, write_npz


def make_domain(domain, boundary, coarsest):
    """Build a domain from the sections ``domain`` and ``boundary`` of a scene.

    Parameters
    ----------
    domain, boundary : dict
        Validated, defaults filled in, a mesh file's path resolved.
    coarsest : int
        The coarsest level: that of the root where there is one.

    Returns
    -------
    Rectangle or Refined

    Raises
    ------
    MeshError
        If the domain cannot be triangulated or its boundary not be labelled.
    """
    if domain.get("kind", "rectangle") == "rectangle":
        keys = ("origin", "size", "diagonal", "cells")
        return Rectangle(
            **{key: domain[key] for key in keys}, boundary=boundary, **_studies(domain)
        )
    from signorini.mesh.labels import labelled

    mesh = _root(domain, coarsest)
    if "perturb" in domain:
        mesh = _perturbed(mesh, domain["perturb"])
    width = _longest_edge(mesh) if domain["kind"] == "mesh" else 1.0 / coarsest
    return Refined(
        labelled(mesh, _rules(boundary)),
        coarsest,
        width,
        boundary if by_formula(boundary) else None,
    )


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
        """
        return count_cells(self.size, self.cells, n)

    @property
    def uniform(self):
        """Whether arithmetic describes every level, a `Grid`."""
        altered = self.grade is not None or self.perturb is not None
        return self.diagonal in CORNERS and not altered and not by_formula(self.boundary)

    def count_triangles(self, n):
        """Number of triangles of level n, which is not made; errors as for `counts`."""
        return math.prod(self.counts(n)) * (4 if self.diagonal == "criss-cross" else 2)

    def level(self, n):
        """The triangulation of level n: a `Grid` where arithmetic describes it, else a
        `Triangulation`.

        Raises
        ------
        MeshError
            If a side is not a whole number of cells, or the level is beyond the coordinates'
            resolution or the memory.
        """
        from signorini.mesh.check import check_resolution

        counts, origin, size = (
            self.counts(n),
            tuple(map(float, self.origin)),
            tuple(map(float, self.size)),
        )
        upper = [a + b for a, b in zip(origin, size, strict=True)]
        check_resolution(
            origin, upper, [b / k for b, k in zip(size, counts, strict=True)], "domain"
        )
        check_memory(self.count_triangles(n), GRID if self.uniform else MESH, f"n = {n}")
        if self.uniform:
            return Grid(
                *counts, origin, size, self.diagonal, tuple(self.boundary[side] for side in SIDES)
            )
        return self._cut(counts, origin, size)

    def _cut(self, counts, origin, size):
        """The triangulation that is no `Grid`."""
        from signorini.mesh import patterns
        from signorini.mesh.labels import NamedMesh, labelled, with_sides

        if self.diagonal in CORNERS:
            grid = Grid(*counts, origin, size, self.diagonal, ("neumann",) * 4)
            mesh = with_sides(NamedMesh(grid.p, grid.t, source="rectangle"))
        else:
            mesh = patterns.PATTERNS[self.diagonal](*counts, origin, size)
        if self.grade is not None:
            mesh = patterns.graded(mesh, self.grade["towards"], self.grade["exponent"])
        if self.perturb is not None:
            mesh = _perturbed(mesh, self.perturb)
        return labelled(mesh, _rules(self.boundary))

    def mesh_size(self, n):
        """The mesh width h of level n: 1/n, or the longer side of a cell; unit of length."""
        return 1.0 / n if self.cells == "per-unit" else max(self.size) / n


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
    """

    root: object
    coarsest: int
    width: float
    boundary: dict | None = None

    @cached_property
    def _levels(self):
        return {self.coarsest: self.root}

    def count_triangles(self, n):
        """Number of triangles of level n, which is not made; errors as for `level`."""
        ratio, rest = divmod(n, self.coarsest)
        if rest or ratio < 1 or ratio & (ratio - 1):
            raise MeshError(
                f"levels: {n} is no uniform refinement of the root's level {self.coarsest}; double it"
            )
        return ratio**2 * self.root.number_of_triangles

    def level(self, n):
        """The triangulation of level n.

        Raises
        ------
        MeshError
            If n is no power of two times the root's level.
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
        from signorini.mesh.labels import NamedMesh, labelled_ends

        return replace(
            finer, ends=labelled_ends(NamedMesh(finer.p, finer.t), _rules(self.boundary))
        )

    def mesh_size(self, n):
        """The mesh width h of level n: half the root's for each doubling of n; unit of length."""
        return self.width * self.coarsest / n


def _root(domain, coarsest):
    if domain["kind"] == "mesh":
        from signorini.mesh.imported import import_mesh

        return import_mesh(domain["file"])
    from signorini.mesh.polygon import triangulate

    return triangulate(domain["corners"], domain["holes"], 1.0 / coarsest, domain.get("sides"))


def _studies(domain):
    return {key: domain[key] for key in ("grade", "perturb") if key in domain}


def _perturbed(mesh, perturb):
    from signorini.mesh.patterns import perturbed

    return perturbed(mesh, perturb["amount"], perturb["seed"])


def _longest_edge(mesh):
    a, b = mesh.facets
    return float(np.hypot(*(mesh.p[:, a] - mesh.p[:, b])).max())


def _rules(boundary):
    """Rules for `labels.label_boundary`; "rest" takes the facets that no formula takes."""
    if not by_formula(boundary):
        return boundary
    from signorini.formula import Formula

    formulas = {
        label: Formula(text, f"boundary.{label}")
        for label, text in boundary.items()
        if text != "rest"
    }
    rules = [(formula, label) for label, formula in formulas.items()]
    rest = [label for label, text in boundary.items() if text == "rest"]
    return rules + [(_none_of(formulas.values()), label) for label in rest]


def _none_of(formulas):
    def positive_elsewhere(x, y):
        taken = np.zeros(np.broadcast(x, y).shape, dtype=bool)
        for formula in formulas:
            taken |= formula(x, y) > 0.0
        return np.where(taken, -1.0, 1.0)

    positive_elsewhere.text = "rest"
    return positive_elsewhere


def write_domain(path, domain):
    """Store a domain with its coarsest triangulation: vertices, triangles, labelled facets,
    subdomains.
    """
    if isinstance(domain, Rectangle):
        write_npz(
            path, kind="domain", specification=json.dumps({"kind": "rectangle"} | asdict(domain))
        )
        return
    specification = {
        "kind": "refined",
        "coarsest": domain.coarsest,
        "width": domain.width,
        "boundary": domain.boundary,
    }
    root = domain.root
    specification["subdomains"] = list(root.subdomains)
    members = {f"subdomain_{k}": found for k, found in enumerate(root.subdomains.values())}
    write_npz(
        path,
        kind="domain",
        specification=json.dumps(specification),
        p=root.p,
        t=root.t,
        **root.ends,
        **members,
    )


def read_domain(path):
    """Read what `write_domain` stored.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or not a domain.
    """
    arrays = read_npz(path, kind="domain")
    fields = json.loads(str(arrays["specification"]))
    if fields.pop("kind") == "rectangle":
        return Rectangle(**fields)
    from signorini.mesh.triangulation import Triangulation

    ends = {label: arrays[label] for label in LABELS if label in arrays}
    subdomains = {name: arrays[f"subdomain_{k}"] for k, name in enumerate(fields.pop("subdomains"))}
    return Refined(Triangulation(arrays["p"], arrays["t"], ends, subdomains), **fields)
