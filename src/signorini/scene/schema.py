"""Validation of parsed YAML against a JSON schema: defaults filled in, errors a person can mend."""

import copy
from functools import cache

from signorini.exceptions import SceneError
from signorini.wording import WIDTH, nearest, shown


def validated(document, schema, source):
    """Check a document and fill in its defaults.

    Parameters
    ----------
    document : object
        What `strict_yaml.load_yaml` returned; not changed.
    schema : dict
        JSON schema, draft 2020-12.
    source : str or Path
        The file to name in errors.

    Returns
    -------
    dict
        A copy of the document with every default filled in.

    Raises
    ------
    SceneError
        One line that names the file, the field, the value and the remedy.

    Examples
    --------
    >>> schema = {"properties": {"n": {"type": "integer", "default": 4}, "title": {}}}
    >>> validated({"title": "Mine"}, schema, "mine.yaml")
    {'title': 'Mine', 'n': 4}
    """
    if not isinstance(document, dict):
        raise SceneError(
            f"{source}: expected 'key: value' lines at the top, found {shown(document)}"
        )
    error = min(_validator()(schema).iter_errors(document), key=_order, default=None)
    if error is not None:
        raise SceneError(f"{source}: {_explain(error, schema)}")
    _check_kinds(document, schema, source)
    document = copy.deepcopy(document)
    _fill(document, schema)
    return document


@cache
def _validator():
    """JSON schema's rules, but 2.0 is no integer: it would give its file the name n2.0.npz."""
    from jsonschema import Draft202012Validator, validators

    whole = Draft202012Validator.TYPE_CHECKER.redefine(
        "integer", lambda _, value: type(value) is int
    )
    return validators.extend(Draft202012Validator, type_checker=whole)


def _order(error):
    """Unknown keys first, for they explain missing ones; then what is nearest to the top."""
    return (
        error.validator != "additionalProperties",
        len(error.absolute_path),
        str(list(error.absolute_path)),
    )


def _check_kinds(document, schema, source, field=""):
    """Refuse a key that belongs to another kind of the section (keyword x-kind)."""
    for key, part in schema.get("properties", {}).items():
        if key in document and not _fits(document, part):
            raise SceneError(
                f"{source}: {field}{key}: only for kind {' or '.join(_kinds(part))}, "
                f"here kind is {document['kind']}; drop one of the two"
            )
        if isinstance(document.get(key), dict):
            _check_kinds(document[key], part, source, f"{field}{key}.")


def _fits(document, part):
    return "x-kind" not in part or document.get("kind") in _kinds(part)


def _kinds(part):
    """The kinds of a section that a key is for."""
    return [part["x-kind"]] if isinstance(part["x-kind"], str) else part["x-kind"]


def _fill(document, schema):
    for key, part in schema.get("properties", {}).items():
        if key not in document and "default" in part and _fits(document, part):
            document[key] = copy.deepcopy(part["default"])
        if isinstance(document.get(key), dict):
            _fill(document[key], part)


def _explain(error, schema):
    """What is wrong with which field, and the remedy."""
    field = _name(error.absolute_path)
    below = f"{field}." if field else ""
    if error.validator == "additionalProperties":
        return _explain_unknown_key(error, schema, field)
    if error.validator == "required":
        missing = next(key for key in error.validator_value if key not in error.instance)
        return f"{below}{missing}: missing; add it ({_describe(error.schema, missing)})"
    if "propertyNames" in error.absolute_schema_path:
        return f"{below}{_name([error.instance])}: not a valid key; {_remedy(error)}"
    return f"{field}: {shown(error.instance)} is not valid; {_remedy(error)}"


def _explain_unknown_key(error, schema, field):
    """A key of a section that stands at the top, or a key that is nowhere known."""
    known = list(error.schema["properties"])
    key = next(key for key in error.instance if key not in known)
    name = _name([key])
    if field:
        return f"{field}.{name}: unknown key; {nearest(key, known)}"
    sections = [
        section
        for section, part in schema["properties"].items()
        if key in part.get("properties", {})
    ]
    if sections:
        return f"{name}: unknown key here; it belongs into the section {' or '.join(sections)}"
    return f"{name}: unknown key; {nearest(key, known)}"


def _name(path):
    """The place of a value, its parts joined by dots."""
    return ".".join(map(_name_part, path))


def _name_part(part):
    """A key or an index; one that is long or unprintable is shown as JSON."""
    text = str(part)
    return text if text.isprintable() and len(text) <= WIDTH else shown(part)


def _remedy(error):
    value, bound = error.instance, error.validator_value
    remedies = {
        "enum": lambda: nearest(value, [str(v) for v in bound]),
        "oneOf": lambda: (
            _too_long(value, error.schema["oneOf"]) or f"expected {_alternatives(error.schema)}"
        ),
        "type": lambda: f"expected {_named_types(bound)}",
        "minimum": lambda: f"must be at least {bound}",
        "maximum": lambda: f"must be at most {bound}",
        "exclusiveMinimum": lambda: f"must be greater than {bound}",
        "exclusiveMaximum": lambda: f"must be less than {bound}",
        "minItems": lambda: f"needs at least {_entries(bound)}",
        "maxItems": lambda: f"takes at most {_entries(bound)}",
        "minLength": lambda: "it is empty; write something",
        "maxLength": lambda: _too_long(value, [error.schema]),
        "minProperties": lambda: "it is empty; write 'key: value' lines",
        "pattern": lambda: f"use {error.schema.get('description', bound)}",
        "uniqueItems": lambda: "list each entry once",
    }
    return remedies.get(error.validator, lambda: error.message[:200])()


def _too_long(value, alternatives):
    """What to say of a text beyond the length that its schema allows; empty if it is none."""
    most = max((part["maxLength"] for part in alternatives if "maxLength" in part), default=None)
    if most is None or not isinstance(value, str) or len(value) <= most:
        return ""
    return f"it has {len(value)} characters, more than {most}; shorten it"


_TYPES = {
    "integer": "a whole number",
    "number": "a number",
    "string": "text",
    "boolean": "true or false",
    "array": "a list, [a, b, ...]",
    "object": "a section of 'key: value' lines",
}


def _named_types(names):
    names = [names] if isinstance(names, str) else names
    return " or ".join(_TYPES.get(name, name) for name in names)


def _entries(count):
    return f"{count} entry" if count == 1 else f"{count} entries"


def _alternatives(schema):
    """What a schema says is expected (keyword x-expected), or what its alternatives are."""
    return schema.get("x-expected") or " or ".join(map(_alternative, schema["oneOf"]))


def _alternative(part):
    if "enum" in part:
        return ", ".join(map(str, part["enum"]))
    return _TYPES.get(part.get("type"), "another value") + _between(part)


def _between(part):
    """The range of a number that has two ends, in words after its type."""
    ends = part.get("minimum"), part.get("maximum")
    return "" if None in ends else f" from {ends[0]} to {ends[1]}"


def _describe(schema, key):
    """The first sentence of a key's description."""
    return schema["properties"][key].get("description", "required").split(".")[0].strip()
