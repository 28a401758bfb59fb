"""Guaranteed bounds of a scene: whether it asks for them, and whether they can be had.

Nothing here imports NumPy.
"""

from signorini.exceptions import SceneError


def is_certified(document):
    """Whether a scene asks for guaranteed bounds.

    Parameters
    ----------
    document : dict

    Returns
    -------
    bool

    Examples
    --------
    >>> is_certified({"truth": {"kind": "certificate"}, "certificate": False})
    True
    """
    return document["truth"]["kind"] == "certificate" or document["certificate"]


def is_certifiable(document):
    """Whether guaranteed bounds can be had: the triangles fill the body.

    Parameters
    ----------
    document : dict

    Returns
    -------
    bool

    Examples
    --------
    >>> from signorini.scene.read import read_scene
    >>> names = ("l-shape", "annulus")
    >>> [is_certifiable(read_scene(f"config/scenes/{name}.yaml").document) for name in names]
    [True, False]
    """
    return not document["domain"].get("boundary_shape")


def check_certifiable(document, asked):
    """Refuse what has no guaranteed bounds.

    Parameters
    ----------
    document : dict
    asked : str
        Where they are asked for: a field of the scene, or an option.

    Raises
    ------
    SceneError
        If the triangles do not fill the body.
    """
    if not is_certifiable(document):
        raise SceneError(
            f"{asked}: the triangles do not fill a body with domain.boundary_shape, so that "
            "nothing of it is certified; drop one of the two"
        )
