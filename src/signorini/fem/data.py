"""The data of a problem, as formulas; known before anything is meshed, and NumPy not loaded."""

from dataclasses import dataclass, field

from signorini.exceptions import SceneError
from signorini.formula import Formula

COEFFICIENTS = (
    1e-100,
    1e100,
)  # the least and the greatest: products with data then neither under- nor overflow


@dataclass(frozen=True)
class BySubdomain:
    """A number for each subdomain of a mesh file, a group of its triangles;
    `coefficient.coefficient_on` places them.

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
                raise SceneError(
                    f"{place}: {number} is not valid; it must be from {low:g} to {high:g}"
                )


@dataclass(frozen=True)
class Data:
    """The data of a problem, each a `Formula`: force f, flux g, Dirichlet values, obstacle,
    diffusion coefficient.

    The coefficient may be a `BySubdomain` instead. Data derived from an exact solution are
    callables of the same interface; such a g also takes the normal.
    """

    f: Formula
    g: Formula
    dirichlet: Formula
    obstacle: Formula
    coefficient: Formula | BySubdomain = field(
        default_factory=lambda: Formula("1", "data.coefficient")
    )


def read_coefficient(value):
    """The entry ``data.coefficient`` of a scene: a `Formula`, or `BySubdomain` where it is a
    section.
    """
    return (BySubdomain if isinstance(value, dict) else Formula)(value, "data.coefficient")
