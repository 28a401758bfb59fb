"""Commands of the program within a line of prose: real parsers know them, with all their options.

`test_commands.py` runs those on lines of their own, and tries those of Snakemake within lines.
"""

import importlib
import re
import shlex

import pytest
from project import ROOT
from test_commands import BLOCK, PAGES

from signorini.commands.catalogue import commands, module_of
from signorini.commands.program import _parser, _split

PROSE = re.compile(r"`(?:[\w./]*bin/|python3? -m )?(signorini(?: [^`]+))`")
PLACEHOLDERS = {"COMMAND"}  # that stand for any command
OPTION = re.compile(r"`(--[a-z][\w-]*)[^`]*`")
OTHERS = {
    "snakemake": {"--config", "--cores", "--forcerun", "--rerun-incomplete", "--unlock"},
    "its Slurm plugin": {"--slurm-no-account", "--slurm-status-command"},
    "mpiexec": {"--allow-run-as-root", "--oversubscribe"},
    "benchmarks/growth.py": {"--sizes"},
    ".ci/try_artifact.py": {"--long"},
}


def found():
    """Command -> the page that has it first."""
    places = {}
    for page in PAGES:
        text = " ".join(BLOCK.sub("", page.read_text(encoding="utf-8")).split())
        for command in PROSE.findall(text):
            places.setdefault(command, page.relative_to(ROOT).as_posix())
    return places


COMMANDS = found()


def parsed(command):
    """Its arguments, by the parser of the command; SystemExit, or AssertionError, for a wrong one.

    A command that is mentioned without any argument of its own, as in `signorini solve
    --reference`, needs none.
    """
    words = shlex.split(command)[1:]
    if words[0] in PLACEHOLDERS:
        return None
    name, rest = _split(words)
    assert name, f"{command}: no such command"
    parser = _parser(name, importlib.import_module(module_of(name)))
    if {"-h", "--help"} & set(rest):
        return None
    given = relaxed(parser).parse_intermixed_args(rest)
    if not positionals(parser, given):
        return given
    return _parser(name, importlib.import_module(module_of(name))).parse_intermixed_args(rest)


def relaxed(parser):
    """The parser with nothing required, changed in place."""
    for action in parser._actions:
        action.required = False
        if not action.option_strings and action.nargs in (None, "+"):
            action.nargs = "?" if action.nargs is None else "*"
    return parser


def positionals(parser, given):
    """What stands in the place of the parser's arguments without a name."""
    names = [action.dest for action in parser._actions if not action.option_strings]
    return [getattr(given, name) for name in names if getattr(given, name) not in (None, [])]


def test_there_are_commands():
    assert len(COMMANDS) > 20
    assert {"signorini solve", "signorini verify results"} <= set(COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_in_prose_is_one(command):
    try:
        parsed(command)
    except SystemExit:
        pytest.fail(f"{COMMANDS[command]}: {command}")


@pytest.mark.parametrize(
    "command",
    [
        "signorini solve --referrence",  # no such option
        "signorini solve a.yaml --element P1 --elements",
        "signorini sloves a.yaml",  # no such command
        "signorini verify a b c d",  # too many arguments
        "signorini solve a.yaml --method magic",  # no such choice
        "signorini certify config/scenes/corner.yaml --bound small",  # no number
    ],
)
def test_what_is_made_up_is_told(command):
    with pytest.raises((SystemExit, AssertionError)):
        parsed(command)


def test_options_in_prose_are_those_of_some_command():
    """Those that stand alone, as `--method petsc` does."""
    known = {option for name in commands() for option in options(name)}
    text = "\n".join(BLOCK.sub("", page.read_text(encoding="utf-8")) for page in PAGES)
    alone = set(OPTION.findall(text))
    assert "--method" in alone
    assert alone - known - set().union(*OTHERS.values()) == set()


def options(name):
    """The options of a command."""
    return _parser(name, importlib.import_module(module_of(name)))._option_string_actions


def test_every_command_can_be_mentioned_alone():
    for name in commands():
        parsed(f"signorini {name}")
