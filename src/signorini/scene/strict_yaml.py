"""YAML as people read it.

There are no duplicate keys, no tags and no aliases, and plain true, false and numbers are those of
YAML 1.2.
"""

import math
import re

import yaml

from signorini.exceptions import SceneError
from signorini.wording import cut

_MOST_CHARACTERS = 100_000


def _error(problem, mark):
    return yaml.constructor.ConstructorError(None, None, problem, mark)


class _Loader(yaml.SafeLoader):
    yaml_implicit_resolvers = {}  # noqa: RUF012 (PyYAML's own class attribute)

    def compose_node(self, parent, index):
        event = self.peek_event()
        # Nested aliases can unfold to more text than a memory holds.
        if self.check_event(yaml.AliasEvent):
            problem = "aliases (*name) are not supported; repeat the value"
            raise _error(problem, event.start_mark)
        # A tag names the type of a value, down to Python objects.
        if getattr(event, "tag", None) is not None:
            problem = f"tags ({cut(event.tag)}) are not supported; drop it"
            raise _error(problem, event.start_mark)
        return super().compose_node(parent, index)

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if not isinstance(key, str):
                problem = (
                    f"key {str(key)[:40]} is not a word; put it in quotes if it is a name, "
                    "a list in brackets"
                )
                raise _error(problem, key_node.start_mark)
            if key in seen:
                problem = f"duplicate key {cut(key)!r}; keep one of the two"
                raise _error(problem, key_node.start_mark)
            seen.add(key)
        return super().construct_mapping(node, deep)


# Plain words of YAML 1.2's core schema. YAML 1.1, PyYAML's own, also takes no for false, 010 for 8
# and 1:30 for 90.
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
        problem = f"number {cut(text, 20)} is out of range; a double holds up to 1.8e308"
        raise _error(problem, node.start_mark)
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

    Examples
    --------
    >>> sorted(load_yaml("config/config.yaml"))
    ['scenes', 'studied']
    """
    text = _read(path)
    try:
        return yaml.load(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        raise SceneError(f"{path}: {_explain(error)}") from error
    except (yaml.YAMLError, RecursionError) as error:
        problem = cut(str(error).splitlines()[0], 200)
        raise SceneError(f"{path}: malformed YAML ({problem})") from error


def _read(path):
    try:
        with open(path, encoding="utf-8") as stream:
            text = stream.read(_MOST_CHARACTERS + 1)
    except OSError as error:
        raise SceneError(f"{path}: cannot be read ({error.strerror}); check the name") from error
    except UnicodeDecodeError as error:
        raise SceneError(
            f"{path}: not UTF-8 text ({error.reason} at byte {error.start}); save it as UTF-8"
        ) from error
    if len(text) > _MOST_CHARACTERS:
        raise SceneError(f"{path}: longer than {_MOST_CHARACTERS} characters; is this a scene?")
    return text


def _explain(error):
    """Place, problem and remedy, which own errors have already."""
    of_key = error.context == "while scanning a simple key"
    mark = error.context_mark if of_key else error.problem_mark
    place = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
    problem = cut(error.problem or "malformed YAML", 200)
    remedy = "" if "; " in problem else _remedy(error, of_key)
    return f"{place}{problem}{remedy}"


def _remedy(error, of_key):
    """Which line to mend: YAML often sees only in the next one what is missing."""
    if of_key:
        return "; write 'key: value', with a space"
    before = error.problem_mark is not None and error.problem_mark.line > 0
    return "; mend this line or the one before" if before else "; mend this line"
