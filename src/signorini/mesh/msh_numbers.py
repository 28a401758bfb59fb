"""The numbers in a section of Gmsh's MSH 4.1, in text or binary, taken one after the other.

`TextNumbers` and `BinaryNumbers` have the same methods: ``real(count)`` for coordinates,
``whole(count)`` for integers and ``sizes(count)`` for Gmsh's ``size_t``. Each takes the next
`count` numbers as an array, and raises MeshError where the section has fewer.
"""

import warnings

import numpy as np

from signorini.exceptions import MeshError

_TOO_SHORT = "a section is shorter than it says; write the file anew"
_DAMAGED_HEADER = "its $MeshFormat is damaged; write the file anew"


class TextNumbers:
    """Numbers of a section in text, taken in their order.

    Parameters
    ----------
    body : bytes
        Of the section.

    Raises
    ------
    MeshError
        If the section holds something else than numbers.
    """

    def __init__(self, body):
        self._numbers, self._taken = _parse_numbers(body), 0

    def real(self, count):
        """The next numbers, shape (count,).

        Raises
        ------
        MeshError
            If there are fewer.
        """
        if not 0 <= count <= self._numbers.size - self._taken:
            raise MeshError(_TOO_SHORT)
        self._taken += count
        return self._numbers[self._taken - count : self._taken]

    def whole(self, count):
        """The next numbers as integers, shape (count,).

        Raises
        ------
        MeshError
            If they are no integers, or there are fewer.
        """
        numbers = self.real(count)
        if np.all(np.abs(numbers) < 2.0**53):  # beyond, doubles are not one apart
            whole = numbers.astype(np.int64)
            if np.array_equal(whole, numbers):
                return whole
        raise MeshError("a number that must be whole is not; write the file anew")

    sizes = whole


class BinaryNumbers:
    """Numbers of a section in binary, taken in their order.

    Parameters
    ----------
    body : bytes
        Of the section.
    byte_order : {"<", ">"}
    size_width : int
        Bytes of Gmsh's ``size_t``, 4 or 8.
    """

    def __init__(self, body, byte_order, size_width):
        self._body, self._taken = body, 0
        self._byte_order, self._size_width = byte_order, size_width

    def _take(self, kind, count):
        dtype = np.dtype(self._byte_order + kind)
        length = dtype.itemsize * count
        if not 0 <= length <= len(self._body) - self._taken:
            raise MeshError(_TOO_SHORT)
        self._taken += length
        return np.frombuffer(self._body, dtype, count, self._taken - length)

    def real(self, count):
        """The next double-precision numbers, shape (count,)."""
        return self._take("f8", count)

    def whole(self, count):
        """The next 32-bit integers, as 64-bit ones."""
        return self._take("i4", count).astype(np.int64)

    def sizes(self, count):
        """The next numbers of type ``size_t``, as 64-bit integers."""
        return self._take(f"u{self._size_width}", count).astype(np.int64)


def numbers_by_format(header):
    """Choose how the sections of a file are read.

    Parameters
    ----------
    header : bytes
        The section ``$MeshFormat``: version, 0 for text or 1 for binary, width of ``size_t``; in
        binary then the integer 1, which shows the order of bytes.

    Returns
    -------
    callable
        Section -> `TextNumbers` or `BinaryNumbers`.

    Raises
    ------
    MeshError
        If the section is damaged.
    """
    line, _, rest = header.partition(b"\n")
    fields = line.split()
    if len(fields) != 3 or fields[1] not in (b"0", b"1") or fields[2] not in (b"4", b"8"):
        raise MeshError(_DAMAGED_HEADER)
    if fields[1] == b"0":
        return TextNumbers
    one = rest[:4]
    if one not in (b"\1\0\0\0", b"\0\0\0\1"):
        raise MeshError(_DAMAGED_HEADER)
    byte_order = "<" if one[0] else ">"
    return lambda body: BinaryNumbers(body, byte_order, int(fields[2]))


def _parse_numbers(body):
    with warnings.catch_warnings():
        # NumPy warns where it cannot read a text to its end.
        warnings.simplefilter("error")
        try:
            return np.fromstring(body, sep=" ")
        except (DeprecationWarning, ValueError):
            raise MeshError(
                "a section holds something else than numbers; write the file anew"
            ) from None
