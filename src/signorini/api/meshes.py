"""Domains with named parts of the boundary, triangulated, and refined uniformly at will."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from signorini.api.arguments import described
from signorini.api.saving import saved
from signorini.api.types import Floats, Integers
from signorini.exceptions import MeshError
from signorini.mesh.boundary import SIDES, offered, part_key
from signorini.mesh.domain import make_domain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST_SHOWN = 20000  # triangles in a picture


@dataclass(frozen=True, eq=False, repr=False)
class Mesh:
    """A triangulated domain whose boundary has named parts.

    Make one by `rectangle`, `polygon` or `triangulation`.

    Parameters
    ----------
    domain : dict
        What `mesh.domain.make_domain` makes it from, but for the boundary's labels.
    n : int
        Its level. Of a rectangle or polygon the mesh width is 1/n; any other mesh has n = 1 before
        it is refined, and each refinement doubles n.
    coarsest : int
        The level of the mesh that it is refined from.
    """

    domain: dict[str, Any]
    n: int
    coarsest: int = 1

    @property
    def boundaries(self) -> tuple[str, ...]:
        """The names of the parts of the boundary.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(4).boundaries
        ('bottom', 'right', 'top', 'left')
        """
        return SIDES if self._is_rectangle else tuple(self.domain["mesh"].parts)

    @property
    def subdomains(self) -> tuple[str, ...]:
        """The names of the subdomains."""
        return () if self._is_rectangle else tuple(self.domain["mesh"].subdomains)

    @property
    def h(self) -> float:
        """Mesh width, unit of length.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(4).h, signorini.rectangle(4).refined().h
        (0.25, 0.125)
        """
        return float(self._unlabelled.mesh_size(self.n))

    @property
    def p(self) -> Floats:
        """Vertices, shape (2, nv), unit of length.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(1).p
        array([[0., 1., 0., 1.],
               [0., 0., 1., 1.]])
        """
        return self._triangulation.p

    @property
    def t(self) -> Integers:
        """Vertices of each triangle, shape (3, nt).

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(1).t.T.tolist()
        [[0, 1, 2], [3, 2, 1]]
        """
        return self._triangulation.t

    @property
    def number_of_triangles(self) -> int:
        """Number of triangles.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(4).number_of_triangles, signorini.rectangle(8).number_of_triangles
        (32, 128)
        """
        return int(self._unlabelled.count_triangles(self.n))

    def refined(self, times: int = 1) -> "Mesh":
        """Every triangle cut into four by the midpoints of its sides, so many times.

        Multigrid takes the meshes in between for its levels, and a solution on one of them can be
        held against one on a finer one.

        Parameters
        ----------
        times : int, optional

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            If `times` is no whole number, or negative.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(4).refined(2).n
        16
        """
        if not _is_whole(times) or times < 0:
            raise MeshError(
                f"times: {described(times)} is not valid; give a whole number, 0 or more"
            )
        return replace(self, n=self.n * 2 ** int(times))

    def level(self, n: int) -> "Mesh":
        """The mesh of the same domain at another level.

        Parameters
        ----------
        n : int
            Of a rectangle any whole number; else the coarsest level times a power of two.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            If there is no such level.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(4).level(6).h * 6
        1.0
        """
        check_level(n)
        self._unlabelled.count_triangles(int(n))
        return replace(self, n=int(n))

    def labelled(self, labels: Mapping[str, str], rest: str | None) -> tuple[dict, dict]:
        """The sections ``domain`` and ``boundary`` of a statement.

        Parameters
        ----------
        labels : dict
            Name of a part -> ``"dirichlet"``, ``"contact"`` or ``"neumann"``.
        rest : str or None
            The label of all else; None to refuse facets in no part that is named.

        Returns
        -------
        domain, boundary : dict

        Raises
        ------
        MeshError
            If there is no label for a side of a rectangle.

        Examples
        --------
        >>> import signorini
        >>> signorini.rectangle(4).labelled({"bottom": "contact"}, rest="neumann")[1]
        {'bottom': 'contact', 'right': 'neumann', 'top': 'neumann', 'left': 'neumann'}
        """
        if not self._is_rectangle:
            return self.domain | {"rest": rest}, dict(labels)
        missing = [side for side in SIDES if side not in labels]
        if missing and rest is None:
            raise MeshError(
                f"neumann: the side {missing[0]} has no condition; name it in dirichlet, contact "
                "or neumann, or leave neumann out to have all that is left"
            )
        return self.domain, {side: labels.get(side, rest) for side in SIDES}

    def to_skfem(self) -> Any:
        """The mesh as a `skfem.MeshTri`, numbered alike, its boundaries and subdomains named.

        Examples
        --------
        >>> import signorini
        >>> mesh = signorini.rectangle(4).to_skfem()
        >>> sorted(mesh.boundaries), mesh.t.shape
        (['bottom', 'left', 'neumann', 'right', 'top'], (3, 32))
        """
        boundaries, subdomains = self._named()
        mesh = self._triangulation.skfem
        return mesh.with_boundaries(boundaries).with_subdomains(subdomains)

    def plot(self, path: str | Path | None = None, title: str | None = None) -> "Figure":
        """Draw the triangles, and the parts of the boundary and the subdomains by their names.

        Of a mesh of more than 20000 triangles a coarser level is drawn, where there is one.

        Parameters
        ----------
        path : str or Path, optional
            Where to write the figure, .pdf or .png.
        title : str, optional
            Plain text; by default the number of triangles, and the level.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        SceneError
            If the path does not end in .pdf or .png.
        """
        from signorini.figures.mesh import draw_mesh
        from signorini.report.named_parts import named_parts

        shown = self._coarse_enough(_MOST_SHOWN)
        if title is None:
            title = f"{shown.number_of_triangles:,} triangles, level n = {shown.n}"
        facets, triangles = shown._named()
        own = {name: facets[name] for name in offered(facets)}
        return saved(draw_mesh(named_parts(shown._triangulation, own, triangles), title), path)

    def _coarse_enough(self, most_triangles: int) -> "Mesh":
        """The finest level of so many triangles, halving n; the coarsest where all have more."""
        mesh = self
        while mesh.number_of_triangles > most_triangles and mesh.n % 2 == 0:
            try:
                mesh = mesh.level(mesh.n // 2)
            except MeshError:
                break
        return mesh

    def _named(self) -> tuple[dict[str, Integers], dict[str, Integers]]:
        """Facets of the parts of the boundary, and triangles of the subdomains."""
        mesh = self._triangulation
        facets = {name: mesh.boundary_facets(part_key(name)) for name in self.boundaries}
        return facets, {name: mesh.subdomains[name] for name in self.subdomains}

    def __repr__(self) -> str:
        parts = ", ".join(offered(self.boundaries)) or "none named"
        return (
            f"<Mesh of level {self.n}: {self.number_of_triangles} triangles; boundaries: {parts}>"
        )

    @property
    def _is_rectangle(self) -> bool:
        return bool(self.domain["kind"] == "rectangle")

    @cached_property
    def _unlabelled(self) -> Any:
        """Every level, the whole boundary under one label."""
        labels = dict.fromkeys(self.boundaries, "neumann")
        return make_domain(*self.labelled(labels, "neumann"), self.coarsest)

    @property
    def _triangulation(self) -> Any:
        return self._unlabelled.level(self.n)


def check_level(n: object) -> None:
    """Refuse what is no level.

    Raises
    ------
    MeshError
        Saying what one is.

    Examples
    --------
    >>> check_level(2.5)
    Traceback (most recent call last):
    signorini.exceptions.MeshError: n: 2.5 (float) is not valid; n is 1/h, a whole ...
    """
    if not _is_whole(n) or n < 1:  # type: ignore[operator]
        raise MeshError(f"n: {described(n)} is not valid; n is 1/h, a whole number, for instance 8")


def _is_whole(value: object) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)
