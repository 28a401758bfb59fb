"""Numbers that somebody printed: a table of anyone's hand, checked line by line."""

import csv
import io
import re
from collections import Counter
from dataclasses import dataclass
from decimal import Decimal

from signorini.exceptions import SceneError
from signorini.publication.keys import SLOPE, key_of
from signorini.storage.files import read_bytes
from signorini.wording import cut

COLUMNS = ("quantity", "element", "n", "value", "tolerance")
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d{1,3})?")


@dataclass(frozen=True)
class Published:
    """A number as it is printed.

    Parameters
    ----------
    quantity : str
        Words of a key, such as ``"l2"`` or ``"slope l2"``.
    element, n : str
        The rest of the key; n is empty where the number is of all levels.
    value : str
        As printed, trailing zeros kept.
    tolerance : str
        Largest deviation that passes, in units of the last printed digit.

    Examples
    --------
    >>> number = Published("l2", "P1", "2", "0.10075495", "1")
    >>> number.key, number.cell, number.unit
    ('l2, P1, 2', 'l2 P1 n=2', Decimal('1E-8'))
    """

    quantity: str
    element: str
    n: str
    value: str
    tolerance: str

    @property
    def key(self):
        """The key of the computed number.

        Examples
        --------
        >>> Published("l2", "CR", "64", "0.0001", "1").key
        'l2, CR, 64'
        """
        return key_of(*self.quantity.split(), *filter(None, (self.element, self.n)))

    @property
    def cell(self):
        """The name in check.csv.

        Examples
        --------
        >>> Published("l2", "CR", "64", "0.0001", "1").cell
        'l2 CR n=64'
        """
        first, *rest = self.quantity.split()
        if first == SLOPE:
            return " ".join([*rest[:1], self.element, SLOPE, *rest[1:]])
        level = f"n={self.n}" if self.n else ""
        return " ".join(filter(None, (self.quantity, self.element, level)))

    @property
    def is_slope(self):
        """Whether it is a slope.

        Examples
        --------
        >>> Published("l2", "CR", "64", "0.0001", "1").is_slope
        False
        """
        return self.quantity.split()[0] == SLOPE

    @property
    def unit(self):
        """One unit of the last printed digit.

        Examples
        --------
        >>> Published("l2", "CR", "64", "0.0980", "1").unit
        Decimal('0.0001')
        """
        return Decimal(1).scaleb(Decimal(self.value).as_tuple().exponent)


def read_published(path):
    """Read a table of published numbers.

    Parameters
    ----------
    path : str or Path
        CSV with the header ``quantity,element,n,value,tolerance``.

    Returns
    -------
    dict
        Line of the file -> `Published`.

    Raises
    ------
    SceneError
        Naming the file, the line, the value and the remedy.

    Examples
    --------
    >>> from signorini import load_scene
    >>> path = load_scene("config/scenes/paper.yaml").document["publication"]["published"]
    >>> number = next(iter(read_published(path).values()))
    >>> number.quantity, number.element, number.value
    ('l2', 'P1', '0.10075495')
    """
    reader = csv.reader(io.StringIO(_text(path)))
    header = next(reader, [])
    if tuple(header) != COLUMNS:
        found = cut(",".join(header)) or "nothing"
        raise SceneError(f"{path}: line 1: {found}; the header must be {','.join(COLUMNS)}")
    numbers = {}
    for row in filter(None, reader):
        numbers[reader.line_num] = _number(path, reader.line_num, row)
    if not numbers:
        raise SceneError(f"{path}: no number; add a line, such as l2,CR,64,0.00009866,1")
    _check_twice(path, numbers)
    return numbers


def _text(path):
    try:
        return read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SceneError(
            f"{path}: not UTF-8 text ({error.reason} at byte {error.start}); save it as UTF-8"
        ) from None


def _number(path, line, row):
    place = f"{path}: line {line}"
    if len(row) != len(COLUMNS):
        raise SceneError(
            f"{place}: {len(row)} fields instead of {len(COLUMNS)}; write {','.join(COLUMNS)}"
        )
    number = Published(*(field.strip() for field in row))
    if not number.quantity:
        raise SceneError(f"{place}: quantity: it is empty; name one, such as l2 or slope l2")
    for name in ("value", "tolerance"):
        text = getattr(number, name)
        if not _NUMBER.fullmatch(text):
            raise SceneError(f"{place}: {name}: {cut(text)!r} is no number; write one as printed")
    if Decimal(number.tolerance) < 0:
        raise SceneError(
            f"{place}: tolerance: {number.tolerance} is negative; write 1 to let one unit pass"
        )
    return number


def _check_twice(path, numbers):
    counts = Counter(number.key for number in numbers.values())
    for line, number in numbers.items():
        if counts[number.key] > 1:
            lines = [str(k) for k, other in numbers.items() if other.key == number.key]
            raise SceneError(
                f"{path}: line {line}: {number.cell} stands there {counts[number.key]} times, "
                f"in lines {', '.join(lines)}; keep one"
            )
