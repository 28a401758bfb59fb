"""The program: find the command, parse its arguments, run it, and tell a mistake in one line."""

import argparse
import gc
import importlib
import json
import os
import sys
import time

from signorini.commands.catalogue import CATALOGUE, commands, module_of
from signorini.exceptions import SignoriniError
from signorini.wording import nearest

MISTAKE, INTERRUPTED = 2, 130  # exit codes of a wrong command line, and of Ctrl-C; 1 is any other
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main(words=None):
    """Run the command line.

    Parameters
    ----------
    words : sequence of str, optional
        Arguments; those of this process by default.

    Returns
    -------
    int
        0, or 1 after an error, printed in one line, 2 after a wrong command line.
    """
    words = list(sys.argv[1:] if words is None else words)
    if words[:1] == ["help"] and len(words) > 1:
        words = [*words[1:], "--help"]
    if not words or words[0] in ("-h", "--help", "help"):
        _print(overview())
        return 0 if words else MISTAKE
    if words[0] == "--version":
        from signorini import __version__

        print(f"signorini {__version__}")
        return 0
    command, rest = _split(words)
    if command is None:
        return MISTAKE
    _prepare()
    module = importlib.import_module(module_of(command))
    arguments = _parser(command, module).parse_intermixed_args(rest)
    return _run(module, arguments)


def overview():
    """The help: every command by section, one line each."""
    lines = ["usage: signorini COMMAND ...", "", __package_summary(), ""]
    width = max(map(len, commands()))
    for heading, section in CATALOGUE.items():
        listing = [f"  {name:<{width}}  {summary}" for name, summary in section.items()]
        lines += [f"{heading}:", *listing, ""]
    lines.append("signorini COMMAND --help explains a command and shows an example.")
    return "\n".join(lines)


def __package_summary():
    return "Crouzeix-Raviart and conforming P1 approximation of Signorini's variational inequality."


def _split(words):
    """The command that the first one or two words name, and the rest; None where they name none."""
    known = commands()
    for count in (2, 1):
        command = " ".join(words[:count])
        if len(words) >= count and command in known:
            return command, words[count:]
    parts = [name for name in known if name.startswith(f"{words[0]} ")]
    if parts and (len(words) == 1 or words[1] in ("-h", "--help")):
        listing = "\n".join(f"  {name:<{max(map(len, parts))}}  {known[name]}" for name in parts)
        _print(f"usage: signorini {words[0]} PART ...\n\n{listing}")
        sys.exit(0 if len(words) > 1 else MISTAKE)
    wrong = " ".join(words[:2]) if parts else words[0]
    print(f"error: signorini {wrong}: no such command; {nearest(wrong, known)}", file=sys.stderr)
    return None, words


def _prepare():
    """One thread, for sums must not depend on how many there are; and no search for garbage.

    A command is short: looking for cyclic garbage, above all while importing and at exit, takes a
    fifth of its time.
    """
    gc.disable()
    for name in _THREADS:
        os.environ[name] = "1"


class _Parser(argparse.ArgumentParser):
    """A parser that tells a mistake in one line, without the usage."""

    def print_help(self, file=None):
        _print(self.format_help().rstrip("\n"))

    def error(self, message):
        remedy = f"{self.prog} --help explains the arguments"
        if "required" in message:
            remedy = f"for instance {_example(self.description)}; {remedy}"
        self.exit(MISTAKE, f"error: {self.prog}: {message}; {remedy}\n")


def _example(description):
    """The first example of a command's help, in one line."""
    examples = description.partition("example:\n")[2].replace("\\\n", " ")
    return " ".join(examples.partition("\n")[0].split())


def _parser(command, module):
    parser = _Parser(
        prog=f"signorini {command}",
        description=module.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    module.add_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print the outcome as JSON")
    parser.add_argument("--debug", action="store_true", help="show where an error comes from")
    parser.add_argument("--verbose", action="store_true", help="print each step of a long solve")
    return parser


def _run(module, arguments):
    """Run a command: 0, or 1 after an error, or where what was looked for is not so."""
    from signorini.commands.progress import told_steps

    start = time.perf_counter()
    try:
        with told_steps(arguments.verbose):
            outcome = module.run(arguments)
    except SignoriniError as error:
        if arguments.debug:
            raise
        print(f"error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("error: interrupted; nothing was left half written", file=sys.stderr)
        return INTERRUPTED
    gc.freeze()
    if outcome is None:  # another process tells it
        return 0
    seconds = time.perf_counter() - start
    _print(_summary(outcome, arguments.json, getattr(arguments, "output", None), seconds))
    return int(outcome.failed)


def _summary(outcome, as_json, output, seconds):
    if as_json:
        return json.dumps({"text": outcome.text} if outcome.data is None else outcome.data)
    if "\n" in outcome.text:
        return outcome.text.rstrip("\n")
    is_named = output is None or str(output) in outcome.text
    text = outcome.text if is_named else f"{outcome.text}; in {output}"
    return f"{text} ({seconds:.2f} s)"


def _print(text):
    """Print; a reader that has seen enough, perhaps `head`, is no mistake."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
