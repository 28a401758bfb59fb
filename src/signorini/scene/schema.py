"""Validation of parsed YAML against a JSON schema, with defaults filled in and errors a person can
act on.
"""

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

    Raises
    ------
    SceneError
        One line that names the file, the field, the value and the remedy.
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
    """JSON schema's rules, but 2.0 is no integer: it would name the file n2.0.npz."""
    from jsonschema import Draft202012Validator, validators

    whole = Draft202012Validator.TYPE_CHECKER.redefine(
        "integer", lambda _, value: type(value) is int
    )
    return validators.extend(Draft202012Validator, type_checker=whole)


def _order(error):
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
                f"{source}: {field}{key}: only for kind {part['x-kind']}, here kind is {document['kind']}; "
                "drop one of the two"
            )
        if isinstance(document.get(key), dict):
            _check_kinds(document[key], part, source, f"{field}{key}.")


def _fits(document, part):
    return "x-kind" not in part or part["x-kind"] == document.get("kind")


def _fill(document, schema):
    for key, part in schema.get("properties", {}).items():
        if key not in document and "default" in part and _fits(document, part):
            document[key] = copy.deepcopy(part["default"])
        if isinstance(document.get(key), dict):
            _fill(document[key], part)


def _explain(error, schema):
    field = _name(error.absolute_path)
    below = f"{field}." if field else ""
    if error.validator == "additionalProperties":
        known = list(error.schema["properties"])
        key = next(key for key in error.instance if key not in known)
        homes = [
            section
            for section, part in schema["properties"].items()
            if key in part.get("properties", {})
        ]
        if homes and not field:
            return f"{_name([key])}: unknown key here; it belongs into the section {' or '.join(homes)}"
        return f"{below}{_name([key])}: unknown key; {nearest(key, known)}"
    if error.validator == "required":
        missing = next(key for key in error.validator_value if key not in error.instance)
        return f"{below}{missing}: missing; add it ({_describe(error.schema, missing)})"
    if "propertyNames" in error.absolute_schema_path:
        return f"{below}{_name([error.instance])}: not a valid key; {_remedy(error)}"
    return f"{field}: {shown(error.instance)} is not valid; {_remedy(error)}"


def _name(path):
    """The place of a value, its parts joined by dots; a part that is long or unprintable is shown
    as JSON.
    """
    return ".".join(
        str(part) if str(part).isprintable() and len(str(part)) <= WIDTH else shown(part)
        for part in path
    )


def _remedy(error):
    value, bound = error.instance, error.validator_value
    return {
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
    }.get(error.validator, lambda: error.message[:200])()


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
    return " or ".join(
        _TYPES.get(name, name) for name in ([names] if isinstance(names, str) else names)
    )


def _entries(count):
    return f"{count} entry" if count == 1 else f"{count} entries"


def _alternatives(schema):
    return " or ".join(
        ", ".join(map(str, part["enum"]))
        if "enum" in part
        else _TYPES.get(part.get("type"), "another value")
        for part in schema["oneOf"]
    )


def _describe(schema, key):
    return schema["properties"][key].get("description", "required").split(".")[0].strip()
