"""The domain of a scene: its coarsest labelled triangulation, of which every level n is a refinement."""

import json
from dataclasses import asdict, dataclass

from signorini.exceptions import MeshError, StorageError
from signorini.mesh.grid import CORNERS, SIDES, Grid
from signorini.storage import read_npz, write_npz


@dataclass(frozen=True)
class Domain:
    """A rectangle and what holds on its sides.

    Parameters
    ----------
    origin, size : tuple of float
        Lower left corner and side lengths, in the user's unit of length.
    diagonal : {"falling", "rising"}
        How every cell is cut; see `Grid`.
    cells : {"per-unit", "per-side"}
        Whether level n has n cells per unit of length (h = 1/n) or n along each side.
    labels : tuple of str
        ``"dirichlet"``, ``"contact"`` or ``"neumann"`` for each of `mesh.grid.SIDES`.
    """

    origin: tuple[float, float]
    size: tuple[float, float]
    diagonal: str
    cells: str
    labels: tuple[str, str, str, str]

    @classmethod
    def from_mapping(cls, domain, boundary):
        """Build from the sections ``domain`` and ``boundary`` of a scene."""
        return cls(
            origin=tuple(float(v) for v in domain["origin"]),
            size=tuple(float(v) for v in domain["size"]),
            diagonal=domain["diagonal"],
            cells=domain["cells"],
            labels=tuple(boundary[side] for side in SIDES),
        )

    def counts(self, n):
        """Cells along x and y at level n.

        Raises
        ------
        MeshError
            If a side is not a whole number of cells.
        """
        if self.cells == "per-side":
            return n, n
        counts = [n * side for side in self.size]
        for axis, count in zip("xy", counts, strict=True):
            if abs(count - round(count)) > 1e-9 * count or round(count) < 1:
                raise MeshError(
                    f"domain.size: level n = {n} cuts the {axis} side into {count:.6g} cells; choose n so that "
                    "n times the side is a whole number, or set domain.cells to per-side"
                )
        return round(counts[0]), round(counts[1])

    def level(self, n):
        """The triangulation of level n, a `Grid`."""
        nx, ny = self.counts(n)
        return Grid(nx, ny, self.origin, self.size, self.diagonal, self.labels)

    def mesh_size(self, n):
        """The mesh width h of level n: 1/n, or the longer side of a cell; unit of length."""
        return 1.0 / n if self.cells == "per-unit" else max(self.size) / n


def write_domain(path, domain):
    """Store a domain with its coarsest triangulation: vertices, triangles, labelled facets."""
    root = Grid(1, 1, domain.origin, domain.size, domain.diagonal, domain.labels)
    facets = {f"facets_{side}": root.facets[:, root.side_facets(side)] for side in SIDES}
    write_npz(path, kind="domain", p=root.p, t=root.t, specification=json.dumps(asdict(domain)), **facets)


def read_domain(path):
    """Read what `write_domain` stored.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or not a domain.
    """
    fields = json.loads(str(read_npz(path, kind="domain")["specification"]))
    domain = Domain(**{key: tuple(v) if isinstance(v, list) else v for key, v in fields.items()})
    if domain.diagonal not in CORNERS:
        raise StorageError(f"{path}: unknown diagonal {domain.diagonal!r}; delete the file and rerun")
    return domain
