"""Data that a program gives part by part: each part there is, and on it holds what they are for."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from signorini.api.arguments import read_names
from signorini.exceptions import SceneError
from signorini.mesh.boundary import LABELS, PART, SIDES
from signorini.mesh.grid import Grid

# Datum -> the label of the parts that it acts on.
_LABELS = {
    "dirichlet": "dirichlet",
    "g": "neumann",
    "obstacle": "contact",
    "contact_flux": "contact",
}


def labels_of_parts(mesh: Any) -> dict[str, str]:
    """Part of the boundary of a `Grid` or `Triangulation` -> its label.

    Examples
    --------
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> labels_of_parts(Grid(2, 1, (0.0, 0.0), (2.0, 1.0), "falling", labels))
    {'bottom': 'contact', 'right': 'neumann', 'top': 'dirichlet', 'left': 'neumann'}
    """
    if isinstance(mesh, Grid):
        return dict(zip(SIDES, mesh.labels, strict=True))
    labelled = {label: mesh.boundary_facets(label) for label in LABELS}
    parts = {key: mesh.boundary_facets(key) for key in mesh.ends if key.startswith(PART)}
    return {
        key.removeprefix(PART): label
        for key, facets in parts.items()
        for label, known in labelled.items()
        if np.isin(facets, known).all()
    }


def check_part_names(known: Any, **given: Any) -> None:
    """Refuse a datum of a part of the boundary that is not there.

    Parameters
    ----------
    known : iterable of str
        The parts that there are.
    **given : datum, or dict of part of the boundary to datum
        By argument; what is no dict is not looked at.

    Raises
    ------
    SceneError
        Naming the argument, the part and those that there are.

    Examples
    --------
    >>> check_part_names(["bottom", "top"], obstacle={"botom": 1})
    Traceback (most recent call last):
    signorini.exceptions.SceneError: obstacle: the boundary has no part 'botom'; did you ...
    """
    for field, value in given.items():
        if isinstance(value, Mapping):
            read_names(list(value), field, known)


def check_part_labels(labels: Mapping[str, str], **given: Any) -> None:
    """Refuse a datum on a part of the boundary where something else holds.

    Parameters
    ----------
    labels : dict
        Part of the boundary -> its label.
    **given : datum, or dict of part of the boundary to datum
        By argument, of dirichlet, g, obstacle and contact_flux.

    Raises
    ------
    SceneError
        Naming the argument and the part.

    Examples
    --------
    >>> check_part_labels({"bottom": "contact"}, obstacle={"right": 1})
    Traceback (most recent call last):
    signorini.exceptions.SceneError: obstacle: 'right' is not in contact; name it in contact, ...
    """
    for field, value in given.items():
        label = _LABELS[field]
        for name in value if isinstance(value, Mapping) else ():
            if labels.get(name) != label:
                raise SceneError(
                    f"{field}: {name!r} is not in {label}; name it in {label}, or leave it out"
                )
