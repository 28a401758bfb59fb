"""What the pieces of the suite state alike: the unit square, its grids, and data that are zero."""

from signorini.mesh.grid import SIDES, Grid
from signorini.scene.statement import ProblemStatement

LABELS = ("contact", "neumann", "dirichlet", "neumann")  # of the paper, in the order of SIDES
_ZERO = {"f": 0, "g": 0, "dirichlet": 0, "obstacle": 0}


def statement(data=None, truth=None, domain=None, quadrature="exact"):
    """State a problem, on the square where it has a domain, or else for a mesh that comes later.

    Parameters
    ----------
    data : dict, optional
        Formulas of f, g, Dirichlet values, obstacle and coefficient; zero where not given.
    truth : dict, optional
        An exact solution, which brings its own data.
    domain : dict, optional
        Of `square`.
    quadrature : str, optional

    Returns
    -------
    ProblemStatement
    """
    mapping = {
        "domain": domain or {},
        "boundary": by_side(LABELS) if domain else {},
        "data": {} if truth else _ZERO | (data or {}),
        "load_quadrature": quadrature,
    }
    return ProblemStatement.from_mapping(mapping | ({"truth": truth} if truth else {}))


def square(size=1.0, offset=0.0):
    """The domain of a square whose lower left corner lies on the diagonal of the plane.

    Parameters
    ----------
    size : float, optional
        Length of a side, in the unit of length.
    offset : float, optional
        Both coordinates of the corner.

    Returns
    -------
    dict
        As a scene has it.

    Examples
    --------
    >>> square(2.0)["size"]
    [2.0, 2.0]
    """
    return {
        "origin": [offset, offset],
        "size": [size, size],
        "diagonal": "falling",
        "cells": "per-side",
    }


def grid(nx, ny, labels=LABELS, diagonal="falling", width=1.0):
    """A grid on a rectangle of height 1.

    Parameters
    ----------
    nx, ny : int
        Cells along x and y.
    labels : sequence of str, optional
        What holds on the sides, in the order of `SIDES`.
    diagonal : {"falling", "rising"}, optional
    width : float, optional
        Of the rectangle.

    Returns
    -------
    Grid

    Examples
    --------
    >>> grid(4, 2).number_of_triangles
    16
    """
    return Grid(nx, ny, (0.0, 0.0), (width, 1.0), diagonal, labels)


def by_side(labels):
    """Labels in the order of SIDES, as a dict by side.

    Examples
    --------
    >>> by_side(LABELS)
    {'bottom': 'contact', 'right': 'neumann', 'top': 'dirichlet', 'left': 'neumann'}
    """
    return dict(zip(SIDES, labels, strict=True))
