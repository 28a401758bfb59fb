"""The keys of a JSON schema as a Markdown list, each with what it means, what it may be, and an
example.
"""

import json

TYPES = {
    "string": "text",
    "integer": "whole number",
    "number": "number",
    "boolean": "`true` or `false`",
    "object": "section",
    None: "value",
}
NAME = "NAME"  # stands for keys that a user chooses
DEFINED = {"#/$defs/formula": "number or formula", "#/$defs/pair": "two numbers"}


def key_list(schema, examples=()):
    """One item per key, sections before what they hold.

    Parameters
    ----------
    schema : dict
        JSON schema of a YAML file.
    examples : collection of dict
        Documents; a key's example is its value in the first one that has it, its default where none
        has.

    Returns
    -------
    str
    """
    items = _items(schema, schema, (), examples)
    return "".join(f"- `{name}`: {meaning}\\\n  {facts}.\n" for name, meaning, facts in items)


def key_sections(schema, examples=()):
    """The same as `key_list`, with a heading for each key: of level 2 for one without a section,
    else of level 3.
    """
    items = _items(schema, schema, (), examples)
    return "\n".join(
        f"{'###' if '.' in name else '##'} {name}\n\n{meaning}\n\n{facts}.\n"
        for name, meaning, facts in items
    )


def _items(schema, root, path, examples):
    """Name, meaning and facts of each key."""
    for key, part in _properties(schema, root).items():
        inner = (*path, key)
        meaning = _resolved(part, root).get("description", "").strip()
        facts = _facts(inner, part, root, key in schema.get("required", ()), examples)
        yield ".".join(inner), meaning, "; ".join(facts)
        yield from _items(_resolved(part, root), root, inner, examples)


def _properties(schema, root):
    """The keys of a section, also those that only some of its alternatives have."""
    found = dict(schema.get("properties", {}))
    for word in ("oneOf", "anyOf", "allOf"):
        for part in schema.get(word, ()):
            found = _properties(_resolved(part, root), root) | found
    if "properties" in (named := schema.get("additionalProperties") or {}):
        found[NAME] = {"description": "A name of your own.", **named}
    return found


def _resolved(part, root):
    """A schema with its reference into $defs replaced by what it refers to."""
    if "$ref" not in part:
        return part
    return root["$defs"][part["$ref"].removeprefix("#/$defs/")] | part


def _facts(path, part, root, required, examples):
    """What a value may be, whether it is required, its default, and an example."""
    values, part = _values(part, root), _resolved(part, root)
    facts = [f"{values[0].upper()}{values[1:]}"]
    if "x-kind" in part:
        kinds = part["x-kind"]
        told = kinds if isinstance(kinds, str) else " or ".join(kinds)
        facts.append(f"only where kind is {told}")
    if required:
        facts.append("required")
    elif "default" in part:
        facts.append(f"default `{_shown(part['default'])}`")
    found = [
        value for value in (_found(document, path) for document in examples) if value is not None
    ]
    if not _properties(part, root) and (found or "default" in part):
        facts.append(f"example `{path[-1]}: {_shown(found[0] if found else part['default'])}`")
    return facts


def _values(part, root):
    """What a value may be, in words."""
    if part.get("$ref") in DEFINED:
        return DEFINED[part["$ref"]]
    part = _resolved(part, root)
    if "enum" in part:
        return _either([f"`{value}`" for value in part["enum"]])
    if part.get("type") == "array":
        return f"list, each {_values(part['items'], root)}"
    for word in ("oneOf", "anyOf"):
        if word in part and not _properties(part, root):
            return ", or ".join(_values(option, root) for option in part[word])
    return _with_bounds(part)


def _with_bounds(part):
    bounds = [
        f"{word} {part[key]}"
        for key, word in (("minimum", "from"), ("maximum", "to"))
        if key in part
    ]
    names = part.get("type")
    kinds = [TYPES[name] for name in (names if isinstance(names, list) else [names])]
    return " ".join([_either(kinds), *bounds])


def _either(words):
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def _found(document, path):
    for key in path:
        document = document.get(key) if isinstance(document, dict) else None
    return document


def _shown(value):
    """A value as YAML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_shown(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_shown, value)) + "]"
    return (value or '""') if isinstance(value, str) else json.dumps(value)
