"""What holds where on the boundary: labels given to whole parts of it, by name or by the sign of a
formula.
"""

import difflib
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from signorini.exceptions import MeshError
from signorini.mesh.boundary import LABELS, SIDES
from signorini.mesh.facets import pair_keys, unique_facets
from signorini.mesh.triangulation import Triangulation
from signorini.wording import listed

_SHOWN = 5


@dataclass(frozen=True, eq=False)
class NamedMesh:
    """A triangulation whose boundary has named parts, not yet labelled.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, in the user's unit of length.
    t : ndarray of int, shape (3, nt)
        Vertices of each triangle, counterclockwise.
    parts : dict of str to ndarray of int, shape (2, k)
        End vertices of the facets in each named part of the boundary; parts may share facets.
    regions : dict of str to ndarray of int
        Triangles in each named part of the domain.
    source : str
        Where the mesh comes from, for messages.
    note : str
        Why parts may be missing, for messages; empty if nothing is known.
    """

    p: np.ndarray
    t: np.ndarray
    parts: dict = field(default_factory=dict)
    regions: dict = field(default_factory=dict)
    source: str = "mesh"
    note: str = ""

    @cached_property
    def _facets(self):
        return unique_facets(self.t, self.p.shape[1])

    @property
    def facets(self):
        """End vertices of each facet, shape (2, nf), numbered as scikit-fem does."""
        return self._facets[0]

    @cached_property
    def boundary(self):
        """Facets on the boundary, increasing."""
        return np.flatnonzero(np.bincount(self._facets[1].ravel()) == 1)

    @cached_property
    def midpoints(self):
        """Midpoints of the boundary facets, shape (2, nb)."""
        a, b = self.facets[:, self.boundary]
        return 0.5 * self.p[:, a] + 0.5 * self.p[:, b]

    @property
    def minimum_angle(self):
        """Smallest angle of any triangle, degrees."""
        corners = [self.p[:, v] for v in self.t]
        smallest = np.inf
        for k in range(3):
            u, v = corners[k - 2] - corners[k], corners[k - 1] - corners[k]
            scale = np.abs([u, v]).max()
            u, v = u / scale, v / scale
            angle = np.arctan2(np.abs(u[0] * v[1] - u[1] * v[0]), (u * v).sum(axis=0))
            smallest = min(smallest, float(angle.min()))
        return np.degrees(smallest)


def with_sides(mesh):
    """Add the parts ``bottom``, ``right``, ``top`` and ``left``: facets on the sides of the
    bounding box.

    Both ends of a facet must have the extreme coordinate, exactly: no tolerance, whatever the
    scale.
    """
    ends = mesh.facets[:, mesh.boundary]
    (x0, y0), (x1, y1) = mesh.p.min(axis=1), mesh.p.max(axis=1)
    on = {
        "bottom": mesh.p[1] == y0,
        "right": mesh.p[0] == x1,
        "top": mesh.p[1] == y1,
        "left": mesh.p[0] == x0,
    }
    sides = {side: ends[:, on[side][ends].all(axis=0)] for side in SIDES}
    return replace(mesh, parts=sides | mesh.parts)


def label_boundary(mesh, rules):
    """Give every boundary facet exactly one label.

    Parameters
    ----------
    mesh : NamedMesh
    rules : dict, or iterable of pairs (selector, label)
        A selector is the name of a part, or a function of (x, y) such as a `Formula`: it selects
        the boundary facets at whose midpoints it is positive. A label is ``"dirichlet"``,
        ``"contact"`` or ``"neumann"``.

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
    labels, taken = {}, []
    for selector, label in rules.items() if isinstance(rules, dict) else rules:
        if label not in LABELS:
            known = ", ".join(LABELS)
            raise MeshError(
                f"boundary: unknown label {_quoted(str(label))} for {_named(selector)}; known: {known}"
            )
        selected = (
            _by_formula(mesh, selector) if callable(selector) else _by_part(mesh, str(selector))
        )
        labels[label] = labels.get(label, False) | selected
        taken.append((selector, label, selected))
    times = np.sum([np.zeros(mesh.boundary.size, dtype=int), *labels.values()], axis=0)
    if np.any(times == 0):
        raise MeshError(_complaint(mesh, times == 0, "no label"))
    if np.any(times > 1):
        raise MeshError(
            _complaint(
                mesh, times > 1, "more than one label", _overlap(taken, int(np.argmax(times > 1)))
            )
        )
    return {label: mesh.boundary[selected] for label, selected in labels.items()}


def labelled(mesh, rules):
    """The `Triangulation` of a mesh whose boundary is labelled by rules; see `label_boundary`."""
    return Triangulation(mesh.p, mesh.t, labelled_ends(mesh, rules), mesh.regions)


def labelled_ends(mesh, rules):
    """As `label_boundary`, but for each label the end vertices of its facets, shape (2, k)."""
    return {label: mesh.facets[:, facets] for label, facets in label_boundary(mesh, rules).items()}


def _by_formula(mesh, formula):
    selected = np.asarray(formula(*mesh.midpoints)) > 0
    if not np.any(selected):
        raise MeshError(
            f"boundary: {_named(formula)} is positive at no boundary facet's midpoint; correct or drop it"
        )
    return np.broadcast_to(selected, mesh.boundary.shape)


def _by_part(mesh, name):
    if name not in mesh.parts:
        raise MeshError(
            f"boundary: {mesh.source} has no part {_quoted(name)}; {_missing(mesh, name)}"
        )
    count = mesh.p.shape[1]
    keys, part = pair_keys(mesh.facets, count), mesh.parts[name]
    wanted = np.where(part.min(axis=0) >= 0, pair_keys(part, count), -1)
    found = np.isin(wanted, keys[mesh.boundary])
    if not found.all():
        k = np.argmin(found)
        ends = (
            [f"({x:.6g}, {y:.6g})" for x, y in mesh.p[:, mesh.parts[name][:, k]].T]
            if wanted[k] >= 0
            else ["a vertex", "another"]
        )
        why = "lies inside the domain" if wanted[k] in keys else "is no side of a triangle"
        line = f"the line {ends[0]} to {ends[1]}"
        raise MeshError(f"boundary: part {_quoted(name)}: {line} {why}; take it out of the part")
    return np.isin(keys[mesh.boundary], wanted)


def _missing(mesh, name):
    """Which parts there are instead of the one that is asked for."""
    if mesh.note:
        return mesh.note
    near = [part for part in (f"name={name}", f"number={name}") if part in mesh.parts]
    near = near or difflib.get_close_matches(name[:200], mesh.parts, n=1)
    hint = f"; did you mean {' or '.join(near)}?" if near else ""
    formula = (
        f"; or give {name} a formula, and every other label one"
        if name in LABELS and not near
        else ""
    )
    return f"its parts: {listed(mesh.parts) or 'none'}{hint}{formula}"


def _overlap(taken, k):
    """The rules that give different labels to one facet of the boundary, by its position there."""
    given = [f"{_named(selector)} is {label}" for selector, label, selected in taken if selected[k]]
    return f"; they overlap: at the first, {' and '.join(given[:4])}"


def _complaint(mesh, wrong, count, why=""):
    numbers, (x, y) = mesh.boundary[wrong], mesh.midpoints[:, wrong]
    places = list(zip(numbers, x, y, strict=True))[:_SHOWN]
    facets = ", ".join(f"{k} at ({a:.6g}, {b:.6g})" for k, a, b in places)
    more = f" and {numbers.size - _SHOWN} more" if numbers.size > _SHOWN else ""
    parts = f"; parts: {listed(mesh.parts, 20)}" if mesh.parts else ""
    wrong = f"{numbers.size} boundary facets of {mesh.source} have {count}"
    return f"boundary: {wrong}: facet {facets}{more}{why}; each needs exactly one of {', '.join(LABELS)}{parts}"


def _named(selector):
    if callable(selector):
        return f"the formula {_quoted(getattr(selector, 'text', str(selector)))}"
    return f"part {_quoted(str(selector))}"


def _quoted(text):
    return repr(text if len(text) <= 60 else f"{text[:57]}...")
