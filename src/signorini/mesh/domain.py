"""The domain of a scene: what every level of its triangulations is made from.

A `Rectangle` is cut anew at every level. Any other domain is triangulated once, its root, and every
level is a uniform refinement of it, see `Refined`.
"""

import json
from dataclasses import asdict

import numpy as np

from signorini.mesh.boundary import LABELS, by_formula
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
        mesh width there, and ``rest`` the label of the facets in no part that `boundary` names.
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
    if domain.get("kind", "rectangle") == "rectangle":
        keys = ("origin", "size", "diagonal", "cells")
        altered = {key: domain[key] for key in ("grade", "perturb") if key in domain}
        return Rectangle(**{key: domain[key] for key in keys}, boundary=boundary, **altered)
    from signorini.mesh.labels import labelled
    from signorini.mesh.rules import boundary_rules

    if domain["kind"] == "given":
        root = labelled(domain["mesh"], boundary, domain["rest"], keep=boundary)
        return Refined(root, coarsest, domain["width"])
    mesh = root_mesh(domain, coarsest)
    width = longest_edge(mesh) if domain["kind"] == "mesh" else 1.0 / coarsest
    root = labelled(mesh, boundary_rules(boundary))
    return Refined(root, coarsest, width, boundary if by_formula(boundary) else None)


def root_mesh(domain, coarsest):
    """The root of a domain that is no rectangle, not yet labelled: a `NamedMesh`.

    Parameters
    ----------
    domain, coarsest
        See `make_domain`, also for what is raised.

    Returns
    -------
    NamedMesh
    """
    if domain["kind"] == "mesh":
        from signorini.mesh.imported import import_mesh

        mesh = import_mesh(domain["file"])
    else:
        from signorini.mesh.polygon import triangulate

        sides = domain.get("sides")
        mesh = triangulate(domain["corners"], domain["holes"], 1.0 / coarsest, sides)
    if "perturb" in domain:
        from signorini.mesh.patterns import perturbed

        mesh = perturbed(mesh, domain["perturb"]["amount"], domain["perturb"]["seed"])
    return mesh


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
    """
    arrays = read_npz(path, kind="domain")
    fields = json.loads(str(arrays["specification"]))
    if fields.pop("kind") == "rectangle":
        return Rectangle(**fields)
    from signorini.mesh.triangulation import Triangulation

    ends = {label: arrays[label] for label in LABELS if label in arrays}
    names = fields.pop("subdomains")
    subdomains = {name: arrays[f"subdomain_{k}"] for k, name in enumerate(names)}
    return Refined(Triangulation(arrays["p"], arrays["t"], ends, subdomains), **fields)
