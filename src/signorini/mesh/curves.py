"""Curved sides of a domain: circles, and curves phi(x, y) = 0, and the points of them nearest to
points.
"""

from dataclasses import dataclass

import numpy as np

from signorini.exceptions import FormulaError, MeshError
from signorini.formula import Formula
from signorini.mesh.geometry import point_text

_STEPS = 50  # of Newton's method; it takes three or four from beside a curve
_CLOSE = 64.0  # units in the last place of the coordinates


@dataclass(frozen=True)
class Circle:
    """A circle.

    Parameters
    ----------
    center : tuple of float
        Unit of length.
    radius : float
        Positive, unit of length.

    Examples
    --------
    >>> Circle((0.0, 0.0), 2.0).nearest(np.array([[3.0], [4.0]])).ravel().tolist()
    [1.2, 1.6]
    """

    center: tuple
    radius: float

    def nearest(self, p):
        """The points of the curve nearest to points.

        Parameters
        ----------
        p : ndarray, shape (2, k)
            Unit of length.

        Returns
        -------
        ndarray, shape (2, k)

        Raises
        ------
        MeshError
            For the centre, to which all points are equally near.

        Examples
        --------
        >>> Circle((1.0, 0.0), 2.0).nearest(np.array([[1.0], [5.0]])).ravel().tolist()
        [1.0, 2.0]
        """
        center = np.array(self.center, dtype=float)[:, None]
        return center + self.radius * self.normals(p)

    def normals(self, p):
        """Unit normals at points of the curve, away from the centre; as `nearest`.

        Raises
        ------
        MeshError
            For the centre.

        Examples
        --------
        >>> Circle((0.0, 0.0), 5.0).normals(np.array([[3.0], [4.0]])).ravel().tolist()
        [0.6, 0.8]
        """
        away = p - np.array(self.center, dtype=float)[:, None]
        distance = np.hypot(*away)
        if not distance.all():
            x, y = self.center
            raise MeshError(
                f"a point at the centre ({x:g}, {y:g}) has no nearest point on the circle; "
                "move the centre"
            )
        return away / distance

    @property
    def section(self):
        """What can be stored, and read by `read_curve`.

        Examples
        --------
        >>> circle = Circle((0.0, 0.0), 2.0)
        >>> read_curve(circle.section) == circle
        True
        """
        return {"center": list(self.center), "radius": self.radius}


@dataclass(frozen=True)
class LevelSet:
    """The curve on which a formula is zero.

    Parameters
    ----------
    phi : Formula
        Dimensionless; its gradient vanishes nowhere on the curve.

    Examples
    --------
    >>> ellipse = LevelSet(Formula("x**2/4 + y**2 - 1"))
    >>> ellipse.nearest(np.array([[2.1], [0.0]])).ravel().tolist()
    [2.0, 0.0]
    """

    phi: Formula

    def nearest(self, p):
        """Points of the curve along its gradient, by Newton's method; from `Circle.nearest`.

        Raises
        ------
        MeshError
            Where it finds none.
        FormulaError
            Where the formula or its gradient is not finite.

        Examples
        --------
        >>> parabola = LevelSet(Formula("y - x**2"))
        >>> x, y = parabola.nearest(np.array([[1.0], [1.2]]))
        >>> bool(abs(y - x**2) < 1e-15)
        True
        """
        found = np.array(p, dtype=float)
        for _ in range(_STEPS):
            phi, *gradient = self.phi.value_and_gradient(*found)
            square = gradient[0] ** 2 + gradient[1] ** 2
            flat = (square == 0.0) & (phi != 0.0)
            if flat.any():
                raise MeshError(
                    f"{self.phi.text} has no gradient at {point_text(found, int(flat.argmax()))}; "
                    "write a formula that varies across its curve"
                )
            step = np.divide(phi, square, out=np.zeros_like(phi), where=square > 0.0) * gradient
            found -= step
            still = np.hypot(*step) > _CLOSE * np.spacing(np.abs(found).max(initial=1e-300))
            if not still.any():
                return found
        raise MeshError(
            f"Newton's method finds no zero of {self.phi.text} near "
            f"{point_text(p, int(still.argmax()))}; correct the formula"
        )

    def normals(self, p):
        """Unit normals at points of the curve, to where the formula grows.

        Examples
        --------
        >>> LevelSet(Formula("3*x + 4*y - 5")).normals(np.array([[0.6], [0.8]])).ravel().tolist()
        [0.6, 0.8]
        """
        gradient = np.stack(self.phi.value_and_gradient(*p)[1:])
        return gradient / np.hypot(*gradient)

    @property
    def section(self):
        """What can be stored, and read by `read_curve`.

        Examples
        --------
        >>> LevelSet(Formula("x**2 + y**2 - 1")).section
        'x**2 + y**2 - 1'
        """
        return self.phi.text


def read_curve(given, field="domain.boundary_shape"):
    """A curve as a scene says it.

    Parameters
    ----------
    given : dict or str
        ``center`` and ``radius`` of a circle, or the formula phi of a curve phi(x, y) = 0.
    field : str
        Where it stands, for messages.

    Returns
    -------
    Circle or LevelSet

    Raises
    ------
    MeshError, FormulaError
        Naming the field, its value and the remedy.

    Examples
    --------
    >>> read_curve({"center": [0, 0], "radius": 2})
    Circle(center=(0.0, 0.0), radius=2.0)
    """
    if not isinstance(given, dict):
        formula = Formula(given, field)
        if formula.constant is not None:
            raise FormulaError(f"{field}: {given!r} is constant; write phi of phi(x, y) = 0")
        return LevelSet(formula)
    x, y, radius = map(float, (*given["center"], given["radius"]))
    if not (np.isfinite([x, y]).all() and 0.0 < radius < np.inf):
        raise MeshError(
            f"{field}: centre ({x:g}, {y:g}) and radius {radius:g} make no circle; "
            "give finite numbers, the radius greater than 0"
        )
    return Circle((x, y), radius)
