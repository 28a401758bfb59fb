"""The statement of a problem: what a discretisation depends on, and nothing else of a scene."""

from dataclasses import dataclass, field

from signorini.formula import Formula


@dataclass(frozen=True)
class Data:
    """The data of a problem, each a `Formula`: force f, flux g, Dirichlet values, obstacle, diffusion coefficient."""

    f: Formula
    g: Formula
    dirichlet: Formula
    obstacle: Formula
    coefficient: Formula = field(default_factory=lambda: Formula("1", "data.coefficient"))


@dataclass(frozen=True)
class ProblemStatement:
    """What a discretisation depends on, and nothing else of a scene.

    Parameters
    ----------
    domain, boundary : dict
        The sections of these names of a scene.
    data : Data
    load_quadrature : str or int
    """

    domain: dict
    boundary: dict
    data: Data
    load_quadrature: str | int

    @classmethod
    def from_mapping(cls, mapping):
        """Build from a mapping with the keys domain, boundary, data and load_quadrature."""
        data = {name: Formula(text, f"data.{name}") for name, text in mapping["data"].items()}
        return cls(mapping["domain"], mapping["boundary"], Data(**data), mapping["load_quadrature"])
