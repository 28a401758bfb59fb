"""Checks of curved sides, the key ``domain.boundary_shape``."""

from signorini.exceptions import SceneError
from signorini.wording import nearest


def check_shapes(domain, names):
    """Check that curved sides are parts of the boundary, and their curves some.

    Parameters
    ----------
    domain : dict
        The section of a scene.
    names : sequence of str or None
        The parts of its boundary, where they are known.

    Raises
    ------
    SceneError, MeshError, FormulaError
        Naming the side, what is wrong with it, and the remedy.
    """
    shapes = domain.get("boundary_shape", {})
    for name in shapes:
        if names is not None and name not in names:
            raise SceneError(
                f"domain.boundary_shape.{name}: the domain has no such part; {nearest(name, names)}"
            )
    if shapes:
        from signorini.mesh.domain import read_curves

        read_curves(shapes)


def refuse_shapes(domain):
    """Refuse curved sides where the truth is a reference.

    Parameters
    ----------
    domain : dict
        The section of a scene.

    Raises
    ------
    SceneError
        With the reason.
    """
    if "boundary_shape" in domain:
        raise SceneError(
            "domain.boundary_shape: the levels of a curved side do not nest in a reference; "
            "use an exact truth or none, or drop it"
        )
