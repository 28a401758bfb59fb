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
    load_precision : {"double", "single"}
    """

    domain: dict
    boundary: dict
    data: Data
    load_quadrature: str | int
    coarsest: int = 1
    exact: object = None
    load_precision: str = "double"

    @cached_property
    def triangulations(self):
        """The domain as `Rectangle` or `Refined`: the triangulation of every level.

        Examples
        --------
        >>> from signorini import load_scene
        >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
        >>> statement.triangulations.level(4).number_of_triangles
        32
        """
        from signorini.mesh.domain import make_domain

        return make_domain(self.domain, self.boundary, self.coarsest)

    def on(self, domain):
        """The same statement on a domain that was made already.

        Parameters
        ----------
        domain : Rectangle or Refined
            Of the sections ``domain`` and ``boundary``, and of the coarsest level.

        Returns
        -------
        ProblemStatement

        Examples
        --------
        >>> from signorini import load_scene
        >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
        >>> domain = statement.triangulations
        >>> statement.on(domain).triangulations is domain
        True
        """
        shared = replace(self)
        shared.__dict__["triangulations"] = domain
        return shared

    @property
    def needs_mesh(self):
        """Whether more can be wrong than a document shows.

        That is the domain, names in a mesh file, and an exact truth.

        Examples
        --------
        >>> from signorini.scene.read import read_scene
        >>> scenes = [read_scene(f"config/scenes/{name}.yaml") for name in ("paper", "l-shape")]
        >>> [scene.problem_statement.needs_mesh for scene in scenes]
        [False, True]
        """
        is_rectangle = self.domain.get("kind", "rectangle") == "rectangle"
        return not is_rectangle or by_formula(self.boundary) or self.exact is not None

    def check(self):
        """Check what only a triangulation shows, on the coarsest level.

        That is: the domain and the names of its parts; subdomains of the coefficient; data that
        the scene gives against an exact truth, and that against balance and Signorini's conditions.
        However often it is called, the work is done once.

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

        Data that are not given are derived from the exact truth, or zero.

        Parameters
        ----------
        mapping : dict
            ``domain``, ``boundary``, ``data`` and ``load_quadrature``; perhaps
            ``load_precision``, ``constraint``, ``coarsest``, and ``truth`` where it is exact.

        Returns
        -------
        ProblemStatement

        Raises
        ------
        FormulaError, SceneError
            Naming the field, its value and the remedy.

        Examples
        --------
        >>> parts = {"domain": {}, "boundary": {}, "data": {"f": "2*x"}, "load_quadrature": "exact"}
        >>> data = ProblemStatement.from_mapping(parts).data
        >>> data.f.text, data.obstacle.text
        ('2*x', '0')
        """
        given = _read_data(mapping["data"])
        exact = None
        if "truth" in mapping:
            from signorini.exact import derived_data, read_exact

            exact = read_exact(mapping["truth"], given.get("coefficient"))
            data = replace(derived_data(exact), **given)
        else:
            data = Data(**_zero_data() | given)
        data = replace(data, constraint=mapping.get("constraint", "lower"))
        return cls(
            domain=mapping["domain"],
            boundary=mapping["boundary"],
            data=data,
            load_quadrature=mapping["load_quadrature"],
            coarsest=mapping.get("coarsest", 1),
            exact=exact,
            load_precision=mapping.get("load_precision", "double"),
        )


def _read_data(section):
    """The section ``data`` as formulas and a coefficient."""
    data = {
        name: Formula(text, f"data.{name}")
        for name, text in section.items()
        if name != "coefficient"
    }
    if "coefficient" in section:
        data["coefficient"] = read_coefficient(section["coefficient"])
    return data


def _zero_data():
    return {name: Formula("0", f"data.{name}") for name in ("g", "dirichlet", "obstacle")}
