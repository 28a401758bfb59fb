"""The section ``sweep`` of a scene: which values its keys take, and the points that they make."""

import copy
import hashlib
import json
import math
import re
from collections import Counter
from dataclasses import dataclass
from itertools import product

from signorini.exceptions import SceneError
from signorini.wording import nearest, shown

MOST_POINTS = 10_000
# Sections that no solution and no error depends on.
UNSWEPT = ("title", "slope", "table", "outputs", "expect", "sweep", "publication")
_LEFT_OUT = ("table", "outputs", "expect", "sweep", "publication")  # of the scene of a point
SPACINGS = ("linear", "log")
_RANGE = ("from", "to", "count", "spacing")
_DIGITS = 12  # of a value within a range, so that another count meets the same values
_PLAIN = re.compile(r"[A-Za-z0-9.+-]{1,32}")
_SHORT = 24  # characters of a text that is no plain name, before its digest
_LONGEST = 150  # characters of a name


@dataclass(frozen=True)
class Point:
    """A point of a sweep.

    Parameters
    ----------
    name : str
        Of its folder.
    values : dict
        Key of the scene, dots between sections -> its value.
    """

    name: str
    values: dict

    @property
    def description(self):
        """The values as messages tell them.

        Examples
        --------
        >>> Point("half_width=0.5", {"truth.parameters.half_width": 0.5}).description
        'truth.parameters.half_width = 0.5'
        """
        return ", ".join(f"{key} = {shown(value)}" for key, value in self.values.items())


def check_sweep(section, schema):
    """Check a section ``sweep``: its keys, ranges and lists, and how many points there are.

    Parameters
    ----------
    section : dict
        Key of the scene -> list of values, or a range.
    schema : dict
        Of a scene.

    Raises
    ------
    SceneError
        Naming the field, its value and the remedy.
    """
    for key, given in section.items():
        _check_key(key, schema)
        if isinstance(given, list):
            _check_list(f"sweep.{key}", given)
        else:
            _check_range(f"sweep.{key}", given)
    counts = {key: len(_values(given)) for key, given in section.items()}
    if math.prod(counts.values()) > MOST_POINTS:
        factors = " times ".join(f"{count} of {key}" for key, count in counts.items())
        raise SceneError(
            f"sweep: {factors} are {math.prod(counts.values())} points; {MOST_POINTS} is the "
            "limit: take fewer values, or split the scene"
        )


def sweep_points(section):
    """The points of a sweep: every combination of its values, the last key changing fastest.

    Parameters
    ----------
    section : dict
        Valid, see `check_sweep`.

    Returns
    -------
    tuple of Point
        Of different names.

    Examples
    --------
    >>> section = {"data.f": {"from": 0, "to": 1, "count": 3}, "domain.diagonal": ["rising"]}
    >>> [point.name for point in sweep_points(section)]
    ['f=0,diagonal=rising', 'f=0.5,diagonal=rising', 'f=1,diagonal=rising']
    """
    short = _short_names(section)
    combinations = product(*(_values(given) for given in section.values()))
    points = []
    for values in combinations:
        by_key = dict(zip(section, values, strict=True))
        name = ",".join(f"{short[key]}={_label(value)}" for key, value in by_key.items())
        points.append(Point(_limited(name, _LONGEST), by_key))
    return tuple(points)


def with_values(document, values):
    """A document without its sweep and what it builds, some of its keys with other values.

    Parameters
    ----------
    document : dict
        As it was written; not changed.
    values : dict
        Key, dots between sections -> value.

    Returns
    -------
    dict

    Examples
    --------
    >>> with_values({"data": {"f": 1, "g": 0}, "sweep": {"data.f": [2]}}, {"data.f": 2})
    {'data': {'f': 2, 'g': 0}, 'outputs': []}
    """
    kept = {key: part for key, part in document.items() if key not in _LEFT_OUT}
    changed = copy.deepcopy(kept) | {"outputs": []}
    for key, value in values.items():
        *sections, last = key.split(".")
        place = changed
        for section in sections:
            if not isinstance(place.get(section), dict):
                place[section] = {}
            place = place[section]
        place[last] = copy.deepcopy(value)
    return changed


def _check_key(key, schema):
    first, *rest = key.split(".")
    if first in UNSWEPT:
        raise SceneError(
            f"sweep.{key}: nothing that is computed depends on {first}; sweep another key"
        )
    part, known, place = schema, _keys(schema, schema), ""
    for name in (first, *rest):
        if known is not None and name not in known:
            full = [f"{place}{other}" for other in known if other not in UNSWEPT]
            full += [f"{place}{other}" for other in _within_sections(name, known, schema)]
            raise SceneError(
                f"sweep.{key}: the scene has no such key; {nearest(f'{place}{name}', full)}"
            )
        part = (known or {}).get(name, {})
        known = _keys(part, schema) if part else None
        place += f"{name}."


def _within_sections(name, known, schema):
    """Keys of that name one section further down."""
    return [f"{key}.{name}" for key, part in known.items() if name in (_keys(part, schema) or ())]


def _keys(part, schema):
    """The keys of a section, name -> their part of the schema; None where any will do."""
    if "$ref" in part:
        part = schema["$defs"][part["$ref"].removeprefix("#/$defs/")] | part
    found = dict(part.get("properties", {}))
    if isinstance(part.get("additionalProperties"), dict):
        return None
    for option in part.get("oneOf", ()):
        keys = _keys(option, schema)
        if keys is None:
            return None
        found |= keys
    return found


def _check_list(field, values):
    if not values:
        raise SceneError(f"{field}: [] is not valid; list at least one value")
    twice = [text for text, count in Counter(map(_label, values)).items() if count > 1]
    if twice:
        raise SceneError(f"{field}: {twice[0]} is there twice; list each value once")


def _check_range(field, given):
    for key in given:
        if key not in _RANGE:
            raise SceneError(f"{field}.{key}: unknown key; {nearest(key, _RANGE)}")
    for key in _RANGE[:3]:
        if key not in given:
            raise SceneError(
                f"{field}.{key}: missing; a range is {{from: 0, to: 1, count: 11}}, or give a list"
            )
    for key in ("from", "to"):
        if isinstance(given[key], bool) or not isinstance(given[key], int | float):
            raise SceneError(f"{field}.{key}: {shown(given[key])} is not valid; expected a number")
        if not math.isfinite(given[key]):
            raise SceneError(f"{field}.{key}: {shown(given[key])} is not valid; it must be finite")
    _check_count(field, given)
    _check_spacing(field, given)


def _check_count(field, given):
    count = given["count"]
    if type(count) is not int or not 1 <= count <= MOST_POINTS:
        raise SceneError(
            f"{field}.count: {shown(count)} is not valid; "
            f"expected a whole number from 1 to {MOST_POINTS}"
        )
    if (count > 1) != (given["from"] != given["to"]):
        raise SceneError(
            f"{field}.count: {count} values from {given['from']} to {given['to']}; "
            "one value needs equal ends, more need different ones"
        )


def _check_spacing(field, given):
    spacing = given.get("spacing", SPACINGS[0])
    if spacing not in SPACINGS:
        raise SceneError(
            f"{field}.spacing: {shown(spacing)} is not valid; {nearest(str(spacing), SPACINGS)}"
        )
    for key in ("from", "to"):
        if spacing == "log" and given[key] <= 0:
            raise SceneError(
                f"{field}.{key}: {shown(given[key])} is not valid; "
                "with logarithmic spacing it must be greater than 0"
            )
    labels = Counter(map(_label, _values(given)))
    if len(labels) < given["count"]:
        raise SceneError(
            f"{field}.count: {given['count']} values in so small a range are not told apart by "
            f"{_DIGITS} digits; take fewer"
        )


def _values(given):
    """The values of a list or of a range."""
    if isinstance(given, list):
        return given
    first, last, count = given["from"], given["to"], given["count"]
    if given.get("spacing") == "log":
        first, last = math.log(first), math.log(last)
    shares = [k / (count - 1) for k in range(count)] if count > 1 else [0.0]
    values = [(1.0 - share) * first + share * last for share in shares]
    if given.get("spacing") == "log":
        values = [float(f"{math.exp(value):.{_DIGITS}g}") for value in values]
    else:
        largest = max(abs(first), abs(last)) or 1.0
        decimals = _DIGITS - 1 - math.floor(math.log10(largest))
        values = [round(value, decimals) + 0.0 for value in values]
    whole = isinstance(given["from"], int) and isinstance(given["to"], int)
    return [int(value) if whole and value.is_integer() else value for value in values]


def _short_names(keys):
    """The last part of each key, or the whole key where several end alike."""
    last = Counter(key.split(".")[-1] for key in keys)
    names = {key: key.split(".")[-1] for key in keys}
    return {key: name if last[name] == 1 else key for key, name in names.items()}


def _label(value):
    """What a value is called in a name."""
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        text = json.dumps(value, sort_keys=True)
    else:
        text = value if isinstance(value, str) else f"{value:.{_DIGITS}g}"
    if _PLAIN.fullmatch(text):
        return text
    plain = re.sub(r"[^A-Za-z0-9.+-]+", "_", text).strip("_")
    return f"{plain[:_SHORT]}-{_digest(text)}"


def _limited(name, most):
    return name if len(name) <= most else f"{name[:most]}-{_digest(name)}"


def _digest(text):
    return hashlib.sha256(text.encode()).hexdigest()[:8]
