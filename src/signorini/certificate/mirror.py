"""Data of a constraint from above, as those of -u, whose constraint is from below."""

from dataclasses import dataclass, replace

from signorini.fem.by_part import ByPart

_SIGNED = ("f", "g", "dirichlet", "obstacle", "contact_flux")


@dataclass(frozen=True)
class Negated:
    """A datum with the opposite sign, called as the datum is."""

    datum: object

    @property
    def field(self):
        """Its name, for messages."""
        return self.datum.field

    @property
    def constant(self):
        """Its value where it is known to be the same everywhere."""
        return None if self.datum.constant is None else -self.datum.constant

    @property
    def needs_normal(self):
        """Whether it is called with the outward normal."""
        return getattr(self.datum, "needs_normal", False)

    def __call__(self, *place, **options):
        """Evaluate at points."""
        return -self.datum(*place, **options)


def mirrored(data):
    """The data for -u; see `fem.mirror`.

    Parameters
    ----------
    data : Data

    Returns
    -------
    Data

    Examples
    --------
    >>> from signorini import load_scene
    >>> data = load_scene("config/scenes/paper.yaml").problem_statement.data
    >>> float(mirrored(data).f(0.25, 0.0) + data.f(0.25, 0.0))
    0.0
    """
    signed = {name: _negated(getattr(data, name)) for name in _SIGNED}
    return replace(data, **signed, constraint="lower" if data.constraint == "upper" else "upper")


def _negated(datum):
    if isinstance(datum, ByPart):
        return ByPart({name: Negated(own) for name, own in datum.parts.items()}, datum.field)
    return Negated(datum)
