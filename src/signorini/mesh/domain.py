"""The domain of a scene: what every level of its triangulations is made from.

A `Rectangle` is cut anew at every level. Any other domain is triangulated once, its root, and every
level is a uniform refinement of it, see `Refined`.
"""

import json
from dataclasses import asdict

import numpy as np

from signorini.mesh.boundary import LABELS, by_formula, part_key
from signorini.mesh.curved import with_curved_sides
from signorini.mesh.rectangle import Rectangle
from signorini.mesh.refined import Refined
from signorini.storage import read_npz, write_npz


def make_domain(domain, boundary, coarsest):
    """Build a domain from the sections ``domain`` and ``boundary`` of a scene.

    Parameters
    ----------
    domain, boundary : dict
        Validated, defaults filled in, a mesh file's path resolved. Besides the kinds of a scene
        there is ``"given"``: its ``mesh`` is a `NamedMesh` of level `coarsest`, its ``width`` the
        mesh width there, ``rest`` the label of the facets in no part that `boundary` names, and
        ``curves``, if there are any, the curves of parts, as of `read_curves`.
    coarsest : int
        The coarsest level: that of the root where there is one.

    Returns
    -------
    Rectangle or Refined

    Raises
    ------
    MeshError
        If the domain cannot be triangulated or its boundary not be labelled.

    Examples
    --------
    >>> section = {"origin": [0, 0], "size": [1, 1], "diagonal": "falling", "cells": "per-unit"}
    >>> sides = {"bottom": "contact", "right": "neumann", "top": "dirichlet", "left": "neumann"}
    >>> domain = make_domain(section, sides, coarsest=2)
    >>> domain.level(4).number_of_triangles, domain.mesh_size(4)
    (32, 0.25)
    """
    kind = domain.get("kind", "rectangle")
    return _MAKERS.get(kind, _triangulated_once)(domain, boundary, coarsest)


def _rectangle(domain, boundary, _):
    keys = ("origin", "size", "diagonal", "cells")
    altered = {key: domain[key] for key in ("grade", "perturb") if key in domain}
    return Rectangle(**{key: domain[key] for key in keys}, boundary=boundary, **altered)


def _given(domain, boundary, coarsest):
    from signorini.mesh.labels import labelled

    curves = domain.get("curves", {})
    keep = dict.fromkeys([*boundary, *curves])
    root = labelled(domain["mesh"], boundary, domain["rest"], keep=keep, curves=curves)
    return Refined(root, coarsest, domain["width"])


def _triangulated_once(domain, boundary, coarsest):
    """A polygon or a mesh file."""
    from signorini.mesh.labels import labelled
    from signorini.mesh.rules import boundary_rules

    curves = read_curves(domain.get("boundary_shape", {}))
    mesh = root_mesh(domain, coarsest, curves)
    width = longest_edge(mesh) if domain["kind"] == "mesh" else 1.0 / coarsest
    root = labelled(mesh, boundary_rules(boundary), keep=curves, curves=curves)
    return Refined(root, coarsest, width, boundary if by_formula(boundary) else None)


_MAKERS = {"rectangle": _rectangle, "given": _given}


def root_mesh(domain, coarsest, curves=None):
    """The root of a domain that is no rectangle, not yet labelled: a `NamedMesh`.

    Parameters
    ----------
    domain, coarsest
        See `make_domain`, also for what is raised.
    curves : dict of str to Circle or LevelSet, optional
        Of the parts of the boundary that are curved.

    Returns
    -------
    NamedMesh
    """
    if domain["kind"] == "mesh":
        from signorini.mesh.imported import import_mesh

        mesh = import_mesh(domain["file"])
    else:
        mesh = _triangulated(domain, 1.0 / coarsest, curves)
    if "perturb" in domain:
        from signorini.mesh.patterns import perturbed

        mesh = perturbed(mesh, domain["perturb"]["amount"], domain["perturb"]["seed"])
    return with_curved_sides(mesh, curves) if curves else mesh


def _triangulated(domain, size, curves):
    """The triangulation of a polygon, or of what its curved sides make of it."""
    if curves:
        from signorini.mesh.arcs import triangulate_curved

        return triangulate_curved(domain, size, curves)
    from signorini.mesh.polygon import triangulate

    return triangulate(domain["corners"], domain["holes"], size, domain.get("sides"))


def longest_edge(mesh):
    """The length of the longest edge of a mesh, unit of length.

    Parameters
    ----------
    mesh : Grid, Triangulation or NamedMesh

    Returns
    -------
    float

    Examples
    --------
    >>> from signorini.mesh.patterns import criss_cross
    >>> longest_edge(criss_cross(2, 2, (0, 0), (1, 1)))
    0.5
    """
    a, b = mesh.facets
    return float(np.hypot(*(mesh.p[:, a] - mesh.p[:, b])).max())


def write_domain(path, domain):
    """Store a domain with the arrays of its root, if it has one.

    Parameters
    ----------
    path : str or Path
        Of an .npz file.
    domain : Rectangle or Refined
    """
    if isinstance(domain, Rectangle):
        specification = {"kind": "rectangle"} | asdict(domain)
        write_npz(path, kind="domain", specification=json.dumps(specification))
        return
    root = domain.root
    specification = {
        "kind": "refined",
        "coarsest": domain.coarsest,
        "width": domain.width,
        "boundary": domain.boundary,
        "subdomains": list(root.subdomains),
    }
    if root.curves:
        curves = {name: curve.section for name, curve in root.curves.items()}
        specification["curves"] = curves
    subdomains = {f"subdomain_{k}": cells for k, cells in enumerate(root.subdomains.values())}
    write_npz(
        path,
        kind="domain",
        specification=json.dumps(specification),
        p=root.p,
        t=root.t,
        **root.ends,
        **subdomains,
    )


def read_domain(path):
    """Read what `write_domain` stored.

    Raises
    ------
    StorageError
        If the file is missing, truncated, altered, or not a domain.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from signorini import load_scene
    >>> domain = load_scene("config/scenes/paper.yaml").problem_statement.triangulations
    >>> with TemporaryDirectory() as folder:
    ...     write_domain(f"{folder}/mesh.npz", domain)
    ...     again = read_domain(f"{folder}/mesh.npz")
    >>> again.boundary == domain.boundary, again.level(4).same_as(domain.level(4))
    (True, True)
    """
    arrays = read_npz(path, kind="domain")
    fields = json.loads(str(arrays["specification"]))
    if fields.pop("kind") == "rectangle":
        return Rectangle(**fields)
    from signorini.mesh.triangulation import Triangulation

    curves = read_curves(fields.pop("curves", {}))
    labels = (*LABELS, *map(part_key, curves))
    ends = {label: arrays[label] for label in labels if label in arrays}
    names = fields.pop("subdomains")
    subdomains = {name: arrays[f"subdomain_{k}"] for k, name in enumerate(names)}
    root = Triangulation(arrays["p"], arrays["t"], ends, subdomains, curves=curves)
    return Refined(root, **fields)


def read_curves(section):
    """The curved parts of a boundary.

    Parameters
    ----------
    section : dict
        Name of a part -> its curve, see `curves.read_curve`.

    Returns
    -------
    dict of str to Circle or LevelSet

    Raises
    ------
    MeshError, FormulaError
        Naming the part.

    Examples
    --------
    >>> read_curves({"rim": {"center": [0, 0], "radius": 1}})
    {'rim': Circle(center=(0.0, 0.0), radius=1.0)}
    """
    if not section:  # no formula is read where there is none
        return {}
    from signorini.mesh.curves import read_curve

    field = "domain.boundary_shape"
    return {name: read_curve(given, f"{field}.{name}") for name, given in section.items()}
