"""Named exact solutions with their parameters.

Reading them imports no numpy: scenes are validated with it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from signorini.exact.diffused import with_coefficient
from signorini.exact.solution import FormulaSolution
from signorini.exceptions import SceneError
from signorini.formula import Formula
from signorini.wording import nearest


class Parameter(NamedTuple):
    """A number with its default and the range it must lie in."""

    default: float
    least: float = -math.inf
    open: bool = False  # whether `least` itself is excluded
    meaning: str = ""

    def read(self, given, field):
        """Value of a parameter that is given as a number or as a formula without variables.

        Parameters
        ----------
        given : float or str
            Such as 0.5 or "1/3".
        field : str
            Its name in the scene, for error messages.

        Returns
        -------
        float

        Raises
        ------
        SceneError
            If the formula has variables, or the value is out of range.
        FormulaError
            If it is no number or formula.

        Examples
        --------
        >>> Parameter(1.0, least=0.0).read("1/4", "truth.parameters.alpha")
        0.25
        """
        formula = Formula(given, field)
        # Evaluating a formula imports numpy, which a plain number does not need.
        value = float(given) if isinstance(given, int | float) else formula.constant
        if value is None:
            raise SceneError(f"{field}: {given!r} is not constant; write a number")
        if value < self.least or (self.open and value == self.least):
            bound = f"{'>' if self.open else '>='} {self.least:g}"
            raise SceneError(f"{field}: {value:g} is not valid; it must be {bound}")
        return value


@dataclass(frozen=True)
class Family:
    """A family of exact solutions with contact at the bottom of the body.

    Parameters
    ----------
    title : str
        The solution in one line.
    parameters : dict of str to Parameter
    build : callable
        From the parameters, by name, to an `ExactSolution`.

    Examples
    --------
    >>> sorted(FAMILIES["punch"].parameters)
    ['half_width', 'x0', 'y0']
    """

    title: str
    parameters: dict[str, Parameter]
    build: Callable


def family(name, parameters=None, field="truth"):
    """Build a named exact solution.

    Parameters
    ----------
    name : str
        One of `FAMILIES`.
    parameters : dict, optional
        Some of the family's parameters, each a number or a constant formula; the others have
        defaults.
    field : str
        Where the scene says so, for error messages.

    Returns
    -------
    ExactSolution

    Raises
    ------
    SceneError
        If the family or a parameter is unknown, or a value is out of range or not constant.
    FormulaError
        If a value is no number or formula.

    Examples
    --------
    >>> exact = family("punch", {"half_width": "1/3"})
    >>> float(exact.value(0.1, -0.0)), float(exact.flux(0.0, 0.0, 0.0, -1.0))
    (0.0, 0.3333333333333333)
    """
    if name not in FAMILIES:
        raise SceneError(f"{field}.family: unknown family {name[:60]!r}; {nearest(name, FAMILIES)}")
    known, given = FAMILIES[name].parameters, parameters or {}
    for key in given:
        if key not in known:
            raise SceneError(
                f"{field}.parameters: {name} has no parameter {key[:60]!r}; {nearest(key, known)}"
            )
    values = {
        key: parameter.read(given.get(key, parameter.default), f"{field}.parameters.{key}")
        for key, parameter in known.items()
    }
    return FAMILIES[name].build(**values)


def read_exact(truth, coefficient=None, field="truth"):
    """Build the exact solution that the section ``truth`` of a scene describes.

    Parameters
    ----------
    truth : dict
        Either ``u``, a formula, with ``critical_points`` and ``singular_points``, lists of [x, y],
        where it has some (singular ones default to the critical ones), and perhaps with
        ``multiplier``, a formula; or ``family``, a name, with
        ``parameters``.
    coefficient : Formula, optional
        Diffusion coefficient, 1 where not given.
    field : str
        For error messages.

    Returns
    -------
    ExactSolution

    Raises
    ------
    SceneError
        If neither or both of u and family are there, or the family, a parameter or the coefficient
        is not valid.
    FormulaError
        If a formula is not valid.

    Examples
    --------
    >>> exact = read_exact({"u": "x*y"}, Formula("1 + x"))
    >>> float(exact.load(2.0, 3.0))
    -3.0
    """
    if ("u" in truth) == ("family" in truth):
        raise SceneError(
            f"{field}: an exact solution needs either u, a formula, or family, a name; "
            "give one of them"
        )
    if "family" in truth:
        exact = family(truth["family"], truth.get("parameters"), field)
    else:
        critical = _points(truth, "critical_points")
        singular = _points(truth, "singular_points") or critical
        multiplier = None
        if "multiplier" in truth:
            multiplier = Formula(truth["multiplier"], f"{field}.multiplier")
        u = Formula(truth["u"], f"{field}.u")
        exact = FormulaSolution(u, None, critical, singular, multiplier)
    return with_coefficient(exact, coefficient)


def _points(truth, key):
    return tuple((float(x), float(y)) for x, y in truth.get(key) or ())


def _corner(**parameters):
    from signorini.exact.harmonic import Corner

    return Corner(**parameters)


def _punch(**parameters):
    from signorini.exact.harmonic import Punch

    return Punch(**parameters)


def _annulus(half_angle, load, press):
    from signorini.exact.annulus import Annulus

    if half_angle >= math.pi:
        raise SceneError(
            f"truth.parameters.half_angle: {half_angle:g} is not valid; it must be < pi"
        )
    return Annulus(half_angle, load, press)


def _from_text(u, obstacle, critical_points=()):
    obstacle = Formula(obstacle, "truth.obstacle")
    return FormulaSolution(Formula(u, "truth.u"), obstacle, critical_points)


_BUMP = "0.1*sin(3*x)"


def _smooth(x0):
    lifted = f"({_BUMP} + 8*pos(x - ({x0!r}))**3)*(1 - y**2)"
    pressed = f"y*(1 - y)*8*pos({x0!r} - x)**3"
    return _from_text(f"{lifted} - {pressed}", _BUMP, ((x0, 0.0),))


def _biactive(left, right):
    if left > right:
        raise SceneError(
            f"truth.parameters.left: {left:g} is not valid; it must be <= right = {right:g}"
        )
    lifted = f"({_BUMP} + 20*pos(x - ({right!r}))**3)*(1 - y**2)"
    pressed = f"y*(1 - y)*20*pos({left!r} - x)**3"
    # No critical point is named: any point of the interval serves, and the mesh decides which one a
    # solution takes.
    return _from_text(f"{lifted} - {pressed}", _BUMP)


def _uniform_load(c, alpha):
    no_contact = f"({c!r})*(1 - y**2)/2"
    full_contact = f"({c!r})*y*(1 - y)/2 + ({alpha!r})*(1 - y)"
    return _from_text(no_contact if alpha <= c / 2 else full_contact, repr(alpha))


def _patch(alpha):
    return _from_text(f"({alpha!r})*(1 - y)", repr(alpha))


_PLACE = {
    "x0": Parameter(0.0, meaning="abscissa"),
    "y0": Parameter(0.0, meaning="ordinate of the contact side"),
}

FAMILIES = {
    "corner": Family(
        "amplitude r^(3/2) cos(3 theta/2) about the critical point (x0, y0); f = 0",
        {"amplitude": Parameter(1.0, 0.0, True, "factor of u"), **_PLACE},
        _corner,
    ),
    "punch": Family(
        "contact for |x - x0| <= half_width, where du/dnu = sqrt(half_width^2 - (x - x0)^2); f = 0",
        {"half_width": Parameter(1.0, 0.0, True, "half the length of the contact zone"), **_PLACE},
        _punch,
    ),
    "annulus": Family(
        "within the unit circle, contact up to the angle half_angle from its lowest point; there, "
        "at the angle t, du/dnu = 2 press cos(t/2) sqrt(2 (cos t - cos half_angle)); f = load",
        {
            "half_angle": Parameter(1.0, 0.0, True, "half the angle of the contact zone"),
            "load": Parameter(-1.0, meaning="f"),
            "press": Parameter(1.0, 0.0, True, "factor of the contact force"),
        },
        _annulus,
    ),
    "smooth": Family(
        "twice differentiable, one critical point (x0, 0), obstacle 0.1 sin 3x",
        {"x0": Parameter(0.5, meaning="abscissa of the critical point")},
        _smooth,
    ),
    "biactive": Family(
        "u = obstacle and du/dnu = 0 for left <= x <= right on y = 0, obstacle 0.1 sin 3x",
        {
            "left": Parameter(0.3, meaning="end of du/dnu > 0"),
            "right": Parameter(0.7, meaning="end of contact"),
        },
        _biactive,
    ),
    "uniform-load": Family(
        "0 <= y <= 1 under the load c: no contact for alpha < c/2, full contact for alpha > c/2",
        {"c": Parameter(1.0, meaning="load"), "alpha": Parameter(0.0, meaning="obstacle")},
        _uniform_load,
    ),
    "patch": Family(
        "u = alpha (1 - y), full contact at y = 0: exact to round-off for every element",
        {"alpha": Parameter(1.0, 0.0, meaning="obstacle")},
        _patch,
    ),
}
