"""What holds where on the boundary: labels by the names of parts or by the sign of a formula."""

import difflib

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.boundary import LABELS, offered, part_key
from signorini.mesh.facets import pair_keys
from signorini.mesh.geometry import point_text
from signorini.mesh.triangulation import Triangulation
from signorini.wording import listed

_FACETS_SHOWN = 5
_PARTS_SHOWN = 20
_RULES_SHOWN = 4
_LONGEST_NAME = 60


def label_boundary(mesh, rules, rest=None):
    """Give every boundary facet exactly one label.

    Parameters
    ----------
    mesh : NamedMesh
    rules : dict, or iterable of pairs (selector, label)
        A selector is the name of a part, or a function of (x, y) such as a `Formula`: it selects
        the boundary facets at whose midpoints it is positive. A label is ``"dirichlet"``,
        ``"contact"`` or ``"neumann"``.
    rest : str, optional
        The label of the facets that no rule selects; without it they are refused.

    Returns
    -------
    dict of str to ndarray of int
        Label -> its facets, increasing, for each label that a rule mentions.

    Raises
    ------
    MeshError
        An unknown part or label; a rule that selects nothing; a part with facets inside the domain;
        facets with no label, or with two.

    Examples
    --------
    >>> from signorini.mesh.patterns import criss_cross
    >>> mesh = criss_cross(2, 1, (0, 0), (2, 1))
    >>> rules = [("bottom", "contact"), ("top", "dirichlet"), (lambda x, y: y * (1 - y), "neumann")]
    >>> [(label, facets.size) for label, facets in label_boundary(mesh, rules).items()]
    [('contact', 2), ('dirichlet', 2), ('neumann', 2)]
    """
    selections = []
    for selector, label in rules.items() if isinstance(rules, dict) else rules:
        _check_label(selector, label)
        selections.append((selector, label, _selected(mesh, selector)))
    carries = {}
    for _, label, selected in selections:
        carries[label] = carries.get(label, False) | selected
    if rest is not None:
        carries[rest] = carries.get(rest, False) | ~_taken(mesh, carries)
    _check_each_once(mesh, carries, selections)
    return {label: mesh.boundary[selected] for label, selected in carries.items()}


def labelled(mesh, rules, rest=None, keep=(), curves=None):
    """The `Triangulation` of a mesh whose boundary is labelled.

    Parameters
    ----------
    mesh : NamedMesh
    rules : dict, or iterable of pairs (selector, label)
        See `label_boundary`, also for what is raised.
    rest : str, optional
        See `label_boundary`.
    keep : iterable of str, optional
        Parts whose facets the triangulation and its refinements know by their `part_key`.
    curves : dict of str to Circle or LevelSet, optional
        Those among `keep` that are curved.

    Returns
    -------
    Triangulation

    Examples
    --------
    >>> from signorini.mesh.patterns import criss_cross
    >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
    >>> mesh = labelled(criss_cross(2, 1, (0, 0), (2, 1)), sides)
    >>> mesh.number_of_triangles, mesh.boundary_facets("contact").size
    (8, 2)
    """
    ends = labelled_ends(mesh, rules, rest)
    for name in keep:
        ends[part_key(name)] = mesh.facets[:, mesh.boundary[_selected(mesh, name)]]
    return Triangulation(mesh.p, mesh.t, ends, mesh.subdomains, curves=curves or {})


def labelled_ends(mesh, rules, rest=None):
    """As `label_boundary`, but with the end vertices of the facets.

    Parameters
    ----------
    mesh : NamedMesh
    rules : dict, or iterable of pairs (selector, label)
        See `label_boundary`, also for what is raised.
    rest : str, optional
        See `label_boundary`.

    Returns
    -------
    dict of str to ndarray of int, shape (2, k)

    Examples
    --------
    >>> from signorini.mesh.patterns import criss_cross
    >>> mesh = criss_cross(2, 1, (0, 0), (2, 1))
    >>> ends = labelled_ends(mesh, {"bottom": "contact"}, rest="neumann")
    >>> ends["contact"].T.tolist(), ends["neumann"].shape
    ([[0, 1], [1, 2]], (2, 4))
    """
    carries = label_boundary(mesh, rules, rest)
    return {label: mesh.facets[:, facets] for label, facets in carries.items()}


def _check_label(selector, label):
    if label not in LABELS:
        raise MeshError(
            f"boundary: unknown label {_quoted(str(label))} for {_rule_text(selector)}; "
            f"known: {', '.join(LABELS)}"
        )


def _selected(mesh, selector):
    """Whether a rule selects each boundary facet, shape (nb,)."""
    if callable(selector):
        return _selected_by_formula(mesh, selector)
    return _selected_by_part(mesh, str(selector))


def _selected_by_formula(mesh, formula):
    selected = np.asarray(formula(*mesh.midpoints)) > 0
    if not np.any(selected):
        raise MeshError(
            f"boundary: {_rule_text(formula)} is positive at no boundary facet's midpoint; "
            "correct or drop it"
        )
    return np.broadcast_to(selected, mesh.boundary.shape)


def _selected_by_part(mesh, name):
    if name not in mesh.parts:
        raise MeshError(
            f"boundary: {mesh.source} has no part {_quoted(name)}; {_known_parts(mesh, name)}"
        )
    count = mesh.p.shape[1]
    facet_keys, part = pair_keys(mesh.facets, count), mesh.parts[name]
    # A dropped vertex has the number -1.
    part_keys = np.where(part.min(axis=0) >= 0, pair_keys(part, count), -1)
    on_boundary = np.isin(part_keys, facet_keys[mesh.boundary])
    if not on_boundary.all():
        k = np.argmin(on_boundary)
        ends = [point_text(mesh.p, v) for v in part[:, k]] if part_keys[k] >= 0 else _UNKNOWN_ENDS
        inside = part_keys[k] in facet_keys
        why = "lies inside the domain" if inside else "is no side of a triangle"
        raise MeshError(
            f"boundary: part {_quoted(name)}: the line {ends[0]} to {ends[1]} {why}; "
            "take it out of the part"
        )
    return np.isin(facet_keys[mesh.boundary], part_keys)


_UNKNOWN_ENDS = ("a vertex", "another")


def _known_parts(mesh, name):
    """Which parts there are instead of the one that is asked for."""
    if mesh.note:
        return mesh.note
    near = [part for part in (f"name={name}", f"number={name}") if part in mesh.parts]
    near = near or difflib.get_close_matches(name[:200], mesh.parts, n=1)
    known = f"its parts: {listed(offered(mesh.parts)) or 'none'}"
    if near:
        return f"{known}; did you mean {' or '.join(near)}?"
    if name in LABELS:
        return f"{known}; or give {name} a formula, and every other label one"
    return known


def _taken(mesh, carries):
    """Whether some label is carried by each boundary facet, shape (nb,)."""
    return np.any([np.zeros(mesh.boundary.size, dtype=bool), *carries.values()], axis=0)


def _check_each_once(mesh, carries, selections):
    """Refuse boundary facets without label or with two; `carries` is label -> its facets."""
    times = np.sum([np.zeros(mesh.boundary.size, dtype=int), *carries.values()], axis=0)
    if np.any(times == 0):
        raise MeshError(_complaint(mesh, times == 0, "no label"))
    several = times > 1
    if np.any(several):
        overlap = _overlap(selections, int(np.argmax(several)))
        raise MeshError(_complaint(mesh, several, "more than one label", overlap))


def _overlap(selections, k):
    """The rules that give different labels to one facet of the boundary, by its position there."""
    rules = [
        f"{_rule_text(selector)} is {label}"
        for selector, label, selected in selections
        if selected[k]
    ]
    return f"; they overlap: at the first, {' and '.join(rules[:_RULES_SHOWN])}"


def _complaint(mesh, wrong, count, why=""):
    numbers, (x, y) = mesh.boundary[wrong], mesh.midpoints[:, wrong]
    places = list(zip(numbers, x, y, strict=True))[:_FACETS_SHOWN]
    facets = ", ".join(f"{k} at ({a:.6g}, {b:.6g})" for k, a, b in places)
    hidden = numbers.size - _FACETS_SHOWN
    more = f" and {hidden} more" if hidden > 0 else ""
    parts = f"; parts: {listed(mesh.parts, _PARTS_SHOWN)}" if mesh.parts else ""
    return (
        f"boundary: {numbers.size} boundary facets of {mesh.source} have {count}: "
        f"facet {facets}{more}{why}; each needs exactly one of {', '.join(LABELS)}{parts}"
    )


def _rule_text(selector):
    if callable(selector):
        return f"the formula {_quoted(getattr(selector, 'text', str(selector)))}"
    return f"part {_quoted(str(selector))}"


def _quoted(text):
    return repr(text if len(text) <= _LONGEST_NAME else f"{text[: _LONGEST_NAME - 3]}...")
