"""`problem`: from a mesh, data and conditions to a discrete problem."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from signorini.api.arguments import (
    described,
    read_coefficient,
    read_datum,
    read_names,
    read_partwise,
)
from signorini.api.domains import as_mesh
from signorini.api.exact import check_functions, read_exact_solution
from signorini.api.meshes import Mesh
from signorini.api.parts import check_part_labels, check_part_names, labels_of_parts
from signorini.api.types import Datum, Names, PartwiseDatum
from signorini.exact import ExactSolution, derived_data, with_coefficient
from signorini.exceptions import SceneError
from signorini.fem.data import Data
from signorini.fem.precision import LOAD_PRECISIONS
from signorini.fem.problem import Problem, discretize, discretize_on
from signorini.formula import Formula
from signorini.mesh.domain import longest_edge
from signorini.mesh.grid import Grid
from signorini.mesh.triangulation import Triangulation
from signorini.scene.statement import ProblemStatement
from signorini.wording import nearest


def problem(
    mesh: Any,
    element: str = "CR",
    *,
    f: Datum | None = None,
    g: PartwiseDatum | None = None,
    obstacle: PartwiseDatum | None = None,
    dirichlet: Names | Mapping[str, Datum] | None = None,
    contact: Names | None = None,
    neumann: Names | None = None,
    coefficient: PartwiseDatum | None = None,
    contact_flux: PartwiseDatum | None = None,
    constraint: str = "lower",
    exact: Any = None,
    load_quadrature: str | int = "exact",
    load_precision: str = "double",
) -> Problem:
    """A discrete Signorini problem.

    Find u with -div(k grad u) = f inside, u given on the Dirichlet part, k du/dnu = g on the
    Neumann part, and on the contact part, with a threshold s of the flux,

        u >= obstacle,  k du/dnu >= s,  (u - obstacle) (k du/dnu - s) = 0.

    A datum is a number, a formula in x and y as text, or a function of two arrays x and y of one
    shape that returns an array of that shape.

    Parameters
    ----------
    mesh : Mesh, skfem.MeshTri, meshio.Mesh, path, or pair of arrays
        See `rectangle`, `polygon` and `triangulation`. A `Grid` or `Triangulation` of the library
        has its labels already: give it neither contact nor neumann, and for dirichlet a datum.
    element : {"CR", "P1"}
        Crouzeix-Raviart or conforming P1.
    f : datum
        Volume force, unit of k u per length squared.
    g : datum, or dict of part of the boundary to datum, optional
        Flux on the Neumann part, unit of k u per length; 0 by default.
    obstacle : datum, or dict of part of the boundary to datum, optional
        Unit of u; 0 by default, also on a part in contact that the dict leaves out. Where two parts
        in contact meet, their values must, too.
    dirichlet : dict of part of the boundary to datum; or names, optional
        Where u is given, and its values there, unit of u; 0 where only names are given.
    contact : str or sequence of str, optional
        The parts of the boundary in contact. Without any it is a Poisson problem.
    neumann : str or sequence of str, optional
        By default all that is left. If named, every facet must be on a part with a condition.
    coefficient : datum, or dict of subdomain to number, optional
        Diffusion coefficient k > 0, taken at the centroid of each triangle; 1 by default.
    contact_flux : datum, or dict of part of the boundary to datum, optional
        The threshold s, unit of k u per length; 0 by default, also on a part in contact that the
        dict leaves out.
    constraint : {"lower", "upper"}, optional
        For upper both inequalities are reversed.
    exact : ExactSolution, str, dict, or pair (u, gradient), optional
        An exact solution, see `exact_solution`: data that are not given are derived from it, those
        that are given are checked against it, and it against Signorini's conditions.
    load_quadrature : str or int, optional
        Rule for the integral of f: exact (to round-off for smooth f), centroid, midpoints,
        vertices, nodal, or a degree.
    load_precision : {"double", "single"}, optional
        For single, the numbers of the load are rounded to 24 bits; all else is double.

    Returns
    -------
    Problem

    Raises
    ------
    SceneError, MeshError, FormulaError
        One line that names the argument, its value and the remedy.

    Notes
    -----
    Functions are integrated by the rule `load_quadrature` on triangles and by five Gauss points on
    facets; nothing of them is differentiated.

    Examples
    --------
    >>> import numpy as np
    >>> import signorini
    >>> problem = signorini.problem(
    ...     signorini.rectangle(16),
    ...     f=lambda x, y: 2 * np.pi * np.sin(2 * np.pi * x),
    ...     dirichlet={"top": 0},
    ...     contact="bottom",
    ... )
    >>> signorini.solve(problem).status
    'solved'
    """
    _check_choices(
        constraint=constraint, load_quadrature=load_quadrature, load_precision=load_precision
    )
    on_contact = {"obstacle": obstacle, "contact_flux": contact_flux}
    load: dict[str, Any] = {"load_quadrature": load_quadrature, "load_precision": load_precision}
    given = _read_data(
        f=f, g=g, obstacle=obstacle, coefficient=coefficient, contact_flux=contact_flux
    )
    given["constraint"] = constraint
    truth = None
    if exact is not None:
        truth = with_coefficient(read_exact_solution(exact), given.get("coefficient"))
    if isinstance(mesh, Grid | Triangulation):
        _refuse_labels(contact=contact, neumann=neumann)
        partwise = {"dirichlet": dirichlet, "g": g} | on_contact
        labels = labels_of_parts(mesh)
        check_part_names(labels, **partwise)
        check_part_labels(labels, **partwise)
        given |= _read_data(dirichlet=dirichlet)
        return _on_labelled(mesh, element, _data(given, truth), load)
    mesh = as_mesh(mesh)
    labels = _labels(mesh, dirichlet, contact, neumann, g)
    check_part_names(mesh.boundaries, **on_contact)
    check_part_labels(labels, **on_contact)
    if isinstance(dirichlet, Mapping):
        given |= _read_data(dirichlet=dirichlet)
    domain, boundary = mesh.labelled(labels, "neumann" if neumann is None else None)
    data = _data(given, truth)
    statement = ProblemStatement(
        domain, boundary, data, coarsest=mesh.coarsest, exact=truth, **load
    )
    found = discretize(statement, element, mesh.n)
    if truth is not None:
        check_functions(truth, found.mesh, data.f)
    return found


_READERS: dict[str, Callable[[Any], Any]] = {
    "f": partial(read_datum, field="f"),
    "g": partial(read_partwise, field="g"),
    "obstacle": partial(read_partwise, field="obstacle"),
    "dirichlet": partial(read_partwise, field="dirichlet"),
    "contact_flux": partial(read_partwise, field="contact_flux"),
    "coefficient": read_coefficient,
}
_CHOICES = {
    "constraint": ("lower", "upper"),
    "load_quadrature": ("exact", "centroid", "midpoints", "vertices", "nodal"),
    "load_precision": tuple(LOAD_PRECISIONS),
}
_DEGREES = range(1, 61)


def _check_choices(**given: str | int) -> None:
    """Refuse what is none of the words that an argument can be."""
    for field, value in given.items():
        is_degree = field == "load_quadrature" and type(value) is int and value in _DEGREES
        if not is_degree and value not in _CHOICES[field]:
            more = ", or a degree from 1 to 60" if field == "load_quadrature" else ""
            known = nearest(value, _CHOICES[field])
            raise SceneError(f"{field}: {described(value)} is not valid; {known}{more}")


def _read_data(**given: Any) -> dict[str, Any]:
    """Those of the data that are given, read."""
    return {name: _READERS[name](value) for name, value in given.items() if value is not None}


def _data(given: dict[str, Any], truth: ExactSolution | None) -> Data:
    """All data: what is not given is derived from the exact solution, or zero."""
    if truth is not None:
        return replace(derived_data(truth), **given)
    if "f" not in given:
        raise SceneError(
            "f: missing; give the volume force, a number, a formula or a function of x and y"
        )
    return Data(**{name: Formula("0", name) for name in ("g", "dirichlet", "obstacle")} | given)


def _labels(
    mesh: Mesh,
    dirichlet: Names | Mapping[str, Datum] | None,
    contact: Names | None,
    neumann: Names | None,
    g: PartwiseDatum | None,
) -> dict[str, str]:
    """Part of the boundary -> its label, for all parts that are named."""
    fluxes = list(g) if isinstance(g, Mapping) else []
    held = list(dirichlet) if isinstance(dirichlet, Mapping) else dirichlet
    named = {
        ("dirichlet", "dirichlet"): held,
        ("contact", "contact"): contact,
        ("neumann", "neumann"): neumann,
        ("g", "neumann"): fluxes,
    }
    labels: dict[str, str] = {}
    fields: dict[str, str] = {}
    for (field, label), names in named.items():
        for name in read_names(names, field, mesh.boundaries):
            if labels.get(name, label) != label:
                raise SceneError(
                    f"{field}: {name!r} is in {fields[name]}, too; leave it out of one of the two"
                )
            labels[name], fields[name] = label, field
    return labels


def _refuse_labels(**given: Names | None) -> None:
    """A mesh of the library has labels: nothing else may say what holds where."""
    for field, names in given.items():
        if names is not None:
            raise SceneError(
                f"{field}: {described(names)} is not needed, the mesh has labels already; drop it"
            )


def _on_labelled(
    mesh: Grid | Triangulation, element: str, data: Data, load: Mapping[str, Any]
) -> Problem:
    """The problem on a mesh of the library, whose labels hold."""
    statement = ProblemStatement({}, {}, data, **load)
    found = discretize_on(mesh, element, statement)
    return replace(found, n=1, h=longest_edge(mesh))
