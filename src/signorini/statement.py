"""The statement of a problem: what a discretisation depends on, and nothing else of a scene."""

from dataclasses import dataclass, field, replace
from functools import cached_property

from signorini.boundary import by_formula
from signorini.exceptions import SceneError
from signorini.formula import Formula

COEFFICIENTS = (1e-100, 1e100)  # the least and the greatest: products with data then neither under- nor overflow


@dataclass(frozen=True)
class BySubdomain:
    """A number for each subdomain of a mesh file, a group of its triangles; `coefficient.coefficient_on` places them.

    Parameters
    ----------
    numbers : dict of str to float
        Name of the subdomain -> number.
    field : str
        Name of the quantity, for error messages.

    Raises
    ------
    SceneError
        If a number is not one of `COEFFICIENTS`.
    """

    numbers: dict
    field: str

    def __post_init__(self):
        low, high = COEFFICIENTS
        for name, number in self.numbers.items():
            if not low <= number <= high:
                place = f"{self.field}.{name[:60]}"
                raise SceneError(f"{place}: {number} is not valid; it must be from {low:g} to {high:g}")


@dataclass(frozen=True)
class Data:
    """The data of a problem, each a `Formula`: force f, flux g, Dirichlet values, obstacle, diffusion coefficient.

    The coefficient may be a `BySubdomain` instead. Data
    derived from an exact solution are callables of the same interface; such a g also takes the normal.
    """

    f: Formula
    g: Formula
    dirichlet: Formula
    obstacle: Formula
    coefficient: Formula | BySubdomain = field(default_factory=lambda: Formula("1", "data.coefficient"))


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
        """Whether more can be wrong than a document shows: the domain, names in a mesh file, an exact truth."""
        plain = self.domain.get("kind", "rectangle") == "rectangle" and not by_formula(self.boundary)
        return not plain or self.exact is not None

    def check(self):
        """Check what only a triangulation shows, on the coarsest level; once, however often it is called.

        The domain and the names of its parts; subdomains of the coefficient; typed data against an exact truth, and
        that against balance and Signorini's conditions.

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
            from signorini.coefficient import coefficient_on

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
        typed = {name: Formula(text, f"data.{name}") for name, text in mapping["data"].items() if name != "coefficient"}
        if "coefficient" in mapping["data"]:
            typed["coefficient"] = read_coefficient(mapping["data"]["coefficient"])
        exact = None
        if "truth" in mapping:
            from signorini.exact import Diffused, derived_data, read_exact

            exact = read_exact(mapping["truth"])
            coefficient = typed.get("coefficient", Formula("1"))
            if not isinstance(coefficient, Formula):
                raise SceneError("data.coefficient: an exact truth needs a formula in x and y, not a section")
            if coefficient.text != "1":
                exact = Diffused(exact, coefficient)
            data = replace(derived_data(exact), **typed)
        else:
            zero = {name: Formula("0", f"data.{name}") for name in ("g", "dirichlet", "obstacle")}
            data = Data(**zero | typed)
        parts = (mapping["domain"], mapping["boundary"], data, mapping["load_quadrature"])
        return cls(*parts, mapping.get("coarsest", 1), exact)


def read_coefficient(value):
    """The entry ``data.coefficient`` of a scene: a `Formula`, or `BySubdomain` where it is a section."""
    return (BySubdomain if isinstance(value, dict) else Formula)(value, "data.coefficient")
