"""YAML as people read it: no duplicate keys, no tags, no aliases, and 1.2's plain true, false and
numbers.
"""

import math
import re

import yaml

from signorini.exceptions import SceneError

_MAX_BYTES = 100_000
_WIDTH = 60  # of a word that is shown


def _cut(text, width=_WIDTH):
    return text if len(text) <= width else f"{text[: width - 3]}..."


class _Loader(yaml.SafeLoader):
    yaml_implicit_resolvers = {}  # noqa: RUF012 (PyYAML's own class attribute)

    def compose_node(self, parent, index):
        if self.check_event(yaml.AliasEvent):
            raise yaml.constructor.ConstructorError(
                None,
                None,
                "aliases (*name) are not supported; repeat the value",
                self.peek_event().start_mark,
            )
        if getattr(self.peek_event(), "tag", None) is not None:
            raise yaml.constructor.ConstructorError(
                None,
                None,
                f"tags ({_cut(self.peek_event().tag)}) are not supported; drop it",
                self.peek_event().start_mark,
            )
        return super().compose_node(parent, index)

    def construct_mapping(self, node, deep=False):
        seen = {}
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if not isinstance(key, str):
                problem = f"key {str(key)[:40]} is not a word; put it in quotes if it is a name, a list in brackets"
                raise yaml.constructor.ConstructorError(None, None, problem, key_node.start_mark)
            if key in seen:
                raise yaml.constructor.ConstructorError(
                    None,
                    None,
                    f"duplicate key {_cut(key)!r}; keep one of the two",
                    key_node.start_mark,
                )
            seen[key] = None
        return super().construct_mapping(node, deep)


for _tag, _pattern, _first in (
    ("bool", r"true|false", "tf"),
    ("int", r"[-+]?(?:0|[1-9][0-9]*)", "-+0123456789"),
    ("float", r"[-+]?(?:0|[1-9][0-9]*)?(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?", "-+.0123456789"),
    ("null", r"null|~|", ["n", "~", ""]),
):
    _Loader.add_implicit_resolver(
        f"tag:yaml.org,2002:{_tag}", re.compile(rf"^(?:{_pattern})$"), list(_first)
    )


def _float(loader, node):
    text = loader.construct_scalar(node)
    try:
        value = float(text)
    except ValueError:
        return text
    if not math.isfinite(value):
        raise yaml.constructor.ConstructorError(
            None,
            None,
            f"number {_cut(text, 20)} is out of range; a double holds up to 1.8e308",
            node.start_mark,
        )
    return value


def _int(loader, node):
    _float(loader, node)
    return int(loader.construct_scalar(node))


_Loader.add_constructor("tag:yaml.org,2002:float", _float)
_Loader.add_constructor("tag:yaml.org,2002:int", _int)


def load_yaml(path):
    """Read one YAML document.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    object
        Dicts, lists, str, int, float, bool and None.

    Raises
    ------
    SceneError
        Naming the file, the line and the remedy.
    """
    try:
        with open(path, encoding="utf-8") as stream:
            text = stream.read(_MAX_BYTES + 1)
    except OSError as error:
        raise SceneError(f"{path}: cannot be read ({error.strerror}); check the name") from error
    except UnicodeDecodeError as error:
        raise SceneError(
            f"{path}: not UTF-8 text ({error.reason} at byte {error.start}); save it as UTF-8"
        ) from error
    if len(text) > _MAX_BYTES:
        raise SceneError(f"{path}: longer than {_MAX_BYTES} characters; is this a scene?")
    try:
        return yaml.load(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        problem = _cut(error.problem or "malformed YAML", 200)
        remedy = "" if "; " in problem else "; mend this line"
        raise SceneError(f"{path}: {place}{problem}{remedy}") from error
    except (yaml.YAMLError, RecursionError) as error:
        raise SceneError(
            f"{path}: malformed YAML ({_cut(str(error).splitlines()[0], 200)})"
        ) from error
