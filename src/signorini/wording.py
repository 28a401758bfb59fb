"""Words of error messages: a value as a user typed it, cut to a bearable length, and the nearest of
the known names.
"""

import difflib
import json
from itertools import islice

WIDTH = 60  # of a value that is shown


def shown(value):
    """A value as JSON, cut to 60 characters; of a long list or text only the beginning is looked
    at.
    """
    text = json.dumps(_beginning(value), default=lambda _: "...", ensure_ascii=False)
    return text if len(text) <= WIDTH else f"{text[: WIDTH - 3]}..."


def _beginning(value, deep=4):
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


def nearest(word, known):
    """A hint: the nearest of the known words, and the first 40 of them."""
    known = list(known)
    near = difflib.get_close_matches(str(word)[:200], known, n=1, cutoff=0.5)
    return (f"did you mean {near[0]}? " if near else "") + f"known: {listed(known)}"


def listed(names, most=40):
    """Names with commas between them, at most so many, each at most 60 characters long."""
    names = list(names)
    texts = [name if len(name) <= WIDTH else f"{name[: WIDTH - 3]}..." for name in names[:most]]
    return ", ".join(texts) + (f" and {len(names) - most} more" if len(names) > most else "")
