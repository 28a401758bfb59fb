"""The statement of a problem: what a discretisation depends on, and nothing else of a scene."""

from dataclasses import dataclass, replace
from functools import cached_property

from signorini.fem.data import BySubdomain, Data, read_coefficient
from signorini.formula import Formula
from signorini.mesh.boundary import by_formula


@dataclass(frozen=True, eq=False)
class ProblemStatement:
    """What a discretisation depends on, and nothing else of a scene.

    Parameters
    ----------
    domain, boundary : dict
        The sections of these names of a scene.
    data : Data
    load_quadrature : str or int
    coarsest : int
        The coarsest level, from which domains other than rectangles are refined.
    exact : ExactSolution, optional
        Where the truth is one.
    """

    domain: dict
    boundary: dict
    data: Data
    load_quadrature: str | int
    coarsest: int = 1
    exact: object = None

    @cached_property
    def triangulations(self):
        """The domain as `mesh.Rectangle` or `mesh.Refined`: the triangulation of every level."""
        from signorini.mesh.domain import make_domain

        return make_domain(self.domain, self.boundary, self.coarsest)

    @property
    def needs_mesh(self):
        """Whether more can be wrong than a document shows: the domain, names in a mesh file, an
        exact truth.
        """
        plain = self.domain.get("kind", "rectangle") == "rectangle" and not by_formula(
            self.boundary
        )
        return not plain or self.exact is not None

    def check(self):
        """Check what only a triangulation shows, on the coarsest level; once, however often it is
        called.

        The domain and the names of its parts; subdomains of the coefficient; typed data against an
        exact truth, and that against balance and Signorini's conditions.

        Raises
        ------
        MeshError
            Naming the part of the boundary, the group, or what is wrong with the domain.
        SceneError
            Naming the datum or condition, the point, and both values.
        """
        if self.needs_mesh:
            return self._checked

    @cached_property
    def _checked(self):
        domain = self.triangulations
        if by_formula(self.boundary):
            domain.level(self.coarsest)
        if isinstance(self.data.coefficient, BySubdomain):
            from signorini.fem.coefficient import coefficient_on

            coefficient_on(domain.level(self.coarsest), self.data.coefficient)
        if self.exact is not None:
            from signorini.exact.check import check_data
            from signorini.exact.samples import Samples

            check_data(self.exact, self.data, Samples.of_domain(domain, self.coarsest))

    @classmethod
    def from_mapping(cls, mapping):
        """Build from the mapping `Scene.statement`.

        Data that are not typed are derived from the exact truth, or zero.
        """
        typed = {
            name: Formula(text, f"data.{name}")
            for name, text in mapping["data"].items()
            if name != "coefficient"
        }
        if "coefficient" in mapping["data"]:
            typed["coefficient"] = read_coefficient(mapping["data"]["coefficient"])
        exact = None
        if "truth" in mapping:
            from signorini.exact import derived_data, read_exact

            exact = read_exact(mapping["truth"], typed.get("coefficient"))
            data = replace(derived_data(exact), **typed)
        else:
            zero = {name: Formula("0", f"data.{name}") for name in ("g", "dirichlet", "obstacle")}
            data = Data(**zero | typed)
        parts = (mapping["domain"], mapping["boundary"], data, mapping["load_quadrature"])
        return cls(*parts, mapping.get("coarsest", 1), exact)
