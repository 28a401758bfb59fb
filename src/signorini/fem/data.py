"""The data of a problem, as formulas; known before anything is meshed, and NumPy not loaded."""

from dataclasses import dataclass, field

from signorini.exceptions import SceneError
from signorini.formula import Formula

# The least and the greatest coefficient: products with data then neither under- nor overflow.
COEFFICIENTS = (1e-100, 1e100)


@dataclass(frozen=True)
class BySubdomain:
    """A number for each subdomain of a mesh file, which is a group of its triangles.

    `coefficient.coefficient_on` gives each triangle its number.

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
    """The data of a problem, each a `Formula`, or a `Function` of a program.

    Those on the boundary may be given part by part, see `by_part.ByPart`. Data derived from an
    exact solution are callables of the same interface; such a g also takes
    the normal.

    Parameters
    ----------
    f : Formula
        Volume force, unit of k u per length squared.
    g : Formula
        Flux on the Neumann part, unit of k u per length.
    dirichlet, obstacle : Formula
        Values on the Dirichlet part, and the least ones on the contact part; unit of u.
    coefficient : Formula or BySubdomain
        Diffusion coefficient k.
    contact_flux : Formula
        The threshold s of k du/dnu on the contact part, unit of k u per length.
    constraint : {"lower", "upper"}
        u >= obstacle and k du/dnu >= s on the contact part, or <= both times; one of the two binds.
    """

    f: Formula
    g: Formula
    dirichlet: Formula
    obstacle: Formula
    coefficient: Formula | BySubdomain = field(
        default_factory=lambda: Formula("1", "data.coefficient")
    )
    contact_flux: Formula = field(default_factory=lambda: Formula("0", "data.contact_flux"))
    constraint: str = "lower"


def read_coefficient(value):
    """The entry ``data.coefficient`` of a scene.

    It is a `BySubdomain` where it is a section, else a `Formula`.

    Examples
    --------
    >>> read_coefficient({"steel": 50, "copper": 400}).numbers["copper"]
    400
    """
    datum_class = BySubdomain if isinstance(value, dict) else Formula
    return datum_class(value, "data.coefficient")
