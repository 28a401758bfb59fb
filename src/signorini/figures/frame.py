"""A domain of any place, size and shape on the page."""

import numpy as np

from signorini.figures.units import unit_exponent, with_unit

# Longer side of a drawn domain over the shorter; a longer domain is not drawn to scale.
MOST_STRETCHED = 8
# A domain so many of its own sizes away from the origin is labelled relative to its corner.
FAR = 1e3


class Frame:
    """How a domain's coordinates become numbers of readable size on the page.

    Parameters
    ----------
    p : ndarray, shape (2, nv)
        Vertices, unit of length.

    Examples
    --------
    >>> frame = Frame(np.array([[0.0, 2e-6], [0.0, 1e-6]]))
    >>> width, height = frame.fit(3.0)
    >>> frame.label(0, "x"), float(width), float(height)
    ('$x$  [$10^{-6}$]', 3.0, 1.5)
    """

    def __init__(self, p):
        low, high = p.min(axis=1), p.max(axis=1)
        width, height = high - low
        is_far = np.maximum(np.abs(low), np.abs(high)) > FAR * (high - low).max()
        self.offset = np.where(is_far, low, 0.0)
        ratio = min(max(width / height, 1 / MOST_STRETCHED), MOST_STRETCHED)
        self.to_scale = ratio == width / height
        self.exponents = self._exponents(low, high)
        self.shape = min(ratio, 1.0), min(1 / ratio, 1.0)  # width and height, the longer one 1
        self.low, self.high = (self.place(corner[:, None])[:, 0] for corner in (low, high))

    def _exponents(self, low, high):
        """Of the unit of each axis: one for both if the domain is drawn to scale."""
        ends = zip(low - self.offset, high - self.offset, strict=True)
        exponents = [unit_exponent(pair) for pair in ends]
        return [max(exponents)] * 2 if self.to_scale else exponents

    def place(self, points):
        """Return points of the domain as numbers of the axes.

        Parameters
        ----------
        points : ndarray, shape (2, k)
            Unit of length.

        Returns
        -------
        ndarray, shape (2, k)
            In the units that `label` names, from the offset that it names.

        Examples
        --------
        In thousandths where the domain is as small as that:

        >>> frame = Frame(np.array([[0.0, 0.002, 0.002], [0.0, 0.0, 0.001]]))
        >>> frame.place(np.array([[0.002], [0.001]])).ravel().round(12).tolist()
        [2.0, 1.0]
        """
        units = [[10.0**exponent] for exponent in self.exponents]
        return (points - self.offset[:, None]) / units

    def fit(self, side):
        """Return the size of the domain on the page.

        Parameters
        ----------
        side : float
            Of the square that it must fit in, in inches.

        Returns
        -------
        width, height : float
            In inches.

        Examples
        --------
        >>> frame = Frame(np.array([[0.0, 2.0, 2.0], [0.0, 0.0, 1.0]]))
        >>> [float(side) for side in frame.fit(10.0)]
        [10.0, 5.0]
        """
        return self.shape[0] * side, self.shape[1] * side

    def label(self, axis, name):
        """Return the label of an axis: what its numbers count.

        Parameters
        ----------
        axis : {0, 1}
        name : str
            Of the coordinate.

        Returns
        -------
        str

        Examples
        --------
        >>> Frame(np.array([[0.0, 2.0, 2.0], [0.0, 0.0, 1.0]])).label(0, "x")
        '$x$'
        """
        offset = self.offset[axis]
        sign = "-" if offset > 0 else "+"
        text = f"${name} {sign} {abs(offset):.10g}$" if offset else f"${name}$"
        return with_unit(text, self.exponents[axis])
