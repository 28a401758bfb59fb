"""The contact dofs of a solution in the order of the line, and the critical points between them.

At a critical point u starts to bind. The part may have several components, and each may turn
corners; they are walked as `mesh.paths` says, and the arc length runs on from one to the next.
"""

from dataclasses import dataclass, fields

import numpy as np

from signorini.mesh.paths import boundary_paths


@dataclass(frozen=True, eq=False)
class ContactLine:
    """The contact dofs of a solution in the order of the line.

    Parameters
    ----------
    which : ndarray of int, shape (m,)
        Positions in ``solution.contact``. A vertex where three or more facets of the part meet
        comes once for each path that ends there.
    component : ndarray of int, shape (m,)
        Counted from 1.
    s : ndarray, shape (m,)
        Arc length, unit of length.
    points : ndarray, shape (2, m)
    critical : ndarray, shape (m,)
        Arc length of the critical point between a dof and the next of its component; NaN where
        there is none.
    critical_points : ndarray, shape (2, c)
    """

    which: np.ndarray
    component: np.ndarray
    s: np.ndarray
    points: np.ndarray
    critical: np.ndarray
    critical_points: np.ndarray


_NOTHING = ContactLine(
    which=np.zeros(0, int),
    component=np.zeros(0, int),
    s=np.zeros(0),
    points=np.zeros((2, 0)),
    critical=np.zeros(0),
    critical_points=np.zeros((2, 0)),
)


def walk_contact(mesh, element, contact, active):
    """The `ContactLine` of a solution.

    Parameters
    ----------
    mesh : Grid or Triangulation
    element : Element
    contact : ndarray of int, shape (nc,)
        Contact dofs.
    active : ndarray of bool, shape (nc,)
        Which of them bind.

    Returns
    -------
    ContactLine

    Examples
    --------
    The last dof of four binds:

    >>> from signorini.fem.elements import find_element
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> grid, element = Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels), find_element("CR")
    >>> facets = element.boundary_dofs(grid, "contact")
    >>> line = walk_contact(grid, element, facets, np.arange(4) == 3)
    >>> line.s.tolist(), line.critical.tolist()
    ([0.125, 0.375, 0.625, 0.875], [nan, nan, 0.75, nan])
    """
    position = np.full(element.size(mesh), -1)
    position[contact] = np.arange(contact.size)
    start, lines = 0.0, [_NOTHING]
    for component, path in enumerate(boundary_paths(mesh, "contact"), start=1):
        lines.append(_ordered_path(path, element, active, position, component, start))
        start += path.arc_length[-1]
    return ContactLine(
        *(
            np.concatenate([getattr(line, field.name) for line in lines], axis=-1)
            for field in fields(ContactLine)
        )
    )


def _ordered_path(path, element, active, position, component, start):
    """The `ContactLine` of one path, which starts at arc length `start`.

    Marks are the vertices and midpoints of the path by turns; dofs sit on every second one, and
    critical points on those between::

        P1   dof  .  dof  .  dof        CR   .  dof  .  dof  .
              0   1   2   3   4              0   1   2   3   4
    """
    dofs, first = element.path_dofs(path)
    s, marks = start + path.arc_length, path.marks
    at = np.arange(first, s.size - path.closed, 2)
    which = position[dofs[at // 2]]
    known = which >= 0
    binds = np.append(active, False)[which]  # dofs off the contact part, -1, do not bind
    turns = known & np.roll(known, -1) & (binds != np.roll(binds, -1))
    turns[-1] &= path.closed
    between = at[turns] + 1
    critical = np.full(at.size, np.nan)
    critical[turns] = s[between]
    at = at[known]
    return ContactLine(
        which=which[known],
        component=np.full(at.size, component),
        s=s[at],
        points=marks[:, at],
        critical=critical[known],
        critical_points=marks[:, between],
    )
