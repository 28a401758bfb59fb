"""Validation of parsed YAML against a JSON schema, with defaults filled in and errors a person can act on."""

import copy
import difflib
import json
from functools import cache

from signorini.exceptions import SceneError


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
        raise SceneError(f"{source}: expected 'key: value' lines at the top, found {shown(document)}")
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

    whole = Draft202012Validator.TYPE_CHECKER.redefine("integer", lambda _, value: type(value) is int)
    return validators.extend(Draft202012Validator, type_checker=whole)


def _order(error):
    return error.validator != "additionalProperties", len(error.absolute_path), str(list(error.absolute_path))


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
    field = ".".join(str(part) for part in error.absolute_path)
    if error.validator == "additionalProperties":
        known = list(error.schema["properties"])
        key = next(key for key in error.instance if key not in known)
        name = key if key.isprintable() and len(key) <= 60 else shown(key)
        homes = [section for section, part in schema["properties"].items() if key in part.get("properties", {})]
        if homes and not field:
            return f"{name}: unknown key here; it belongs into the section {' or '.join(homes)}"
        return f"{field + '.' if field else ''}{name}: unknown key; {nearest(key, known)}"
    if error.validator == "required":
        missing = next(key for key in error.validator_value if key not in error.instance)
        return f"{field + '.' if field else ''}{missing}: missing; add it ({_describe(error.schema, missing)})"
    remedy = {
        "enum": lambda: nearest(error.instance, [str(v) for v in error.validator_value]),
        "oneOf": lambda: f"expected {_alternatives(error.schema)}",
        "type": lambda: f"expected {_named_types(error.validator_value)}",
        "minimum": lambda: f"must be at least {error.validator_value}",
        "maximum": lambda: f"must be at most {error.validator_value}",
        "minItems": lambda: f"needs at least {_entries(error.validator_value)}",
        "maxItems": lambda: f"takes at most {_entries(error.validator_value)}",
        "pattern": lambda: f"use {error.schema.get('description', error.validator_value)}",
        "uniqueItems": lambda: "list each entry once",
    }.get(error.validator, lambda: error.message)()
    return f"{field}: {shown(error.instance)} is not valid; {remedy}"


_TYPES = {
    "integer": "a whole number",
    "number": "a number",
    "string": "text",
    "array": "a list, [a, b, ...]",
    "object": "a section of 'key: value' lines",
}


def _named_types(names):
    return " or ".join(_TYPES[name] for name in ([names] if isinstance(names, str) else names))


def _entries(count):
    return f"{count} entry" if count == 1 else f"{count} entries"


def _alternatives(schema):
    return " or ".join(
        ", ".join(map(str, part["enum"])) if "enum" in part else _TYPES.get(part.get("type"), "another value")
        for part in schema["oneOf"]
    )


def _describe(schema, key):
    return schema["properties"][key].get("description", "required").split(".")[0].strip()


def shown(value):
    """A value as JSON, cut to 60 characters."""
    text = json.dumps(value, default=str, ensure_ascii=False)
    return text if len(text) <= 60 else text[:57] + "..."


def nearest(word, known):
    """A hint: the nearest of the known words, and all of them."""
    near = difflib.get_close_matches(str(word), known, n=1, cutoff=0.5)
    return (f"did you mean {near[0]}? " if near else "") + f"known: {', '.join(known)}"
