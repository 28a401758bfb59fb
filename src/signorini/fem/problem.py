"""From a scene to a discrete problem, which `discrete_problem` describes."""

from dataclasses import replace
from typing import Any

import numpy as np

from signorini.exceptions import SceneError
from signorini.fem.by_part import check_parts_meet, values_at
from signorini.fem.coefficient import coefficient_on
from signorini.fem.data_checks import check_corners, check_poles
from signorini.fem.discrete_problem import Problem
from signorini.fem.elements import find_element
from signorini.fem.load import assemble_contact_load, assemble_load
from signorini.fem.precision import LOAD_PRECISIONS

__all__ = ["Problem", "discretize", "discretize_on"]


def discretize(scene: Any, element: str, n: int) -> Problem:
    """Discretise a scene.

    Parameters
    ----------
    scene : Scene or ProblemStatement
        What is asked; see `load_scene`.
    element : {"P1", "CR"}
    n : int
        Level, n = 1/h.

    Returns
    -------
    Problem

    Raises
    ------
    SceneError, MeshError, FormulaError
        Naming the field, its value and the remedy.

    Examples
    --------
    >>> import signorini
    >>> scene = signorini.load_scene("config/scenes/paper.yaml")
    >>> problem = signorini.discretize(scene, "CR", 8)
    >>> problem.contact.size
    8
    """
    statement = getattr(scene, "problem_statement", scene)
    find_element(element)
    if isinstance(n, bool) or not isinstance(n, int | np.integer) or n < 1:
        raise SceneError(
            f"levels: n = {n!r} is not a positive whole number; n is 1/h, for instance 8"
        )
    statement.check()
    domain, n = statement.triangulations, int(n)
    problem = discretize_on(domain.level(n), element, statement)
    return replace(problem, n=n, h=domain.mesh_size(n))


def discretize_on(mesh, element, statement):
    """Discretise a problem statement on a given triangulation; see `discretize`.

    The domain of the statement is not used, and the mesh's labels hold. Of the statement, the data
    and the quadrature and precision of the load alone are used, and nothing is checked against an
    exact truth.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : {"P1", "CR"}
    statement : ProblemStatement

    Returns
    -------
    Problem

    Examples
    --------
    >>> from signorini import load_scene
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
    >>> statement = load_scene("config/scenes/paper.yaml").problem_statement
    >>> discretize_on(mesh, "P1", statement).contact
    array([0, 1, 2], dtype=int32)
    """
    finite_element, data = find_element(element), statement.data
    check_poles(mesh, data.f)
    fixed = finite_element.boundary_dofs(mesh, "dirichlet")
    contact = finite_element.boundary_dofs(mesh, "contact")
    contact = np.setdiff1d(contact, fixed, assume_unique=True)
    for label, datum in (("dirichlet", data.dirichlet), ("contact", data.obstacle)):
        check_parts_meet(mesh, datum, label)
    lower = values_at(mesh, finite_element, data.obstacle, contact)
    fixed_values = values_at(mesh, finite_element, data.dirichlet, fixed)
    check_corners(mesh, data, size=max(_largest(lower), _largest(fixed_values)))
    precision = LOAD_PRECISIONS[statement.load_precision]
    b = assemble_load(mesh, finite_element, data.f, data.g, statement.load_quadrature, precision)
    contact_load = assemble_contact_load(mesh, finite_element, data.contact_flux, precision)
    if contact_load is not None:
        b += contact_load
    return Problem(
        element=finite_element.name,
        mesh=mesh,
        b=b,
        contact=contact,
        lower=lower,
        fixed=fixed,
        fixed_values=fixed_values,
        coefficient=coefficient_on(mesh, data.coefficient),
        data=data,
        contact_load=contact_load,
        upper=data.constraint == "upper",
    )


def _largest(values):
    return np.max(np.abs(values), initial=0.0)
