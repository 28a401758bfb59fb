"""Words of error messages: a value as it was given, and the nearest of the known names.

Both are cut to a bearable length.
"""

import difflib
import json
from itertools import islice

WIDTH = 60  # of a value that is shown


def shown(value):
    """A value as JSON, cut to 60 characters.

    Of a long list or text only the beginning is looked at.

    Examples
    --------
    >>> shown({"n": [2, 4]})
    '{"n": [2, 4]}'
    """
    text = json.dumps(_beginning(value), default=lambda _: "...", ensure_ascii=False)
    return _cut(text)


def _cut(text):
    return cut(text)


def cut(text, width=WIDTH):
    """Return text cut to a width, with dots in place of what is left out.

    Parameters
    ----------
    text : str
    width : int, optional
        Characters.

    Returns
    -------
    str

    Examples
    --------
    >>> cut("a long word", 9)
    'a long...'
    """
    return text if len(text) <= width else f"{text[: width - 3]}..."


def printable(text):
    """A text of anybody's on one line, without what moves a terminal's cursor or colours it.

    Parameters
    ----------
    text : str

    Returns
    -------
    str
        Characters that cannot be printed are told by their code.

    Examples
    --------
    >>> print(printable("errors.csv\\nall is well"))
    errors.csv\\x0aall is well
    """
    return "".join(each if each.isprintable() else f"\\x{ord(each):02x}" for each in text)


def counted(count, word):
    """A number of things, in words.

    Parameters
    ----------
    count : int
    word : str
        Of one of them; of others with an s.

    Returns
    -------
    str

    Examples
    --------
    >>> counted(1, "level"), counted(3, "level")
    ('1 level', '3 levels')
    """
    return f"{count} {word}" if count == 1 else f"{count} {word}s"


def _beginning(value, deep=4):
    """What of a value can be shown: a few levels of lists and dicts, the first entries of each."""
    if isinstance(value, str):
        return value[: WIDTH + 1]
    if isinstance(value, int) and abs(value) >= 10**WIDTH:
        return "a number of more than 60 digits"
    if deep and isinstance(value, list):
        return [_beginning(entry, deep - 1) for entry in value[:WIDTH]]
    if deep and isinstance(value, dict):
        return {
            _beginning(str(key)): _beginning(entry, deep - 1)
            for key, entry in islice(value.items(), WIDTH)
        }
    return value if isinstance(value, int | float | None) else "..."


def takes_two(function):
    """Whether a function can be called with two arguments.

    Parameters
    ----------
    function : callable

    Returns
    -------
    bool
        True also where its signature is not known.

    Examples
    --------
    >>> takes_two(lambda x, y: x), takes_two(lambda x: x[0])
    (True, False)
    """
    import inspect

    try:
        inspect.signature(function).bind(0, 0)
    except TypeError:
        return False
    except ValueError:  # of some functions in C nothing is known
        return True
    return True


_FEW = 12  # names beside the nearest one


def nearest(word, known):
    """A hint: the nearest of the known words, and the first of them, fewer where one is near.

    Parameters
    ----------
    word : object
        What was given; what is not text is near to nothing.
    known : iterable of str

    Returns
    -------
    str

    Examples
    --------
    >>> nearest("contakt", ["contact", "neumann"])
    'did you mean contact? known: contact, neumann'
    """
    known = list(known)
    near = difflib.get_close_matches(str(word)[:200], known, n=1, cutoff=0.5)
    if not near:
        return f"known: {listed(known)}"
    return f"did you mean {near[0]}? known: {listed(known, most=_FEW)}"


def listed(names, most=40):
    """Names with commas between them, each cut to 60 characters.

    Parameters
    ----------
    names : iterable of str
    most : int, optional
        How many are named; of the others the number is told.

    Returns
    -------
    str

    Examples
    --------
    >>> listed(["a", "b", "c"], most=2)
    'a, b and 1 more'
    """
    names = list(names)
    text = ", ".join(_cut(name) for name in names[:most])
    return f"{text} and {len(names) - most} more" if len(names) > most else text
