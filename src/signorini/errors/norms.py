"""The norms in which errors are measured: their names, and what figures and tables call them.

Nothing here imports NumPy.
"""

from dataclasses import dataclass

from signorini.exceptions import SceneError


@dataclass(frozen=True)
class Norm:
    """What a norm is called.

    Parameters
    ----------
    heading : str
        Over a column of a table in LaTeX.
    text : str
        In plain text and in Markdown.
    axis : str
        At the axis of a figure.
    symbol : str
        Where there is little room.

    Examples
    --------
    >>> NORMS["h1_semi"].text
    'H1 seminorm'
    """

    heading: str
    text: str
    axis: str
    symbol: str


NORMS = {
    "l2": Norm(
        heading="$L^2$ error",
        text="L2",
        axis="$L^2$ error",
        symbol="$L^2$",
    ),
    "h1": Norm(
        heading="$H^1$ error",
        text="H1",
        axis="$H^1$ error",
        symbol="$H^1$",
    ),
    "h1_semi": Norm(
        heading="broken $H^1$ seminorm",
        text="H1 seminorm",
        axis="broken $H^1$ seminorm of the error",
        symbol="$H^1$ seminorm",
    ),
    "energy": Norm(
        heading="energy norm",
        text="energy",
        axis="error in the energy norm",
        symbol="energy",
    ),
    "trace_l2": Norm(
        heading="$L^2$ error of the trace",
        text="trace L2",
        axis=r"$L^2(\Gamma_C)$ error of $u$",
        symbol="trace",
    ),
    "multiplier_l2": Norm(
        heading="$L^2$ error of the multiplier",
        text="multiplier L2",
        axis=r"$L^2(\Gamma_C)$ error of $k\,\mathrm{d}u/\mathrm{d}\nu$",
        symbol="multiplier",
    ),
    "critical_points": Norm(
        heading="critical points",
        text="critical points",
        axis="distance of the critical points",
        symbol="critical points",
    ),
}

PAPER_NORMS = ("l2", "h1")  # of the paper's table
PARTS_OF_H1 = ("l2", "h1_semi")  # whose squares add up to that of h1
GRADIENT = ("h1_semi", "h1", "energy")  # that need the gradient
DOMAIN = ("l2", *GRADIENT)
CONTACT = ("trace_l2", "multiplier_l2", "critical_points")  # on the contact part
RATED = (*DOMAIN, *CONTACT)  # those whose slope is taken: all

# Those that every row of errors has a column for, empty where they are not computed.
ALWAYS_NAMED = ("l2", "h1_semi", "h1")

REFERENCE = "reference"  # in the column floor: the solution is the reference itself


def check_in_domain(norms):
    """Refuse what is no norm of the error in the domain.

    Parameters
    ----------
    norms : iterable of str

    Raises
    ------
    SceneError
        With the norms that are known.

    Examples
    --------
    >>> check_in_domain(["l2", "H1"])
    Traceback (most recent call last):
    signorini.exceptions.SceneError: norms: unknown norm 'H1'; known: l2, h1_semi, h1, energy
    """
    for norm in norms:
        if norm not in DOMAIN:
            raise SceneError(f"norms: unknown norm {norm!r}; known: {', '.join(DOMAIN)}")
